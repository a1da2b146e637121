#include "tests/support/transform.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace flexura::testing {
namespace {

/// Applies a map to everything of a model that has a place.
template <class Map>
void map_places(Model& model, const Map& map, double turn, double stretch) {
  for (Body& body : model.bodies) {
    for (Point& point : body.points) point.position = map(point.position);
    if (body.centre) body.centre = map(*body.centre);
  }
  for (Flexure& flexure : model.flexures) {
    if (auto* line = std::get_if<LineAxis>(&flexure.axis)) {
      *line = {map(line->start), map(line->end)};
    } else if (auto* arc = std::get_if<ArcAxis>(&flexure.axis)) {
      *arc = {map(arc->centre), stretch * arc->radius, arc->start + turn, arc->sweep};
    } else {
      auto& spline = std::get<SplineAxis>(flexure.axis);
      for (Vec2& point : spline.points) point = map(point);
      for (auto* tangent : {&spline.start_tangent, &spline.end_tangent})
        if (*tangent) *tangent = rotate(turn, **tangent);
    }
  }
}

AxisShape reversed(const AxisShape& axis) {
  if (const auto* line = std::get_if<LineAxis>(&axis)) return LineAxis{line->end, line->start};
  if (const auto* arc = std::get_if<ArcAxis>(&axis))
    return ArcAxis{arc->centre, arc->radius, arc->start + arc->sweep, -arc->sweep};
  SplineAxis spline = std::get<SplineAxis>(axis);
  std::reverse(spline.points.begin(), spline.points.end());
  std::swap(spline.start_tangent, spline.end_tangent);
  for (auto* tangent : {&spline.start_tangent, &spline.end_tangent})
    if (*tangent) *tangent = -**tangent;
  return spline;
}

std::pair<AxisShape, AxisShape> halves(const AxisShape& axis) {
  if (const auto* line = std::get_if<LineAxis>(&axis)) {
    const Vec2 middle = 0.5 * (line->start + line->end);
    return {LineAxis{line->start, middle}, LineAxis{middle, line->end}};
  }
  ArcAxis first = std::get<ArcAxis>(axis);
  first.sweep *= 0.5;
  ArcAxis second = first;
  second.start += first.sweep;
  return {first, second};
}

}  // namespace

Model moved_rigidly(Model model, double angle, Vec2 shift) {
  map_places(
      model, [&](Vec2 p) { return shift + rotate(angle, p); }, angle, 1.0);
  return model;
}

Load turned(Load load, double angle) {
  load.force = rotate(angle, load.force);
  return load;
}

Model in_other_length_unit(Model model, double factor) {
  map_places(
      model, [&](Vec2 p) { return factor * p; }, 0.0, factor);
  for (Material& material : model.materials) material.youngs_modulus /= factor * factor;
  for (NamedSection& section : model.sections) {
    if (auto* rectangle = std::get_if<RectangleSection>(&section.shape)) {
      rectangle->thickness *= factor;
      rectangle->width *= factor;
    } else if (auto* circle = std::get_if<CircleSection>(&section.shape)) {
      circle->diameter *= factor;
    } else {
      auto& general = std::get<GeneralSection>(section.shape);
      general.area *= factor * factor;
      general.second_moment *= factor * factor * factor * factor;
      if (general.rotary_second_moment)
        *general.rotary_second_moment *= factor * factor * factor * factor;
      if (general.shear_area) *general.shear_area *= factor * factor;
      if (general.depth) *general.depth *= factor;
    }
  }
  return model;
}

Load in_other_length_unit(Load load, double factor) {
  load.moment *= factor;
  return load;
}

Model with_reversed_flexure(Model model, std::size_t index) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    model.bodies[b].centre = body_centre(model, b);
  Flexure& flexure = model.flexures[index];
  std::swap(flexure.base, flexure.action);
  std::swap(flexure.pinned_base, flexure.pinned_action);
  flexure.axis = reversed(flexure.axis);
  return model;
}

Model with_halved_flexure(Model model, std::size_t index) {
  Body joint;
  joint.name = "joint";
  const auto [first, second] = halves(model.flexures[index].axis);
  Flexure rest = model.flexures[index];
  rest.name += "_rest";
  rest.base = model.bodies.size();
  rest.pinned_base = false;
  rest.axis = second;
  Flexure& start = model.flexures[index];
  start.action = model.bodies.size();
  start.pinned_action = false;
  start.axis = first;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (b == rest.action && !model.bodies[b].centre)
      model.bodies[b].centre = axis_ends(second).action;
  model.bodies.push_back(joint);
  model.flexures.push_back(rest);
  return model;
}

}  // namespace flexura::testing

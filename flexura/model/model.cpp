#include "flexura/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

struct Ends {
  AxisEnds operator()(const LineAxis& line) const { return {line.start, line.end}; }
  AxisEnds operator()(const ArcAxis& arc) const {
    return {arc.centre + arc.radius * unit(arc.start),
            arc.centre + arc.radius * unit(arc.start + arc.sweep)};
  }
  AxisEnds operator()(const SplineAxis& spline) const {
    if (spline.points.empty()) return {};
    return {spline.points.front(), spline.points.back()};
  }
};

}  // namespace

AxisEnds axis_ends(const AxisShape& axis) { return std::visit(Ends{}, axis); }

bool needs_assembly(const Model& model) {
  for (const Flexure& flexure : model.flexures)
    if (norm(flexure.misfit) > 0.0 || flexure.misfit_rotation != 0.0) return true;
  for (const Spring& spring : model.springs)
    if (spring.free || spring.preload) return true;
  return false;
}

Vec2 body_centre(const Model& model, std::size_t body) {
  if (model.bodies[body].centre) return *model.bodies[body].centre;
  for (const Flexure& flexure : model.flexures) {
    if (flexure.base == body) return axis_ends(flexure.axis).base;
    if (flexure.action == body) return axis_ends(flexure.axis).action;
  }
  return {};
}

std::vector<std::optional<Vec2>> common_pins(const Model& model) {
  // Ends typed with six digits or computed from angles still count as one place.
  constexpr double same_place = 1e-6;
  struct Ends {
    std::optional<Vec2> first;
    bool all_pinned = true;
    double spread = 0.0;  // of the ends
    double size = 0.0;    // of the flexures
  };
  std::vector<Ends> bodies(model.bodies.size());
  for (const Flexure& flexure : model.flexures) {
    const AxisEnds ends = axis_ends(flexure.axis);
    const auto add_end = [&](std::size_t index, bool pinned, Vec2 end) {
      if (index >= bodies.size()) return;
      Ends& body = bodies[index];
      if (!body.first) body.first = end;
      body.all_pinned = body.all_pinned && pinned;
      body.spread = std::max(body.spread, norm(end - *body.first));
      body.size = std::max(body.size, norm(ends.action - ends.base));
    };
    add_end(flexure.base, flexure.pinned_base, ends.base);
    add_end(flexure.action, flexure.pinned_action, ends.action);
  }
  std::vector<std::optional<Vec2>> pins;
  for (const Ends& body : bodies) {
    const bool one_pin = body.all_pinned && body.spread <= same_place * body.size;
    pins.push_back(one_pin ? body.first : std::nullopt);
  }
  return pins;
}

bool body_can_turn(const Model& model, std::size_t body) {
  return model.bodies[body].fixed || !common_pins(model)[body];
}

}  // namespace flexura

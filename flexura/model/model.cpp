#include "flexura/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Ends typed with six digits or computed from angles still count as one place.
constexpr double same_place = 1e-6;

/// What is fastened to a body, on the way to its common pin.
struct Fastenings {
  std::optional<Vec2> first;
  bool all_pinned = true;
  double spread = 0.0;  ///< of the places
  double size = 0.0;    ///< of what is fastened there

  void add(Vec2 place, bool pinned, double extent) {
    if (!first) first = place;
    all_pinned = all_pinned && pinned;
    spread = std::max(spread, norm(place - *first));
    size = std::max(size, extent);
  }
};

/// Whether the body resists being turned about the pin it hangs on.
bool has_inertia_about(const Body& body, Vec2 pin, double size) {
  if (body.inertia > 0.0) return true;
  return body.mass > 0.0 && body.centre && norm(*body.centre - pin) > same_place * size;
}

}  // namespace

Section section_of(const Model& model, const Flexure& flexure) {
  return flexure.link ? link_section(*flexure.link) : model.sections[flexure.section].shape;
}

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
  for (const Joint& joint : model.joints) {
    const auto* pin = std::get_if<RevoluteJoint>(&joint.kind);
    if (pin && (joint.base == body || joint.action == body)) return pin->at;
  }
  return {};
}

double mechanism_size(const Model& model) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec2 least{infinity, infinity};
  Vec2 greatest{-infinity, -infinity};
  const auto add = [&](Vec2 place) {
    least = {std::min(least.x, place.x), std::min(least.y, place.y)};
    greatest = {std::max(greatest.x, place.x), std::max(greatest.y, place.y)};
  };
  for (const Body& body : model.bodies) {
    for (const Point& point : body.points) add(point.position);
    if (body.centre) add(*body.centre);
  }
  for (const Flexure& flexure : model.flexures) {
    add(axis_ends(flexure.axis).base);
    add(axis_ends(flexure.axis).action);
  }
  for (const Joint& joint : model.joints)
    if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) add(pin->at);
  return least.x <= greatest.x ? norm(greatest - least) : 0.0;
}

std::vector<std::optional<Vec2>> common_pins(const Model& model) {
  std::vector<Fastenings> bodies(model.bodies.size());
  const auto add = [&](std::size_t body, Vec2 place, bool pinned, double extent) {
    if (body < bodies.size()) bodies[body].add(place, pinned, extent);
  };
  for (const Flexure& flexure : model.flexures) {
    const AxisEnds ends = axis_ends(flexure.axis);
    const double extent = norm(ends.action - ends.base);
    add(flexure.base, ends.base, flexure.pinned_base, extent);
    add(flexure.action, ends.action, flexure.pinned_action, extent);
  }
  const double size = model.joints.empty() ? 0.0 : mechanism_size(model);
  for (const Joint& joint : model.joints) {
    const auto* pin = std::get_if<RevoluteJoint>(&joint.kind);
    for (const std::size_t body : {joint.base, joint.action})
      add(body, pin ? pin->at : Vec2{}, pin != nullptr, size);
  }
  std::vector<std::optional<Vec2>> pins;
  for (const Fastenings& body : bodies) {
    const bool one_pin = body.all_pinned && body.spread <= same_place * body.size;
    pins.push_back(one_pin ? body.first : std::nullopt);
  }
  return pins;
}

std::vector<std::optional<Vec2>> hanging_pins(const Model& model) {
  std::vector<std::optional<Vec2>> pins = common_pins(model);
  const double size = mechanism_size(model);
  for (std::size_t b = 0; b < pins.size(); ++b) {
    const Body& body = model.bodies[b];
    if (pins[b] && (body.fixed || has_inertia_about(body, *pins[b], size))) pins[b].reset();
  }
  for (const Driver& driver : model.drivers)
    if (driver.body < pins.size()) pins[driver.body].reset();
  return pins;
}

bool body_can_turn(const Model& model, std::size_t body) { return !hanging_pins(model)[body]; }

}  // namespace flexura

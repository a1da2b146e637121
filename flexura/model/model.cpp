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

Vec2 body_centre(const Model& model, std::size_t body) {
  if (model.bodies[body].centre) return *model.bodies[body].centre;
  for (const Flexure& flexure : model.flexures) {
    if (flexure.base == body) return axis_ends(flexure.axis).base;
    if (flexure.action == body) return axis_ends(flexure.axis).action;
  }
  return {};
}

std::optional<Vec2> common_pin(const Model& model, std::size_t body) {
  // Ends typed with six digits or computed from angles still count as one place.
  constexpr double same_place = 1e-6;
  std::optional<Vec2> pin;
  double size = 0.0;
  double spread = 0.0;
  const auto add_end = [&](bool pinned, Vec2 end) {
    if (!pin) pin = end;
    spread = std::max(spread, norm(end - *pin));
    return pinned;
  };
  for (const Flexure& flexure : model.flexures) {
    const AxisEnds ends = axis_ends(flexure.axis);
    bool pinned = true;
    if (flexure.base == body) pinned = add_end(flexure.pinned_base, ends.base);
    if (flexure.action == body) pinned = add_end(flexure.pinned_action, ends.action) && pinned;
    if (!pinned) return {};
    if (flexure.base == body || flexure.action == body) {
      size = std::max(size, norm(ends.action - ends.base));
    }
  }
  return spread <= same_place * size ? pin : std::nullopt;
}

bool body_can_turn(const Model& model, std::size_t body) {
  return model.bodies[body].fixed || !common_pin(model, body);
}

}  // namespace flexura

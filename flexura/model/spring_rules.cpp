#include "flexura/model/rules.hpp"

namespace flexura {

void check_springs(const Model& model, Mistakes& mistakes) {
  const auto place = [&](const SpringEnd& end) {
    return end.point ? model.bodies[end.body].points[*end.point].position
                     : body_centre(model, end.body);
  };
  const auto valid = [&](const SpringEnd& end) {
    return end.body < model.bodies.size() &&
           (!end.point || *end.point < model.bodies[end.body].points.size());
  };
  for (const Spring& spring : model.springs) {
    const KeyPath path{"springs", spring.name};
    const bool damper = spring.stiffness == 0.0 && spring.damping != 0.0;
    if (!damper)
      mistakes.require_positive(path / (spring.torsional ? "torsional" : "stiffness"),
                                spring.stiffness);
    mistakes.require_not_negative(path / "damping", spring.damping);
    if (damper && (spring.free || spring.preload))
      mistakes.add(path / (spring.preload     ? "preload"
                           : spring.torsional ? "free_angle"
                                              : "free_length"),
                   "without stiffness this is a damper: at rest it exerts nothing, whatever its "
                   "length");
    mistakes.require_finite(path / (spring.torsional ? "free_angle" : "free_length"),
                            spring.free.value_or(0.0));
    mistakes.require_finite(path / "preload", spring.preload.value_or(0.0));
    if (!spring.torsional && spring.free && *spring.free < 0.0)
      mistakes.add(path / "free_length", "a length is not negative");
    if (!valid(spring.base) || !valid(spring.action)) continue;
    if (spring.base.body == spring.action.body) {
      mistakes.add(path / "between", "joins a body to itself");
    } else if (!spring.torsional && norm(place(spring.action) - place(spring.base)) == 0.0) {
      mistakes.add(path / "between",
                   "both ends lie at the same point: a spring as drawn has no direction");
    }
  }
}

}  // namespace flexura

#include "flexura/assembly/spring_potential.hpp"

#include "flexura/assembly/spring.hpp"

namespace flexura {
namespace {

struct SpringVector {
  Jet2<6> x, y;
};

/// From one point to the other.
SpringVector spring_vector(const SystemLayout& layout, const SystemLayout::Spring& spring,
                           const Pose& a, const Pose& b) {
  using Jet = Jet2<6>;
  const Jet turn_a = Jet::variable(2, a.rotation);
  const Jet turn_b = Jet::variable(5, b.rotation);
  // Positions count from the base body's drawn centre: differences of small numbers stay exact.
  const Vec2 origin = layout.bodies[spring.base].centre;
  const Jet dx =
      Jet::variable(3, b.position.x - origin.x) - Jet::variable(0, a.position.x - origin.x);
  const Jet dy =
      Jet::variable(4, b.position.y - origin.y) - Jet::variable(1, a.position.y - origin.y);
  const Vec2 ra = spring.base_arm;
  const Vec2 rb = spring.action_arm;
  if (layout.linearised)
    return {dx - turn_b * rb.y + turn_a * ra.y + (rb.x - ra.x),
            dy + turn_b * rb.x - turn_a * ra.x + (rb.y - ra.y)};
  return {dx + cos(turn_b) * rb.x - sin(turn_b) * rb.y - cos(turn_a) * ra.x + sin(turn_a) * ra.y,
          dy + sin(turn_b) * rb.x + cos(turn_b) * rb.y - sin(turn_a) * ra.x - cos(turn_a) * ra.y};
}

}  // namespace

Jet2<6> spring_length(const SystemLayout& layout, const SystemLayout::Spring& spring, const Pose& a,
                      const Pose& b) {
  if (spring.torsional) return Jet2<6>::variable(5, b.rotation) - Jet2<6>::variable(2, a.rotation);
  const SpringVector v = spring_vector(layout, spring, a, b);
  if (!layout.linearised) return sqrt(v.x * v.x + v.y * v.y);
  const Vec2 drawn = layout.bodies[spring.action].centre + spring.action_arm -
                     layout.bodies[spring.base].centre - spring.base_arm;
  const Vec2 along = (1.0 / norm(drawn)) * drawn;
  return v.x * along.x + v.y * along.y;
}

Jet2<6> spring_potential(const SystemLayout& layout, const SystemLayout::Spring& spring,
                         const Pose& a, const Pose& b, double assembly) {
  const double free = spring.free - (1.0 - assembly) * spring.misfit;
  if (spring.torsional)
    return torsion_spring_energy(spring_length(layout, spring, a, b), spring.stiffness, free);
  if (layout.linearised && free != 0.0) {
    const Jet2<6> elongation = spring_length(layout, spring, a, b) - free;
    return (0.5 * spring.stiffness) * (elongation * elongation);
  }
  const SpringVector v = spring_vector(layout, spring, a, b);
  return spring_energy(v.x, v.y, spring.stiffness, free);
}

}  // namespace flexura

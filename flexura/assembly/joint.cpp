#include "flexura/assembly/joint.hpp"

namespace flexura {

std::array<Jet2<6>, 2> joint_gaps(const SystemLayout& layout, const SystemLayout::Joint& joint,
                                  const Pose& base, const Pose& action) {
  using Jet = Jet2<6>;
  const Jet turn_a = Jet::variable(2, base.rotation);
  const Jet turn_b = Jet::variable(5, action.rotation);
  // Positions count from the base body's drawn centre: differences of small numbers stay exact.
  const Vec2 origin = layout.bodies[joint.base].centre;
  const Jet dx =
      Jet::variable(3, action.position.x - origin.x) - Jet::variable(0, base.position.x - origin.x);
  const Jet dy =
      Jet::variable(4, action.position.y - origin.y) - Jet::variable(1, base.position.y - origin.y);
  if (joint.kind == SystemLayout::Joint::Kind::revolute) {
    const Vec2 ra = joint.base_arm;
    const Vec2 rb = joint.action_arm;
    const Jet ca = cos(turn_a), sa = sin(turn_a), cb = cos(turn_b), sb = sin(turn_b);
    return {dx + cb * rb.x - sb * rb.y - ca * ra.x + sa * ra.y,
            dy + sb * rb.x + cb * rb.y - sa * ra.x - ca * ra.y};
  }
  const Vec2 across = perp(joint.direction);
  const double drawn = dot(across, layout.bodies[joint.action].centre - origin);
  return {in_turned_axes(turn_a, dx, dy).along * across.x +
              in_turned_axes(turn_a, dx, dy).across * across.y - drawn,
          turn_b - turn_a};
}

std::array<Jet2<6>, 2> linearised_joint_gaps(const SystemLayout& layout,
                                             const SystemLayout::Joint& joint, const Pose& base,
                                             const Pose& action) {
  const Pose drawn_base{layout.bodies[joint.base].centre, 0.0};
  const Pose drawn_action{layout.bodies[joint.action].centre, 0.0};
  std::array<Jet2<6>, 2> gaps = joint_gaps(layout, joint, drawn_base, drawn_action);
  const Vec2 a = base.position - drawn_base.position;
  const Vec2 b = action.position - drawn_action.position;
  const double moved[6] = {a.x, a.y, base.rotation, b.x, b.y, action.rotation};
  for (Jet2<6>& gap : gaps) {
    gap.value = 0.0;
    for (std::size_t i = 0; i < 6; ++i) gap.value += gap.gradient[i] * moved[i];
    gap.hessian.fill(0.0);
  }
  return gaps;
}

}  // namespace flexura

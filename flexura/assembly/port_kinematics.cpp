#include "flexura/assembly/port_kinematics.hpp"

namespace flexura {

RelativePose relative_pose(const double (&q)[port_unknowns], const PortArms& arms,
                           const Eigen::Vector3d& load) {
  const Vec2 base_arm = rotate(q[base_turn], arms.base);
  const Vec2 action_arm = rotate(q[action_turn], arms.action);
  const Vec2 tip_arm = rotate(q[action_section], arms.tip);
  const Vec2 from_base =
      Vec2{q[action_x] - q[base_x], q[action_y] - q[base_y]} + action_arm + tip_arm - base_arm;
  const Vec2 e = unit(q[base_section]);
  const auto to_base = [e](Vec2 v) { return Vec2{e.x * v.x + e.y * v.y, e.x * v.y - e.y * v.x}; };

  RelativePose pose;
  const Vec2 p = to_base(from_base);
  pose.value << p.x, p.y, q[action_section] - q[base_section];

  const auto set_column = [&pose](int column, Vec2 v, double turn) {
    pose.jacobian.col(column) << v.x, v.y, turn;
  };
  set_column(action_x, to_base({1.0, 0.0}), 0.0);
  set_column(action_y, to_base({0.0, 1.0}), 0.0);
  set_column(base_x, -to_base({1.0, 0.0}), 0.0);
  set_column(base_y, -to_base({0.0, 1.0}), 0.0);
  set_column(action_turn, to_base(perp(action_arm)), 0.0);
  set_column(action_section, to_base(perp(tip_arm)), 1.0);
  set_column(base_turn, -to_base(perp(base_arm)), 0.0);
  set_column(base_section, -perp(p), -1.0);

  // f is the force in global axes; turning the base section turns it along.
  const Vec2 f = Vec2{e.x * load[0] - e.y * load[1], e.y * load[0] + e.x * load[1]};
  const Vec2 df = perp(f);
  auto& h = pose.hessian;
  h.setZero();
  h(action_turn, action_turn) = -dot(f, action_arm);
  h(action_section, action_section) = -dot(f, tip_arm);
  h(base_turn, base_turn) = dot(f, base_arm);
  h(base_section, base_section) = -dot(f, from_base);
  const auto set_mixed = [&h](int column, double v) {
    h(base_section, column) = v;
    h(column, base_section) = v;
  };
  set_mixed(action_x, df.x);
  set_mixed(action_y, df.y);
  set_mixed(base_x, -df.x);
  set_mixed(base_y, -df.y);
  set_mixed(action_turn, dot(f, action_arm));
  set_mixed(action_section, dot(f, tip_arm));
  set_mixed(base_turn, -dot(f, base_arm));
  return pose;
}

}  // namespace flexura

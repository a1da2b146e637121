// The relative pose of a flexure's ends and its two derivatives, by a second route: automatic
// differentiation of the same pose written in jets.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/assembly/port_kinematics.hpp"
#include "flexura/core/jet2.hpp"

namespace flexura {
namespace {

using Jet = Jet2<port_unknowns>;

struct JetPair {
  Jet x, y;
};

JetPair turned(const Jet& angle, Vec2 v) {
  const Jet c = cos(angle), s = sin(angle);
  return {v.x * c - v.y * s, v.x * s + v.y * c};
}

/// load . value, as the comment at relative_pose writes it.
Jet work(const double (&q)[port_unknowns], const PortArms& arms, const Eigen::Vector3d& load) {
  Jet u[port_unknowns];
  for (std::size_t k = 0; k < port_unknowns; ++k) u[k] = Jet::variable(k, q[k]);
  const JetPair base = turned(u[base_turn], arms.base);
  const JetPair action = turned(u[action_turn], arms.action);
  const JetPair tip = turned(u[action_section], arms.tip);
  const Jet dx = u[action_x] + action.x + tip.x - u[base_x] - base.x;
  const Jet dy = u[action_y] + action.y + tip.y - u[base_y] - base.y;
  const Jet c = cos(u[base_section]), s = sin(u[base_section]);
  const Jet x = c * dx + s * dy;
  const Jet y = c * dy - s * dx;
  return load[0] * x + load[1] * y + load[2] * (u[action_section] - u[base_section]);
}

const double pose[port_unknowns] = {0.3, -0.7, 0.4, 0.9, 2.1, 1.3, -1.1, -0.6};
const PortArms arms{{0.5, 0.2}, {-0.3, 0.8}, {0.11, -0.23}};

TEST(RelativePose, ValueIsThePoseInAxesOfTheBaseSection) {
  const RelativePose found = relative_pose(pose, arms, Eigen::Vector3d::Zero());
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d load = Eigen::Vector3d::Unit(k);
    EXPECT_NEAR(found.value[k], work(pose, arms, load).value, 1e-15);
  }
}

TEST(RelativePose, JacobianIsTheDerivative) {
  const RelativePose found = relative_pose(pose, arms, Eigen::Vector3d::Zero());
  for (int k = 0; k < 3; ++k) {
    const Jet jet = work(pose, arms, Eigen::Vector3d::Unit(k));
    for (int i = 0; i < port_unknowns; ++i)
      EXPECT_NEAR(found.jacobian(k, i), jet.gradient[static_cast<std::size_t>(i)], 1e-15);
  }
}

TEST(RelativePose, HessianIsTheSecondDerivative) {
  const Eigen::Vector3d load(1.7, -0.6, 2.9);
  const RelativePose found = relative_pose(pose, arms, load);
  const Jet jet = work(pose, arms, load);
  for (int i = 0; i < port_unknowns; ++i)
    for (int j = 0; j < port_unknowns; ++j)
      EXPECT_NEAR(found.hessian(i, j),
                  jet.second(static_cast<std::size_t>(i), static_cast<std::size_t>(j)), 1e-14)
          << i << j;
}

TEST(RelativePose, DoesNotChangeWhenEverythingMovesTogether) {
  const RelativePose before = relative_pose(pose, arms, Eigen::Vector3d::Zero());
  const double turn = 1.234;
  const Vec2 base = Vec2{5.0, -3.0} + rotate(turn, {pose[base_x], pose[base_y]});
  const Vec2 action = Vec2{5.0, -3.0} + rotate(turn, {pose[action_x], pose[action_y]});
  const double moved[port_unknowns] = {
      base.x,   base.y,   pose[base_turn] + turn,   pose[base_section] + turn,
      action.x, action.y, pose[action_turn] + turn, pose[action_section] + turn};
  const RelativePose after = relative_pose(moved, arms, Eigen::Vector3d::Zero());
  EXPECT_LT((after.value - before.value).norm(), 3e-15);
}

}  // namespace
}  // namespace flexura

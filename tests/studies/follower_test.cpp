// Loads that turn with their body, against an independent solution: shooting of the elastica by
// Runge-Kutta, written here.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

using ElasticaState = std::array<double, 4>;  // angle, moment, x, y

/// theta' = M, M' = -(cos theta F_y - sin theta F_x), r' = (cos theta, sin theta): EI = L = 1, no
/// axial or shear strain. From the tip (s = 1) back to the base.
Pose shoot_back(double tip_angle, Vec2 force, double moment) {
  const auto derivative = [&](const ElasticaState& s) -> ElasticaState {
    const double c = std::cos(s[0]), n = std::sin(s[0]);
    return {s[1], n * force.x - c * force.y, c, n};
  };
  ElasticaState s{tip_angle, moment, 0.0, 0.0};
  const int steps = 4000;
  const double h = -1.0 / steps;
  for (int k = 0; k < steps; ++k) {
    const auto at = [&](const ElasticaState& slope, double part) {
      ElasticaState out = s;
      for (std::size_t i = 0; i < 4; ++i) out[i] += part * h * slope[i];
      return out;
    };
    const auto k1 = derivative(s), k2 = derivative(at(k1, 0.5));
    const auto k3 = derivative(at(k2, 0.5)), k4 = derivative(at(k3, 1.0));
    for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6.0 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return {{s[2], s[3]}, s[0]};
}

/// A follower force keeps its angle to the tip: in axes of the tip the problem starts from known
/// values, and one pass back to the base solves it.
Pose follower_tip(Vec2 force_in_tip_axes, double moment) {
  const Pose base = shoot_back(0.0, force_in_tip_axes, moment);
  // turn and shift so that the base is at the origin with angle zero
  return {rotate(-base.rotation, -base.position), -base.rotation};
}

const Mechanism beam_of_one = cantilever({1e4, 1.0, 1e4});

class Follower : public ::testing::TestWithParam<double> {};

TEST_P(Follower, TransverseTipForceMatchesShooting) {
  const Pose truth = follower_tip({0.0, GetParam()}, 0.0);
  const Load load = beam_of_one.follower("tip", {0.0, GetParam()});
  for (const ModelingSettings& modeling : {exact(1e-10), beam(16, 4)}) {
    const Pose tip = final_pose(beam_of_one, {load}, in_theory(modeling, "i"), 1, 4);
    note_measured(modeling.label, distance(tip, truth, 1.0));
    EXPECT_LT(distance(tip, truth, 1.0), 1e-8) << modeling.label;
  }
}

TEST_P(Follower, ObliqueForceAndMomentMatchShooting) {
  const Vec2 force{-0.3 * GetParam(), 0.5 * GetParam()};
  const Pose truth = follower_tip(force, 0.8);
  const Load load = beam_of_one.follower("tip", force, 0.8);
  for (const ModelingSettings& modeling : {exact(1e-10), beam(16, 4)}) {
    const Pose tip = final_pose(beam_of_one, {load}, in_theory(modeling, "i"), 1, 4);
    EXPECT_LT(distance(tip, truth, 1.0), 1e-8) << modeling.label;
  }
}

INSTANTIATE_TEST_SUITE_P(Loads, Follower, ::testing::Values(0.5, 2.0, 5.0, 10.0, -7.0));

/// Of a dead load the direction stays; the tip bends less the more it turns.
TEST(FollowerAndDead, DifferAtLargeRotations) {
  const Pose dead = final_pose(beam_of_one, {beam_of_one.load("tip", {0.0, 3.0})}, exact(), 1, 3);
  const Pose follower =
      final_pose(beam_of_one, {beam_of_one.follower("tip", {0.0, 3.0})}, exact(), 1, 3);
  EXPECT_GT(follower.rotation, 1.2 * dead.rotation);
}

/// A moment is the same, following or not.
TEST(FollowerAndDead, AgreeForMoments) {
  const Mechanism chain = arc_chain();
  const Pose dead = final_pose(chain, {chain.load("link4", {}, 1e-2)}, exact(1e-11), 3, 5);
  const Pose follower = final_pose(chain, {chain.follower("link4", {}, 1e-2)}, exact(1e-11), 3, 5);
  EXPECT_LT(distance(dead, follower, 20.0), 1e-10);
}

/// The tangent is the derivative of the residual: from a prediction, Newton takes few iterations
/// though the load turns by more than a radian over the path.
TEST(FollowerTangent, KeepsNewtonsRate) {
  const Load load = beam_of_one.follower("tip", {0.0, 4.0});
  const TracedPath path = trace(beam_of_one, {load}, exact_modes(12), 10, false);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  note_measured("iterations_a_step", static_cast<double>(path.iterations) / path.steps);
  EXPECT_LE(path.iterations, 5 * path.steps);
}

/// The same force on an arm off the centre: the point's follower force is one at the centre and its
/// moment.
TEST(FollowerOnAPoint, IsAForceAndAMoment) {
  Mechanism beam_with_arm = cantilever({1e4, 1.0, 1e4});
  beam_with_arm.point("P", {1.2, 0.5});
  const Vec2 force{-0.7, 1.1};
  const double moment = cross({0.2, 0.5}, force);
  const Pose at_point =
      final_pose(beam_with_arm, {beam_with_arm.follower("tip.P", force)}, exact(1e-11), 1, 3);
  const Pose at_centre =
      final_pose(beam_with_arm, {beam_with_arm.follower("tip", force, moment)}, exact(1e-11), 1, 3);
  EXPECT_LT(distance(at_point, at_centre, 1.0), 1e-11);
}

}  // namespace
}  // namespace flexura::testing

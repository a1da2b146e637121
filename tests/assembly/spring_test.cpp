// Springs between bodies against closed forms, at rest, in large motion and to first order.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/newton.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

constexpr std::size_t ground = 0;
constexpr std::size_t tip = 1;

/// A cantilever from the origin to (1, 0), EI = 1, so that its tip gives 1/3 per transverse force.
SystemLayout leaf(const ModelingSettings& settings, const Mechanism& m,
                  const std::vector<Load>& loads) {
  return make_layout(m, loads, in_theory(settings, "i"));
}

std::vector<double> solved(System& system, double factor) {
  std::vector<double> z = system.initial_state();
  for (int k = 1; k <= 8; ++k) {
    system.set_load_factor(factor * k / 8.0);
    EXPECT_EQ(Newton({1e-13, 30, 6}).solve(system, z).outcome, NewtonOutcome::converged);
  }
  EXPECT_TRUE(system.linearize(z));
  return z;
}

TEST(Springs, AddTheirStiffnessToTheLeafsToFirstOrder) {
  const Mechanism m = cantilever({1e4, 1.0, 1e4});
  SystemLayout layout = leaf(linear(), m, {m.load("tip", {0.0, 0.01})});
  const Vec2 foot = Vec2{1.0, -0.5} - layout.bodies[ground].centre;
  layout.springs.push_back({ground, tip, foot, {}, 2.0, 0.5, false});
  System system(layout);
  const auto z = solved(system, 1.0);
  EXPECT_NEAR(system.pose(tip, z).position.y, 0.01 / (3.0 + 2.0), 1e-15);
  EXPECT_NEAR(system.strain_energy(), 0.5 * 0.01 * 0.01 / 5.0, 1e-16);
  // the ground holds what the load puts in
  EXPECT_NEAR(system.reaction(ground, z)[1], -0.01, 1e-15);
}

/// A moment bends the leaf to an arc whatever its size: EI/L and the spring act in parallel.
TEST(Springs, InTorsionActInParallelThroughLargeRotations) {
  const Mechanism m = cantilever({1e4, 1.0, 1e4});
  SystemLayout layout = leaf(exact_modes(8), m, {m.load("tip", {}, 6.0)});
  layout.springs.push_back({ground, tip, {}, {}, 2.0, 0.0, true});
  System system(layout);
  const auto z = solved(system, 1.0);
  EXPECT_NEAR(system.pose(tip, z).rotation, 2.0, 1e-12);
  EXPECT_NEAR(system.pose(tip, z).position.x, std::sin(2.0) / 2.0, 1e-9);
  EXPECT_NEAR(system.strain_energy(), 0.5 * 3.0 * 4.0, 1e-11);
  EXPECT_NEAR(system.reaction(ground, z)[2], -6.0, 1e-10);
}

/// The spring replaced by the force it exerts holds the same state.
TEST(Springs, AreTheForceAlongTheLineBetweenTheirPoints) {
  const Mechanism m = cantilever({1e4, 1.0, 1e4});
  SystemLayout layout = leaf(exact_modes(12), m, {m.load("tip", {0.0, 4.0})});
  const Vec2 at{1.0, -0.5};
  const Vec2 arm{0.1, 0.05};
  const Vec2 drawn = layout.bodies[tip].centre + arm;
  layout.springs.push_back(
      {ground, tip, at - layout.bodies[ground].centre, arm, 2.5, norm(drawn - at), false});
  System system(layout);
  const auto z = solved(system, 1.0);
  const Vec2 line = system.moved_point(tip, drawn, z) - at;
  const double pull = 2.5 * (norm(line) - norm(drawn - at));
  const Vec2 force = (-pull / norm(line)) * line;
  EXPECT_GT(pull, 0.5);

  SystemLayout pulled = leaf(exact_modes(12), m, {m.load("tip", {0.0, 4.0})});
  pulled.loads.push_back({tip, arm, force, 0.0, false});
  System alone(pulled);
  alone.set_load_factor(1.0);
  ASSERT_TRUE(alone.linearize(z));
  std::vector<double> step;
  EXPECT_LT(alone.newton_step(step), 1e-11);
  EXPECT_NEAR(system.strain_energy() - alone.strain_energy(), 0.5 * pull * pull / 2.5, 1e-12);
}

}  // namespace
}  // namespace flexura::testing

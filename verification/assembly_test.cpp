// Mechanisms put together from parts that do not fit as drawn. Closed forms: springs and flexures
// in series and parallel, to first order (rounding) and, for moments, which bend a flexure to an
// arc, at any rotation (1e-9). Beyond: whatever comes first, the end is the same equilibrium (1e-9,
// the modelings' tolerance), and the path's direction is its slope (fourth-order differences).
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/newton.hpp"
#include "flexura/studies/path_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr std::size_t tip = 1;

Spring spring_on(const Mechanism& m, double stiffness, bool torsional) {
  Spring spring;
  spring.name = "spring";
  spring.base = {m.index("ground"), std::nullopt};
  spring.action = {m.index("tip"), std::nullopt};
  spring.stiffness = stiffness;
  spring.torsional = torsional;
  return spring;
}

TracedPath assembled(const Model& model, const std::vector<Load>& loads,
                     const ModelingSettings& settings, int steps = 2) {
  TracedPath path = trace(model, loads, settings, steps);
  EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
  return path;
}

/// The force of a spring pulls the cantilever's tip towards the ground's point below it; tip and
/// spring share it in parallel.
TEST(Assembly, ASpringWithItsFreeLengthPullsTheTip) {
  const double k = 2.0;
  Mechanism m = cantilever({1e4, 1.0, 1e4});
  for (const bool by_force : {false, true}) {
    Model model = m;
    model.bodies[0].points.push_back({"foot", {1.0, -0.5}});
    Spring spring = spring_on(m, k, false);
    spring.base.point = model.bodies[0].points.size() - 1;
    if (by_force)
      spring.preload = 0.02;
    else
      spring.free = 0.49;
    model.springs.push_back(spring);
    const TracedPath path =
        assembled(model, {m.load("tip", {0.0, 0.01})}, in_theory(linear(), "i"), 1);
    EXPECT_NEAR(pose_in(path, 0, tip).position.y, -0.02 / (3.0 + k), 1e-15);
    EXPECT_NEAR(pose_in(path, 1, tip).position.y, -0.01 / (3.0 + k), 1e-15);
  }
}

/// A torsion spring with a free angle and a leaf fastened at an angle share the turn between them,
/// whatever its size: only a moment passes.
TEST(Assembly, MomentsShareTheTurnAtAnySize) {
  const double k = 2.0, angle = 1.2;
  for (const bool by_leaf : {false, true}) {
    const Mechanism m = cantilever({1e4, 1.0, 1e4});
    Model model = m;
    Spring spring = spring_on(m, k, true);
    if (by_leaf)
      model.flexures[0].misfit_rotation = -angle;
    else
      spring.free = angle;
    model.springs.push_back(spring);
    const TracedPath path = assembled(model, {}, exact(1e-11));
    // EI/L = 1: the leaf turns by theta, the body by theta + angle of the leaf
    const double turn = by_leaf ? angle / (1.0 + k) : k * angle / (1.0 + k);
    const double leaf = by_leaf ? turn - angle : turn;
    const Pose pose = pose_in(path, 0, tip);
    EXPECT_NEAR(pose.rotation, turn, 1e-9);
    EXPECT_NEAR(pose.position.x, std::sin(leaf) / leaf, 1e-9);
    EXPECT_NEAR(pose.position.y, (1.0 - std::cos(leaf)) / leaf, 1e-9);
  }
}

/// A bar drawn between two walls by a stage in its middle, one half too long: N = EA misfit/2L,
/// the stage moves by half the misfit. The misfit lies on the wall's side.
TEST(Assembly, ABarTooLongIsCompressed) {
  const double off = 1e-3;
  Mechanism m;
  m.fixed("ground").body("stage").fixed("wall");
  with_stiffness(m, {1e3, 1.0, 1e3});
  m.flexure("ground", "stage", LineAxis{{0.0, 0.0}, {1.0, 0.0}});
  m.flexure("stage", "wall", LineAxis{{1.0, 0.0}, {2.0, 0.0}});
  Model model = m;
  model.flexures[1].misfit = {-off, 0.0};
  const TracedPath path = assembled(model, {}, linear());
  EXPECT_NEAR(pose_in(path, 0, 1).position.x, 1.0 - 0.5 * off, 1e-15);
  EXPECT_NEAR(member_load_in(path, 0, 0)[0], -1e3 * 0.5 * off, 1e-11);
}

struct AssembledChain {
  Model model;
  std::vector<Load> loads;
};

/// The arc chain with a leaf that does not fit, a tight spring, and two loads.
AssembledChain tight_chain() {
  const Mechanism m = arc_chain();
  AssembledChain chain{m, {m.load("link4.E", {4e-4, 0.0}), m.load("link4.E", {0.0, 2e-4}, 1e-3)}};
  chain.model.flexures[1].misfit = {0.3, -0.2};
  chain.model.flexures[1].misfit_rotation = 0.1;
  Spring spring;
  spring.name = "tight";
  spring.base = {m.index("ground"), std::nullopt};
  spring.action = chain.loads[0].point ? SpringEnd{chain.loads[0].body, chain.loads[0].point}
                                       : SpringEnd{chain.loads[0].body, std::nullopt};
  spring.stiffness = 1e-4;
  spring.free = 21.0;
  chain.model.springs.push_back(spring);
  return chain;
}

class AssembledModelings : public ::testing::TestWithParam<ModelingSettings> {};

TEST_P(AssembledModelings, EndInTheSamePlaceWhateverComesFirst) {
  AssembledChain chain = tight_chain();
  const std::size_t link = chain.loads[0].body;
  const auto end = [&](bool first, bool second) {
    chain.loads[0].constant = first;
    chain.loads[1].constant = second;
    const TracedPath path = assembled(chain.model, chain.loads, GetParam());
    return pose_in(path, path.states.size() - 1, link);
  };
  const Pose together = end(false, false);
  const double one = distance(end(true, false), together, 20.0);
  const double other = distance(end(false, true), together, 20.0);
  const double all = distance(end(true, true), together, 20.0);
  note_measured("largest", std::max({one, other, all}));
  EXPECT_LT(one, 1e-9);
  EXPECT_LT(other, 1e-9);
  EXPECT_LT(all, 1e-9);
}

/// While it is assembled, too, the direction of the path is its derivative, and the work that of
/// the displacements.
TEST_P(AssembledModelings, DirectionIsTheSlopeOfThePath) {
  AssembledChain chain = tight_chain();
  chain.loads[0].constant = true;
  System system(make_layout(chain.model, chain.loads, GetParam()));
  system.set_assembling(true);
  Newton newton({1e-13, 40, 10});
  std::vector<double> z = system.initial_state();
  const auto solve = [&](double share) {
    system.set_load_factor(share);
    const auto outcome = newton.solve(system, z).outcome;
    EXPECT_EQ(outcome, NewtonOutcome::converged);
    EXPECT_TRUE(system.linearize(z));
    return z;
  };
  for (int k = 1; k <= 10; ++k) solve(0.05 * k);
  std::vector<double> direction;
  system.load_direction(direction);
  const double rate = system.load_rate(direction);
  const double h = 1e-3;
  double displacement[5], stored[5];
  std::vector<std::vector<double>> at;
  for (int k = -2; k <= 2; ++k) {
    at.push_back(solve(0.5 + k * h));
    displacement[k + 2] = system.load_displacement(z);
    stored[k + 2] = system.stored_energy(z);
  }
  const auto slope = [&](auto value) {
    return (8.0 * (value(3) - value(1)) - value(4) + value(0)) / (12.0 * h);
  };
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const double found = slope([&](std::size_t k) { return at[k][i]; });
    worst = std::max(worst, std::abs(found - direction[i]));
    largest = std::max(largest, std::abs(direction[i]));
  }
  note_measured("direction", worst / largest);
  EXPECT_LT(worst, 1e-7 * largest);
  const double by_share = slope([&](std::size_t k) { return displacement[k]; });
  note_measured("rate", rate / by_share - 1.0);
  EXPECT_NEAR(rate, by_share, 1e-6 * std::abs(by_share));
  EXPECT_NEAR(slope([&](std::size_t k) { return stored[k]; }), 0.5 * by_share,
              1e-6 * std::abs(by_share));
}

INSTANTIATE_TEST_SUITE_P(Verification, AssembledModelings,
                         ::testing::Values(linear(), scmbm_centre(), prbm(), exact_modes(12),
                                           in_theory(exact_modes(12), "i"), beam(8, 4),
                                           von_karman(16)),
                         [](const auto& test) {
                           return test.param.label + (test.param.axial ? "" : "_inextensible");
                         });

/// Gravity that is there first, and gravity that grows with the rest, end alike.
TEST(Assembly, ConstantSurroundingsEndWhereGrowingOnesDo) {
  Mechanism m = single_flexure(ArcAxis{{0.0, 10.0}, 10.0, -1.5, 1.5});
  Model model = m;
  model.materials[0].thermal_expansion = 1e-4;
  for (const ModelingSettings& settings : {linear(), exact_modes(12), beam(8, 4)}) {
    TraceOptions options;
    options.steps = 3;
    options.fields.spread = {{0, {0.0, -2e-4}}};
    options.fields.temperature = 30.0;
    const auto end = [&](bool constant) {
      options.fields.constant = constant;
      const TracedPath path = trace_path(model, {m.load("stage", {1e-3, 1e-3})}, settings, options);
      EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
      return pose_in(path, path.states.size() - 1, 1);
    };
    EXPECT_LT(distance(end(true), end(false), 10.0), 1e-9) << settings.label;
  }
}

/// Two half beams squeezed until they bow: assembly passes the bifurcation and says that the
/// straight state it ends in is unstable.
TEST(Assembly, SaysThatWhatItEndsInIsUnstable) {
  Mechanism m;
  m.fixed("ground").body("stage").fixed("wall");
  with_stiffness(m, {1e3, 1.0, 1e3});
  m.flexure("ground", "stage", LineAxis{{0.0, 0.0}, {1.0, 0.0}});
  m.flexure("stage", "wall", LineAxis{{1.0, 0.0}, {2.0, 0.0}});
  Model model = m;
  model.flexures[1].misfit = {-0.04, 0.0};  // Euler's load is at 4 pi^2/L^2/EA = 0.0197
  const TracedPath path = assembled(model, {}, exact(1e-10));
  EXPECT_EQ(path.states[0].unstable_directions, 1);
  ASSERT_FALSE(path.events.empty());
  EXPECT_EQ(path.events[0].kind, "stability lost");
}

}  // namespace
}  // namespace flexura::testing

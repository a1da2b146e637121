// What random mechanisms brought to light (docs/robustness.md): slender stages that were taken for
// singular, tight bands without an estimate of their error, and limit loads that more modes change.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/tracing.hpp"

namespace flexura {
namespace {

using testing::Mechanism;

ModelingSettings exact(std::optional<int> modes) {
  return {ExactSettings{modes}, "exact", true, true, 1e-8, {}};
}

/// Four legs up and four down, some of which keep their load as an unknown and some not.
Mechanism folded_stage() {
  Mechanism m;
  m.material(114e3, 0.3).fixed("ground").body("middle").point("P", {0, 300}).body("stage");
  m.point("P", {0, 0});
  const double thicknesses[] = {0.08, 0.056, 0.15, 0.056};
  for (int level = 0; level < 2; ++level) {
    for (int leg = 0; leg < 4; ++leg) {
      const double x = -300.0 + 200.0 * leg + 30.0 * level;
      m.section(RectangleSection{thicknesses[leg], 0.4, LeafProfile{}, LeafProfile{}});
      if (level == 0)
        m.flexure("ground", "middle", LineAxis{{x, 0}, {0.8 * x, 300}});
      else
        m.flexure("middle", "stage", LineAxis{{x, 300}, {0.7 * x, 0}});
    }
  }
  return m;
}

TEST(SlenderPath, StagesOfVerySlenderLeavesAreNotSingular) {
  const Mechanism m = folded_stage();
  for (const bool follower : {false, true}) {
    const Load load =
        follower ? m.follower("stage.P", {1e-6, 0.0}) : m.load("stage.P", {1e-6, 0.0});
    const TracedPath path = testing::trace(m.model(), {load}, exact({}), 4);
    EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
  }
}

/// As slender, but really free: a body on a single pin turns.
TEST(SlenderPath, MechanismsThatMoveFreelyStillAre) {
  Mechanism m;
  m.material(114e3, 0.3).fixed("ground").body("stage").point("P", {100, 300});
  m.section(RectangleSection{0.06, 0.4, LeafProfile{}, LeafProfile{}});
  m.flexure("ground", "stage", LineAxis{{0, 0}, {0, 300}}).pin_base();
  const TracedPath path = testing::trace(m.model(), {m.load("stage.P", {1e-6, 0.0})}, exact({}), 4);
  EXPECT_FALSE(path.termination.converged());
  EXPECT_NE(path.termination.reason.find("singular"), std::string::npos);
}

/// Pulled by 60,000 EI/L^2 it bends within L/240 of its ends only.
TEST(SlenderPath, TightBandsKnowTheirError) {
  Mechanism m;
  m.material(210e3, 0.3).fixed("ground").body("stage").point("P", {50, 0});
  m.section(RectangleSection{0.05, 10.0, LeafProfile{}, LeafProfile{}});
  m.flexure("ground", "stage", LineAxis{{0, 0}, {50, 0}});
  Load pull = m.load("stage.P", {520.0, 0.0});
  pull.constant = true;
  const std::vector<Load> loads = {pull, m.load("stage.P", {0.0, 200.0})};
  const TracedPath by_modes = testing::trace(m.model(), loads, exact({}), 10);
  const TracedPath by_elements = testing::trace(m.model(), loads, testing::beam(40, 7), 10);
  ASSERT_TRUE(by_modes.termination.converged());
  ASSERT_TRUE(by_elements.termination.converged());
  const TracedState& end = by_modes.states.back();
  ASSERT_FALSE(end.errors.empty());
  const double off = norm(testing::point_in(by_modes, 10, 1, {50, 0}) -
                          testing::point_in(by_elements, 10, 1, {50, 0}));
  EXPECT_LT(off, 2e-5 * 50.0);
  EXPECT_GT(end.errors[0], 0.3 * off);
  EXPECT_LT(end.errors[0], 30.0 * off);
}

double limit_load(const Mechanism& arch, const ModelingSettings& settings, double force) {
  const TracedPath path =
      testing::trace(arch.model(), {arch.load("top.P", {0.0, -force})}, settings, 20);
  for (const TracedEvent& event : path.events)
    if (event.kind == "limit point") return event.load_factor * force;
  ADD_FAILURE() << path.termination.reason;
  return NAN;
}

/// The limit point lies within the first of the steps, where no state was estimated yet.
TEST(SlenderPath, LimitLoadsAreAsGoodAsTheTolerance) {
  Mechanism arch;
  arch.material(70e3, 0.3).section(RectangleSection{0.1, 1.0, LeafProfile{}, LeafProfile{}});
  arch.fixed("ground").body("top").point("P", {0.3, 2.0});
  arch.flexure("ground", "top", LineAxis{{-10.0, 0.0}, {0.3, 2.0}});
  arch.flexure("ground", "top", LineAxis{{10.0, 0.0}, {0.3, 2.0}});
  const double reference = limit_load(arch, exact(30), 10.0);
  EXPECT_NEAR(limit_load(arch, exact({}), 500.0) / reference, 1.0, 1e-8);
}

/// A stage on two leaves that a strut, pinned at both ends and bowed by `rise`, holds back until it
/// buckles by itself at P = pi^2 EI/L^2. No body moves then but by what the strut gives way.
Mechanism propped_stage(double rise) {
  Mechanism m;
  m.material(200e3, 0.3).fixed("ground").body("stage").point("P", {0.0, 50.0});
  m.section(RectangleSection{0.1, 10.0});
  m.flexure("ground", "stage", LineAxis{{0.0, 0.0}, {0.0, 50.0}});
  m.flexure("ground", "stage", LineAxis{{20.0, 0.0}, {20.0, 50.0}});
  m.section(RectangleSection{0.02, 1.0});
  const double length = 100.0, radius = length * length / (8.0 * rise);
  const double half = std::asin(0.5 * length / radius);
  m.flexure("stage", "ground",
            ArcAxis{{20.0 + 0.5 * length, 50.0 - radius * std::cos(half)},
                    radius,
                    0.5 * std::numbers::pi + half,
                    -2.0 * half});
  m.pin_base().pin_action();
  return m;
}

/// Past a narrow gap the straight strut, unstable, goes on as if nothing had happened; the bowed
/// one gives way, and the leaves carry what is beyond P: F = P + k x, k = 2 * 12 EI/h^3.
TEST(SlenderPath, AStrutThatBucklesByItselfTurnsThePathOff) {
  const double strut =
      std::numbers::pi * std::numbers::pi * 200e3 * 0.02 * 0.02 * 0.02 / 12.0 / 1e4;
  const double leaves = 24.0 * 200e3 * 10.0 * 1e-3 / 12.0 / (50.0 * 50.0 * 50.0);
  for (const double rise : {1e-3, 1e-5}) {
    const Mechanism m = propped_stage(rise);
    for (const int steps : {4, 60}) {
      const TracedPath path =
          testing::trace(m.model(), {m.load("stage.P", {2.0 * strut, 0.0})}, exact({}), steps);
      ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
      EXPECT_EQ(path.states.back().unstable_directions, 0) << rise << ' ' << steps;
      const System& system = *path.systems[path.states.back().system];
      const double moved = system.moved_point(1, {0.0, 50.0}, path.states.back().z).x;
      EXPECT_NEAR(moved * leaves / strut, 1.0, 0.01) << rise << ' ' << steps;
    }
  }
}

/// A moment in the wrong unit, a thousand times too large: 700 rad of a strip.
TEST(SlenderPath, AFlexureThatWindsUpSaysSo) {
  Mechanism m;
  m.material(210e3, 0.3).section(RectangleSection{0.1, 10.0});
  m.fixed("ground").body("arm").point("end", {160.0, 40.0});
  m.flexure("ground", "arm", LineAxis{{0.0, 0.0}, {100.0, 0.0}});
  const Load push = m.follower("arm.end", {0.0, 0.5});
  Load twist = m.load("arm.end", {0.0, 0.0});
  twist.moment = 70e3;
  const TracedPath path = testing::trace(m.model(), {push, twist}, exact({}), 20);
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_NE(path.termination.reason.find("winds up"), std::string::npos) << path.termination.reason;
  ASSERT_FALSE(path.states.empty());
  const TracedState& last = path.states.back();
  EXPECT_GT(path.systems[last.system]->largest_turn(last.z), 6.0 * std::numbers::pi);
  EXPECT_LT(last.load_factor, 1.0);
}

}  // namespace
}  // namespace flexura

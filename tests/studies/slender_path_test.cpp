// What random mechanisms brought to light (docs/robustness.md): slender stages that were taken for
// singular, and limit loads that more modes would change.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace flexura

// Figures and messages stand for something or are left out: no estimate from a state that has none,
// no difference from a reference that never left the start, no limit point where the load is merely
// huge.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "flexura/results/path_result.hpp"
#include "flexura/studies/path_study.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

const Stiffness strip{1e4, 1.0, 4e3};

ModelingPath run(const Mechanism& mechanism, const Load& load, const ModelingSettings& settings) {
  PathStudy study;
  study.loads = {load};
  study.steps = 4;
  return run_path(mechanism, study, settings, [](double) { return true; });
}

TEST(HonestFigures, AHugeTransverseLoadHasNoLimitPoint) {
  const Mechanism mechanism = cantilever(strip);
  for (const double size : {1e4, 1e7, 1e9, 1e11})
    for (const ModelingSettings& modeling : {prbm(), scmbm_centre(), exact(1e-8), beam(8, 2)}) {
      const TracedPath path = trace(mechanism, {mechanism.load("tip", {0.0, size})}, modeling, 4);
      for (const TracedEvent& event : path.events)
        EXPECT_GT(event.load_factor, 0.0) << modeling.label << " at " << size;
      EXPECT_EQ(path.termination.reason.find("by -"), std::string::npos);
    }
}

TEST(HonestFigures, AnEstimateCoversEveryStateOrIsLeftOut) {
  const Mechanism mechanism = cantilever(strip);
  const ModelingPath good = run(mechanism, mechanism.load("tip", {0.0, 1.0}), exact_modes(6));
  ASSERT_TRUE(good.error_estimate);
  EXPECT_GT(*good.error_estimate, 0.0);
  // far too few modes for such a load: the finer flexure has no solution near some states
  const TracedPath traced =
      trace(mechanism, {mechanism.load("tip", {0.0, 3e3})}, exact_modes(2), 4);
  bool all = traced.states.size() > 1;
  for (const TracedState& state : traced.states) all = all && !state.errors.empty();
  const ModelingPath poor = run(mechanism, mechanism.load("tip", {0.0, 3e3}), exact_modes(2));
  EXPECT_EQ(poor.error_estimate.has_value(), all);
}

TEST(HonestFigures, NothingIsComparedWithAReferenceThatNeverMoved) {
  const Mechanism mechanism = cantilever(strip);
  PathResult result;
  result.modelings.push_back(run(mechanism, mechanism.load("tip", {0.0, 1.0}), prbm()));
  result.modelings.push_back(run(mechanism, mechanism.load("tip", {0.0, 1.0}), exact(1e-8)));
  result.reference = 1;
  compare_with_reference(result);
  EXPECT_TRUE(result.modelings[0].difference);
  EXPECT_FALSE(result.modelings[1].difference);
  result.modelings[0].difference.reset();
  result.modelings[1].states.resize(1);
  compare_with_reference(result);
  EXPECT_FALSE(result.modelings[0].difference);
}

TEST(HonestFigures, RoundingIsNoDifference) {
  const Mechanism mechanism = cantilever(strip);
  PathResult result;
  for (const ModelingSettings& modeling : {linear(), exact(1e-8)})
    result.modelings.push_back(run(mechanism, mechanism.load("tip", {0.0, 0.0}), modeling));
  result.reference = 1;
  compare_with_reference(result);
  EXPECT_EQ(result.modelings[0].difference, 0.0);
  EXPECT_EQ(result.modelings[1].error_estimate, 0.0);
}

/// Each modeling goes a step of its own beyond the limit point that ends its path.
TEST(HonestFigures, EndsSomewhereBehindLimitPointsAreNotCompared) {
  Mechanism arch;
  arch.material(210e3, 0.3).fixed("ground").body("crown");
  arch.section(RectangleSection{0.5, 10.0, LeafProfile{}, LeafProfile{}});
  arch.flexure("ground", "crown", LineAxis{{-50, 0}, {0, 2}});
  arch.flexure("ground", "crown", LineAxis{{50, 0}, {0, 2}});
  PathStudy study;
  study.loads = {arch.load("crown", {0.0, -100.0})};
  study.arc_length = true;
  study.until.limit_points = 1;
  const auto traced = [&](const ModelingSettings& settings, int steps) {
    study.steps = steps;
    return run_path(arch.model(), study, settings, [](double) { return true; });
  };
  PathResult result;
  result.by_arc_length = true;
  result.modelings = {traced(exact(1e-8), 20), traced(beam(8, 3), 33)};
  for (const ModelingPath& path : result.modelings) {
    ASSERT_FALSE(path.events.empty()) << path.label;
    EXPECT_EQ(path.events.back().kind, "limit point");
  }
  EXPECT_GT(std::abs(result.modelings[0].states.back().load_factor -
                     result.modelings[1].states.back().load_factor),
            1e-6);
  compare_with_reference(result);
  ASSERT_TRUE(result.modelings[1].difference);
  EXPECT_LT(*result.modelings[1].difference, 1e-5);
}

}  // namespace
}  // namespace flexura::testing

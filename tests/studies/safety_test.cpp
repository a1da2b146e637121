// Stresses along a path against a stated strength.
#include "flexura/results/safety.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flexura/results/extremes.hpp"
#include "flexura/studies/run_studies.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

PathResult run(Model model, PathStudy study) {
  model.studies = {{"push", std::move(study), {}}};
  return std::get<PathResult>(run_studies(model, {}).studies.at(0).content);
}

PathStudy push_chain(int steps) {
  PathStudy study;
  study.loads = {arc_chain().load("link4.E", {5e-4, 0.0})};
  study.steps = steps;
  study.modelings = {linear(), scmbm_centre(), prbm(), exact(1e-8), beam(12, 2), bcm(4)};
  return study;
}

TEST(Safety, EveryStateKnowsItsPeakStresses) {
  const PathResult path = run(arc_chain(), push_chain(4));
  for (const ModelingPath& modeling : path.modelings) {
    ASSERT_EQ(modeling.states.size(), 5U) << modeling.label;
    for (const double stress : modeling.states.front().peak_stresses)
      EXPECT_NEAR(stress, 0.0, 1e-12) << modeling.label;
    const std::vector<double>& peaks = modeling.states.back().peak_stresses;
    ASSERT_EQ(peaks.size(), 3U);
    double most = 0.0;
    for (const double stress : peaks) most = std::max(most, stress);
    EXPECT_EQ(most, find_extreme(modeling, &MemberStation::stress)->value) << modeling.label;
  }
}

TEST(Safety, SectionsThatVaryAreStressedWhereTheyAreThin) {
  Mechanism leaf = single_flexure(LineAxis{{0.0, 0.0}, {10.0, 0.0}});
  Model model = leaf.model();
  model.sections[0].shape = RectangleSection{0.4, 1.0, TaperProfile{0.1}};
  PathStudy bend;
  bend.loads = {leaf.load("stage", {}, 1e-3)};
  bend.modelings = {exact(1e-8)};
  const PathResult path = run(model, bend);
  // M/W at the thin end
  EXPECT_NEAR(path.modelings[0].states.back().peak_stresses[0], 1e-3 * 6.0 / 0.01, 1e-9);
}

TEST(Safety, NothingIsSaidWithoutAStrength) {
  const PathResult path = run(arc_chain(), push_chain(2));
  for (const ModelingPath& modeling : path.modelings)
    EXPECT_FALSE(find_safety(path, modeling).has_value());
}

TEST(Safety, TheTravelAtTheStrengthIsThatOfThePathThere) {
  Model model = arc_chain();
  const PathResult whole = run(model, push_chain(20));
  const double strength = 0.6 * find_extreme(whole.modelings[3], &MemberStation::stress)->value;
  model.materials[0].strength = strength;
  const PathResult path = run(model, push_chain(20));
  for (const ModelingPath& modeling : path.modelings) {
    const Safety safety = find_safety(path, modeling).value();
    EXPECT_LT(safety.factor.value(), 1.0) << modeling.label;
    ASSERT_TRUE(safety.reached.has_value()) << modeling.label;
    // a path that ends there ends with the strength, and with that displacement
    PathStudy there = push_chain(10);
    there.loads[0].force = safety.reached->load_factor * there.loads[0].force;
    const PathResult end = run(model, there);
    for (const ModelingPath& same : end.modelings) {
      if (same.label != modeling.label) continue;
      EXPECT_NEAR(find_safety(end, same)->factor.value(), 1.0, 1e-4) << modeling.label;
      const Vec2 moved = same.states.back().points[0] - same.states.front().points[0];
      EXPECT_LT(norm(moved - safety.reached->displacements[0]), 1e-4 * norm(moved));
    }
  }
}

/// A path whose load turns back: stresses and displacements as given, load rising and falling.
TEST(Safety, IsFoundWhereTheLoadTurnsBack) {
  PathResult path;
  path.flexures = {"leaf"};
  path.points = {"stage.P"};
  path.strengths = {2.5};
  ModelingPath modeling;
  for (const double t : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    PathState state;
    state.load_factor = t * (3.0 - t);
    state.points = {{t * t, 1.0}};
    state.peak_stresses = {t};
    modeling.states.push_back(state);
  }
  const Safety safety = find_safety(path, modeling).value();
  EXPECT_EQ(safety.factor, 2.5 / 4.0);
  EXPECT_NEAR(safety.reached->load_factor, 2.5 * 0.5, 1e-12);
  EXPECT_NEAR(safety.reached->displacements[0].x, 6.25, 1e-12);
  EXPECT_NEAR(safety.reached->displacements[0].y, 0.0, 1e-12);
}

TEST(Safety, IsNotMissedBeforeALastStateOfLittleStress) {
  PathResult path;
  path.flexures = {"a", "b"};
  path.strengths = {10.0, {}};
  ModelingPath modeling;
  for (const double stress : {0.0, 8.0, 14.0, 5.0}) {
    PathState state;
    state.load_factor = static_cast<double>(modeling.states.size());
    state.peak_stresses = {stress, 100.0};
    modeling.states.push_back(state);
  }
  const Safety safety = find_safety(path, modeling).value();
  EXPECT_EQ(safety.factor, 2.0);
  EXPECT_EQ(safety.flexure, 0U);
  ASSERT_TRUE(safety.reached.has_value());
  EXPECT_GT(safety.reached->load_factor, 1.0);
  EXPECT_LT(safety.reached->load_factor, 2.0);
}

}  // namespace
}  // namespace flexura::testing

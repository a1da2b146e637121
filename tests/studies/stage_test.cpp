// Stage metrics and condensed stiffness against closed forms of beams, and against the path itself.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

#include "flexura/studies/path_study.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

ModelingPath run_stage(const Mechanism& mechanism, std::vector<Load> loads, StageSettings stage,
                       int steps, std::vector<std::size_t> condense = {}) {
  PathStudy study;
  study.loads = std::move(loads);
  study.steps = steps;
  study.stage = stage;
  study.condense = std::move(condense);
  return run_path(mechanism, study, in_theory(exact(1e-11), "i"), {});
}

TEST(Stage, CantileverAtRest) {
  Mechanism elastic = cantilever({500.0, 2.0, 1.0});
  PathStudy study;
  study.loads = {elastic.load("tip", {0.0, 1e-6})};
  study.steps = 1;
  study.stage = StageSettings{{elastic.index("tip"), {}, {}}, {}};
  ModelingSettings settings = exact(1e-11);
  settings.shear = false;
  const ModelingPath path = run_path(elastic, study, settings, {});
  ASSERT_TRUE(path.stage.at(0).has_value());
  const StageState& rest = *path.stage[0];
  const double expected[9] = {500, 0, 0, 0, 24, -12, 0, -12, 8};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR((*rest.stiffness)[i], expected[i], 1e-7) << i;
  EXPECT_NEAR(*rest.soft, 6.0, 1e-9);  // 3 EI/L^3
  EXPECT_NEAR(*rest.stiff, 500.0, 1e-7);
  EXPECT_NEAR(std::abs(rest.soft_direction), M_PI / 2.0, 1e-9);
  // v/phi = (FL^3/3EI)/(FL^2/2EI) = 2L/3 behind the tip
  ASSERT_TRUE(rest.instant_centre.has_value());
  EXPECT_NEAR(rest.instant_centre->x, 1.0 / 3.0, 1e-8);
  EXPECT_NEAR(rest.instant_centre->y, 0.0, 1e-8);
}

TEST(Stage, StiffnessIsTheSlopeOfThePath) {
  const Mechanism chain = arc_chain();
  const Load load = chain.load("link4.E", {1e-3, 0.0});
  const StageSettings stage{{load.body, load.point, Vec2{1.0, 0.0}}, {}};
  const ModelingPath path = run_stage(chain, {load}, stage, 200);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  // the displacement by dF alone: compliance c_xx, from the inverse of the stiffness
  const std::size_t k = 100;
  const auto& s = *path.stage[k]->stiffness;
  Eigen::Matrix3d stiffness;
  stiffness << s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8];
  const double compliance = stiffness.inverse()(0, 0);
  const double slope = (path.stage[k + 1]->along - path.stage[k - 1]->along) / (2.0 * 1e-3 / 200.0);
  EXPECT_NEAR(compliance / slope, 1.0, 1e-4);  // the difference's own error, (1/200)^2
}

TEST(Stage, ParallelogramShortensByThreeFifths) {
  const Mechanism stage = parallelogram();
  const Load load = stage.load("stage", {0.0, 0.05});
  const ModelingPath path = run_stage(stage, {load}, {{load.body, {}, Vec2{0.0, 1.0}}, {}}, 4);
  const StageState& last = *path.stage.back();
  EXPECT_GT(std::abs(last.along), 1e-3);
  // 3/5 delta^2/L of a guided leaf of length 50
  EXPECT_NEAR(std::abs(last.across) / (0.6 * last.along * last.along / 50.0), 1.0, 1e-2);
  EXPECT_LT(std::abs(last.rotation), 1e-3 * std::abs(last.along));
}

TEST(Stage, AdvantagesOfSwappedPlacesAreReciprocal) {
  const Mechanism chain = arc_chain();
  const Load load = chain.load("link4.E", {1e-4, 0.0});
  const DirectedPlace e{load.body, load.point, Vec2{1.0, 0.0}};
  const DirectedPlace middle{chain.index("link3"), {}, Vec2{0.3, 1.0}};
  const ModelingPath forth = run_stage(chain, {load}, {e, middle}, 2);
  const ModelingPath back = run_stage(chain, {load}, {middle, e}, 2);
  EXPECT_NEAR(*forth.stage[1]->geometric_advantage / *back.stage[1]->mechanical_advantage, 1.0,
              1e-8);
  EXPECT_NEAR(*forth.stage[1]->mechanical_advantage / *back.stage[1]->geometric_advantage, 1.0,
              1e-8);
}

TEST(Stage, CondensedStiffnessGivesTheLinearAnswer) {
  const Mechanism chain = arc_chain();
  const Load load = chain.load("link4", {1e-7, 2e-7}, 1e-7);
  const ModelingPath path =
      run_stage(chain, {load}, {{load.body, {}, {}}, {}}, 1, {chain.index("link3"), load.body});
  ASSERT_EQ(path.condensed.size(), 2U);
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> k(
      path.condensed[0].matrix.data());
  EXPECT_LT((k - k.transpose()).norm(), 1e-10 * k.norm());
  Eigen::Matrix<double, 6, 1> forces;
  forces << 0, 0, 0, 1e-7, 2e-7, 1e-7;
  const Eigen::Matrix<double, 6, 1> moved = k.ldlt().solve(forces);
  const PathState& state = path.states.back();
  const Vec2 gone = state.bodies[2].position - path.states.front().bodies[2].position;
  EXPECT_NEAR(moved[3] / gone.x, 1.0, 1e-3);  // loads small, not infinitely so
  EXPECT_NEAR(moved[4] / gone.y, 1.0, 1e-3);
}

/// Straight leaves that do not stretch leave the platform of a parallelogram one direction: no
/// stiffness matrix, and no largest stiffness. Bent ones can straighten.
TEST(Stage, WhatCannotMoveHasNoStiffness) {
  const Mechanism stage = parallelogram();
  const std::size_t platform = stage.index("stage");
  const ModelingPath path =
      run_stage(stage, {stage.load("stage", {0.0, 0.1})}, {{platform, {}, {}}, {}}, 2, {platform});
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  ASSERT_EQ(path.condensed.size(), 1U);
  EXPECT_EQ(path.condensed[0].load_factor, 1.0);
  ASSERT_TRUE(path.stage[0].has_value());
  EXPECT_FALSE(path.stage[0]->stiffness.has_value());
  EXPECT_FALSE(path.stage[0]->stiff.has_value());
  ASSERT_TRUE(path.stage[0]->soft.has_value());
  EXPECT_GT(*path.stage[0]->soft, 0.0);
  EXPECT_TRUE(path.stage[2]->stiff.has_value());
}

}  // namespace
}  // namespace flexura::testing

// The safety of a motion: as that of a path, over the time instead of the load factor.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/results/safety.hpp"

namespace flexura {
namespace {

/// Two flexures, the stress of the first going up and down again.
MotionResult make_motion() {
  MotionResult motion;
  motion.points = {"stage.P"};
  motion.flexures = {"leaf", "hinge"};
  motion.strengths = {40.0, {}};
  ModelingMotion modeling;
  for (int k = 0; k <= 4; ++k) {
    MotionState moment;
    moment.time = 0.5 * k;
    moment.state.points = {{2.0 * moment.time, 1.0}};
    moment.state.peak_stresses = {30.0 * moment.time * (2.5 - moment.time), 7.0};
    modeling.states.push_back(moment);
  }
  motion.modelings = {modeling};
  return motion;
}

TEST(MotionSafety, IsThatOfTheLastState) {
  const MotionResult motion = make_motion();
  const Safety safety = find_safety(motion, motion.modelings[0]).value();
  EXPECT_DOUBLE_EQ(safety.factor.value(), 40.0 / 30.0);
  EXPECT_EQ(safety.flexure, 0U);
}

TEST(MotionSafety, SaysWhenTheStrengthIsReached) {
  const MotionResult motion = make_motion();
  const Safety safety = find_safety(motion, motion.modelings[0]).value();
  // 30 t (5/2 - t) = 40
  const double time = 1.25 - std::sqrt(1.25 * 1.25 - 4.0 / 3.0);
  ASSERT_TRUE(safety.reached.has_value());
  EXPECT_NEAR(safety.reached->load_factor, time, 1e-12);
  EXPECT_NEAR(safety.reached->displacements[0].x, 2.0 * time, 1e-12);
}

TEST(MotionSafety, IsUnknownWithoutStressesOrStrengths) {
  MotionResult motion = make_motion();
  motion.strengths = {{}, {}};
  EXPECT_FALSE(find_safety(motion, motion.modelings[0]).has_value());
  motion = make_motion();
  for (MotionState& moment : motion.modelings[0].states) moment.state.peak_stresses.clear();
  EXPECT_FALSE(find_safety(motion, motion.modelings[0]).has_value());
  EXPECT_FALSE(find_largest_stress(motion.modelings[0]).has_value());
}

TEST(MotionSafety, KnowsTheLargestStressOfTheWholeRun) {
  const MotionResult motion = make_motion();
  const StressPeak peak = find_largest_stress(motion.modelings[0]).value();
  EXPECT_DOUBLE_EQ(peak.stress, 45.0);
  EXPECT_EQ(peak.time, 1.0);
  EXPECT_EQ(peak.flexure, 0U);
}

}  // namespace
}  // namespace flexura

// Fixed steps through places where long ones fail.
#include "flexura/solvers/time_march.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flexura {
namespace {

struct Clock {
  double time = 0.0;
};

/// Steps over the spot are possible only where they are as short as the spot asks.
struct Obstructed {
  double spot = 0.0;
  double longest = 0.0;

  static constexpr double error_order = 3.0;
  void restart(bool /*rates_jump*/) {}
  StepReport step(Clock& clock, double h) {
    StepReport report;
    if (clock.time <= spot && spot < clock.time + h && h > longest) return report;
    clock.time += h;
    report.outcome = StepOutcome::accepted;
    return report;
  }
};

/// Lengths of the steps to time 3 in steps of 1; empty where there is no way.
std::vector<double> steps_past(double spot, double longest) {
  Obstructed integrator{spot, longest};
  TimeMarch<Obstructed> march(integrator, {1.0, 0.0, 0.0, 1e-9});
  Clock clock;
  std::vector<double> steps;
  const bool arrived = march.advance(clock, 3.0, [&](double h) {
    // parts of a step are aligned to halves of halves of it
    EXPECT_EQ(std::fmod(clock.time, h), 0.0) << "at " << clock.time;
    steps.push_back(h);
    return true;
  });
  return arrived ? steps : std::vector<double>{};
}

TEST(TimeMarch, TakesAHardPlaceInShortStepsAndNothingElse) {
  EXPECT_EQ(steps_past(-1.0, 0.0), (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(steps_past(1.3, 0.5), (std::vector<double>{1.0, 0.5, 0.5, 1.0}));
  EXPECT_EQ(steps_past(1.1, 0.125), (std::vector<double>{1.0, 0.125, 0.125, 0.25, 0.5, 1.0}));
  const std::vector<double> steps = steps_past(1.3, 1e-6);  // a million of the shortest in a step
  ASSERT_FALSE(steps.empty());
  EXPECT_LT(steps.size(), 80u);
  EXPECT_EQ(steps.back(), 1.0);
}

TEST(TimeMarch, EndsWhereNoStepIsShortEnough) { EXPECT_TRUE(steps_past(1.3, 1e-10).empty()); }

}  // namespace
}  // namespace flexura

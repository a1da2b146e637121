#include "flexura/core/time_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace flexura {
namespace {

constexpr double pi = std::numbers::pi;

/// The two derivatives against central differences of the function itself.
void expect_rates(const TimeHistory& history, std::initializer_list<double> times,
                  double tolerance = 1e-6) {
  constexpr double h = 1e-4;
  for (const double t : times) {
    const double before = evaluate_history(history, t - h).value;
    const double after = evaluate_history(history, t + h).value;
    const HistoryValue now = evaluate_history(history, t);
    EXPECT_NEAR(now.rate, (after - before) / (2.0 * h), tolerance) << "at " << t;
    EXPECT_NEAR(now.second, (after - 2.0 * now.value + before) / (h * h), 1e-5) << "at " << t;
  }
}

TEST(TimeHistory, StepIsThereFromItsTimeOn) {
  const TimeHistory step = StepHistory{0.5};
  EXPECT_EQ(evaluate_history(step, 0.4999).value, 0.0);
  EXPECT_EQ(evaluate_history(step, 0.5).value, 1.0);
  EXPECT_EQ(evaluate_history(step, 0.5).rate, 0.0);
  EXPECT_EQ(evaluate_history(StepHistory{}, 0.0).value, 1.0);
}

TEST(TimeHistory, RampsJoinZeroAndOne) {
  const TimeHistory straight = RampHistory{1.0, 3.0, false};
  EXPECT_EQ(evaluate_history(straight, 0.9).value, 0.0);
  EXPECT_EQ(evaluate_history(straight, 2.0).value, 0.5);
  EXPECT_EQ(evaluate_history(straight, 2.0).rate, 0.5);
  EXPECT_EQ(evaluate_history(straight, 3.1).value, 1.0);
  const TimeHistory smooth = RampHistory{1.0, 3.0, true};
  EXPECT_DOUBLE_EQ(evaluate_history(smooth, 2.0).value, 0.5);
  expect_rates(smooth, {0.5, 1.3, 2.0, 2.7, 3.5});
  for (const double end : {1.0, 3.0})
    for (const double side : {-1e-9, 1e-9}) {
      const HistoryValue at = evaluate_history(smooth, end + side);
      EXPECT_NEAR(at.rate, 0.0, 1e-8);
      EXPECT_NEAR(at.second, 0.0, 1e-7);
    }
}

TEST(TimeHistory, RatesThatJumpAreThoseFromThenOn) {
  const TimeHistory table = TableHistory({0.0, 2.0, 3.0}, {0.0, 1.0, 1.0}, false);
  const TimeHistory ramp = RampHistory{0.0, 2.0, false};
  for (const double time : {0.0, 1.0, 2.0})
    EXPECT_EQ(evaluate_history(ramp, time).rate, evaluate_history(table, time).rate) << time;
  EXPECT_DOUBLE_EQ(evaluate_history(HalfSineHistory{0.0, 0.5}, 0.0).rate, 2.0 * M_PI);
}

TEST(TimeHistory, HalfSineIsOnePulse) {
  const TimeHistory pulse = HalfSineHistory{0.2, 0.1};
  EXPECT_EQ(evaluate_history(pulse, 0.1).value, 0.0);
  EXPECT_NEAR(evaluate_history(pulse, 0.25).value, 1.0, 1e-15);
  EXPECT_NEAR(evaluate_history(pulse, 0.2 + 0.1 / 6.0).value, 0.5, 1e-12);
  EXPECT_EQ(evaluate_history(pulse, 0.35).value, 0.0);
  EXPECT_EQ(evaluate_history(pulse, 0.35).rate, 0.0);
  expect_rates(HalfSineHistory{1.0, 2.0}, {0.5, 1.2, 2.0, 2.9, 3.5});
}

TEST(TimeHistory, HarmonicHasItsPhase) {
  const TimeHistory cosine = HarmonicHistory{2.0, pi / 2.0};
  EXPECT_NEAR(evaluate_history(cosine, 0.7).value, std::cos(1.4), 1e-15);
  expect_rates(cosine, {-1.0, 0.0, 0.3, 2.0});
}

TEST(TimeHistory, LinearIsTimeItself) {
  const HistoryValue at = evaluate_history(LinearHistory{}, 2.5);
  EXPECT_EQ(at.value, 2.5);
  EXPECT_EQ(at.rate, 1.0);
  EXPECT_EQ(at.second, 0.0);
}

TEST(TimeHistory, TablesRunStraightBetweenTheirRows) {
  const TimeHistory table = TableHistory{{0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, false};
  EXPECT_EQ(evaluate_history(table, 0.0).value, 2.0);
  EXPECT_EQ(evaluate_history(table, 0.5).value, 3.0);
  EXPECT_EQ(evaluate_history(table, 2.0).value, 2.0);
  EXPECT_EQ(evaluate_history(table, 2.0).rate, -2.0);
  EXPECT_EQ(evaluate_history(table, 3.0).value, 0.0);
  EXPECT_EQ(evaluate_history(TableHistory{{0.0}, {7.0}, false}, 1.0).value, 7.0);
  EXPECT_EQ(evaluate_history(TableHistory{}, 1.0).value, 0.0);
}

// By hand: over 0, 1, 2 with values 0, 1, 0 the second derivative in the middle is -3.
TEST(TimeHistory, SmoothTablesAreNaturalSplines) {
  const TimeHistory three = TableHistory{{0.0, 1.0, 2.0}, {0.0, 1.0, 0.0}, true};
  EXPECT_DOUBLE_EQ(evaluate_history(three, 0.5).value, 0.6875);
  EXPECT_DOUBLE_EQ(evaluate_history(three, 1.0).second, -3.0);
  EXPECT_DOUBLE_EQ(evaluate_history(three, 0.0).second, 0.0);
  const TableHistory uneven{{0.0, 0.5, 2.0, 2.6, 4.0}, {1.0, -1.0, 3.0, 3.5, 0.0}, true};
  for (std::size_t i = 0; i < uneven.times().size(); ++i)
    EXPECT_NEAR(evaluate_history(uneven, uneven.times()[i]).value, uneven.values()[i], 1e-14);
  expect_rates(uneven, {0.2, 0.9, 1.7, 2.3, 3.1, 3.9});
  for (const double row : {0.5, 2.0, 2.6}) {  // value, slope and curvature run on through a row
    const HistoryValue before = evaluate_history(uneven, row - 1e-9);
    const HistoryValue after = evaluate_history(uneven, row + 1e-9);
    EXPECT_NEAR(before.rate, after.rate, 1e-6);
    EXPECT_NEAR(before.second, after.second, 1e-6);
  }
  for (const double end : {0.0, 4.0}) EXPECT_NEAR(evaluate_history(uneven, end).second, 0.0, 1e-12);
}

// A straight line has no curvature for a spline to find.
TEST(TimeHistory, ASplineOfALineIsTheLine) {
  const TimeHistory line = TableHistory{{0.0, 1.0, 1.5, 4.0}, {1.0, 3.0, 4.0, 9.0}, true};
  for (const double t : {0.1, 1.2, 3.7}) {
    EXPECT_NEAR(evaluate_history(line, t).value, 1.0 + 2.0 * t, 1e-14);
    EXPECT_NEAR(evaluate_history(line, t).second, 0.0, 1e-14);
  }
}

TEST(TimeHistory, OtherFunctionsAreDifferentiated) {
  const TimeHistory function =
      FunctionHistory{[](double t) { return std::exp(-t) * std::sin(3 * t); }};
  for (const double t : {0.0, 0.4, 2.0}) {
    const HistoryValue at = evaluate_history(function, t);
    const double s = std::sin(3 * t), c = std::cos(3 * t), e = std::exp(-t);
    EXPECT_DOUBLE_EQ(at.value, e * s);
    EXPECT_NEAR(at.rate, e * (3 * c - s), 1e-8);
    EXPECT_NEAR(at.second, e * (-8 * s - 6 * c), 1e-4);
  }
}

TEST(TimeHistory, BreaksAreWhereStepsShouldEnd) {
  using Times = std::vector<double>;
  EXPECT_EQ(history_breaks(StepHistory{0.5}, 0.0, 1.0), Times{0.5});
  EXPECT_EQ(history_breaks(StepHistory{0.0}, 0.0, 1.0), Times{});
  EXPECT_EQ(history_breaks(RampHistory{0.2, 0.7, false}, 0.0, 1.0), (Times{0.2, 0.7}));
  EXPECT_EQ(history_breaks(RampHistory{0.2, 0.7, true}, 0.0, 0.5), Times{0.2});
  const std::vector<double> pulse = history_breaks(HalfSineHistory{0.0, 0.25}, 0.0, 1.0);
  EXPECT_EQ(pulse, Times{0.25});
  EXPECT_EQ(history_breaks(TableHistory{{0.0, 1.0, 3.0}, {0, 0, 0}, false}, 0.0, 3.0), Times{1.0});
  EXPECT_EQ(history_breaks(TableHistory{{0.0, 1.0, 3.0}, {0, 0, 0}, true}, 0.0, 3.0), Times{});
  EXPECT_EQ(history_breaks(HarmonicHistory{1.0, 0.0}, 0.0, 9.0), Times{});
  EXPECT_EQ(history_breaks(LinearHistory{}, 0.0, 9.0), Times{});
}

TEST(TimeHistory, OnlyTablesEnd) {
  EXPECT_EQ(history_end(TableHistory{{0.0, 2.5}, {0.0, 1.0}, false}), 2.5);
  EXPECT_EQ(history_end(HarmonicHistory{}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(history_end(TableHistory{}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace flexura

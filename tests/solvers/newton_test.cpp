// Newton's method on equations that know nothing of mechanics.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "flexura/solvers/newton.hpp"

namespace flexura {
namespace {

/// One equation f(z) = 0; notes every point it is linearized at.
struct Scalar {
  std::function<double(double)> f;
  std::function<double(double)> slope;
  std::vector<double> seen{};
  double at = 0.0;

  bool linearize(const std::vector<double>& z) {
    at = z[0];
    seen.push_back(at);
    return slope(at) != 0.0;
  }
  double newton_step(std::vector<double>& step) const {
    step = {-f(at) / slope(at)};
    return std::abs(step[0]);
  }
};

/// z^3 - 2 z - 5 = 0, Newton's own example: 2.0945514815423265...
Scalar newtons_cubic() {
  return {[](double z) { return z * z * z - 2.0 * z - 5.0; },
          [](double z) { return 3.0 * z * z - 2.0; }};
}
constexpr double cubic_root = 2.0945514815423265915;

TEST(Newton, FindsTheRoot) {
  Scalar problem = newtons_cubic();
  std::vector<double> z{3.0};
  Newton newton({1e-12, 30, 6});
  const NewtonSummary summary = newton.solve(problem, z);
  EXPECT_EQ(summary.outcome, NewtonOutcome::converged);
  EXPECT_NEAR(z[0], cubic_root, 1e-12);
  EXPECT_EQ(summary.iterations, static_cast<int>(problem.seen.size()));
  EXPECT_NEAR(summary.first_step, 16.0 / 25.0, 1e-15);
}

/// e_{k+1} = C e_k^2 with C = f''/(2 f') = 3 z/(3 z^2 - 2) at the root.
TEST(Newton, ConvergesAtSecondOrder) {
  Scalar problem = newtons_cubic();
  std::vector<double> z{2.3};
  Newton({1e-15, 30, 6}).solve(problem, z);
  const double constant = 3.0 * cubic_root / (3.0 * cubic_root * cubic_root - 2.0);
  int checked = 0;
  for (std::size_t k = 0; k + 1 < problem.seen.size(); ++k) {
    const double error = std::abs(problem.seen[k] - cubic_root);
    const double next = std::abs(problem.seen[k + 1] - cubic_root);
    if (error > 0.1 || next < 1e-14) continue;
    EXPECT_NEAR(next / (error * error), constant, 0.1 * constant);
    ++checked;
  }
  EXPECT_GE(checked, 2);
}

/// Having learnt its rate, it saves the evaluation that would only confirm convergence: its last
/// step is above the tolerance, what is left is not.
TEST(Newton, StopsEarlyOnceItKnowsItsRate) {
  Newton newton({1e-10, 30, 6});
  Scalar problem = newtons_cubic();
  for (const double start : {2.3, 2.2, 1.9}) {
    std::vector<double> z{start};
    const NewtonSummary summary = newton.solve(problem, z);
    EXPECT_EQ(summary.outcome, NewtonOutcome::converged);
    EXPECT_GT(summary.last_step, 1e-10);
    EXPECT_NEAR(z[0], cubic_root, 1e-10);
  }
}

/// atan from 3: the full step runs away (|z| grows), halved steps come back.
TEST(Newton, HalvesStepsThatRunAway) {
  Scalar problem{[](double z) { return std::atan(z); },
                 [](double z) { return 1.0 / (1.0 + z * z); }};
  std::vector<double> z{3.0};
  const NewtonSummary summary = Newton({1e-12, 50, 6}).solve(problem, z);
  EXPECT_EQ(summary.outcome, NewtonOutcome::converged);
  EXPECT_NEAR(z[0], 0.0, 1e-12);
}

TEST(Newton, SaysSingularAndDivergedAndKeepsTheStart) {
  Scalar flat{[](double z) { return z * z + 1.0; }, [](double) { return 0.0; }};
  std::vector<double> z{3.0};
  EXPECT_EQ(Newton().solve(flat, z).outcome, NewtonOutcome::singular);
  EXPECT_EQ(z[0], 3.0);
  Scalar rootless{[](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; }};
  z = {0.7};
  EXPECT_EQ(Newton().solve(rootless, z).outcome, NewtonOutcome::diverged);
  EXPECT_EQ(z[0], 0.7);
  Scalar nan{[](double) { return std::numeric_limits<double>::quiet_NaN(); },
             [](double) { return 1.0; }};
  EXPECT_EQ(Newton().solve(nan, z).outcome, NewtonOutcome::diverged);
}

TEST(Newton, TakesNoMoreIterationsThanAllowed) {
  Scalar slow{[](double z) { return std::pow(z, 9); }, [](double z) { return 9 * std::pow(z, 8); }};
  std::vector<double> z{1.0};
  const NewtonSummary summary = Newton({1e-14, 5, 6}).solve(slow, z);
  EXPECT_EQ(summary.outcome, NewtonOutcome::diverged);
  EXPECT_EQ(summary.iterations, 5);
}

}  // namespace
}  // namespace flexura

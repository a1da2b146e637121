// A symmetric (pitchfork) bifurcation on the path: x grows with the load, y stays zero and turns
// unstable where the load factor passes `critical`.
//     energy x^2/2 - f x + (critical - f) y^2/2 + y^4/4, f the load factor
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flexura/solvers/load_stepping.hpp"

namespace flexura {
namespace {

struct Pitchfork {
  double critical = 0.6180339887;
  double factor = 0.0, x = 0.0, y = 0.0;

  double tangent_y() const { return critical - factor + 3.0 * y * y; }
  void set_load_factor(double f) { factor = f; }
  bool linearize(const std::vector<double>& z) {
    x = z[0];
    y = z[1];
    return std::abs(tangent_y()) > 1e-14;
  }
  double newton_step(std::vector<double>& step) const {
    step = {factor - x, -((critical - factor) * y + y * y * y) / tangent_y()};
    return std::max(std::abs(step[0]), std::abs(step[1]));
  }
  void load_direction(std::vector<double>& direction) const { direction = {1.0, y / tangent_y()}; }
  int unstable_directions() const { return tangent_y() < 0.0 ? 1 : 0; }
  double strain_energy() const {
    return 0.5 * x * x + 0.5 * critical * y * y + 0.25 * y * y * y * y;
  }
  double load_displacement(const std::vector<double>& z) const { return z[0] + 0.5 * z[1] * z[1]; }
  double load_rate(const std::vector<double>& direction) const {
    return direction[0] + y * direction[1];
  }
  bool has_follower_loads() const { return false; }
  double inner(const std::vector<double>& a, const std::vector<double>& b) const {
    return a[0] * b[0] + a[1] * b[1];
  }
};
static_assert(LoadedProblem<Pitchfork>);

TEST(StabilityChange, IsLocatedOnThePathInOneOrManySteps) {
  for (const int steps : {1, 7, 40}) {
    Pitchfork problem;
    LoadStepping<Pitchfork> stepping(problem, {1e-12, 1e-4});
    ASSERT_TRUE(stepping.start({0.0, 0.0}));
    for (int k = 1; k <= steps; ++k)
      ASSERT_EQ(stepping.advance(k == steps ? 1.0 : static_cast<double>(k) / steps).outcome,
                SteppingOutcome::reached);
    ASSERT_EQ(stepping.changes().size(), 1U) << steps;
    const StabilityChange& change = stepping.changes()[0];
    EXPECT_NEAR(change.load_factor, problem.critical, 2e-9);
    EXPECT_EQ(change.before, 0);
    EXPECT_EQ(change.after, 1);
    ASSERT_EQ(change.z.size(), 2U);
    EXPECT_NEAR(change.z[0], problem.critical, 2e-9);
    EXPECT_EQ(stepping.unstable_directions(), 1);
    EXPECT_NEAR(stepping.state()[0], 1.0, 1e-12);
    EXPECT_EQ(stepping.state()[1], 0.0);
  }
}

TEST(StabilityChange, NoneIsReportedWhereNoneIs) {
  Pitchfork problem;
  problem.critical = 1.5;
  LoadStepping<Pitchfork> stepping(problem, {1e-12, 1e-4});
  ASSERT_TRUE(stepping.start({0.0, 0.0}));
  ASSERT_EQ(stepping.advance(1.0).outcome, SteppingOutcome::reached);
  EXPECT_TRUE(stepping.changes().empty());
  EXPECT_EQ(stepping.unstable_directions(), 0);
}

/// An output step that ends at the critical load itself, where the tangent is singular.
TEST(StabilityChange, AnOutputStepAtTheCriticalLoadDoesNotStopThePath) {
  Pitchfork problem;
  problem.critical = 0.5;
  LoadStepping<Pitchfork> stepping(problem, {1e-12, 1e-4});
  ASSERT_TRUE(stepping.start({0.0, 0.0}));
  EXPECT_EQ(stepping.advance(0.5).outcome, SteppingOutcome::reached);
  EXPECT_EQ(stepping.advance(1.0).outcome, SteppingOutcome::reached);
  EXPECT_EQ(stepping.unstable_directions(), 1);
}

}  // namespace
}  // namespace flexura

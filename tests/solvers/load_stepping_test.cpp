// Load stepping on the von Mises truss, one equation with a closed-form limit point: two bars of
// half-span b and rise h = a b under a load at the apex. With u = (displacement down)/h,
// shallow-arch strain, and all constants set to one,
//     strain energy (1 - (1-u)^2)^2 / 8,   equilibrium u - 3 u^2/2 + u^3/2 = load,
// which turns back at u = 1 - 1/sqrt 3 under the load 1/(3 sqrt 3) = 0.19245008972987526 (twice
// that, 0.38490017945975, is the figure of textbooks, for E A a^3/L^3 with both bars).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flexura/solvers/load_stepping.hpp"

namespace flexura {
namespace {

struct Truss {
  double full_load = 1.0;
  double factor = 0.0, u = 0.0, residual = 0.0, tangent = 1.0;
  int evaluations = 0;

  void set_load_factor(double f) { factor = f; }
  bool linearize(const std::vector<double>& z) {
    ++evaluations;
    u = z[0];
    residual = u - 1.5 * u * u + 0.5 * u * u * u - factor * full_load;
    tangent = 1.0 - 3.0 * u + 1.5 * u * u;
    return std::abs(tangent) > 1e-14 && std::isfinite(residual);
  }
  double newton_step(std::vector<double>& step) const {
    step = {-residual / tangent};
    return std::abs(step[0]);
  }
  void load_direction(std::vector<double>& direction) const { direction = {full_load / tangent}; }
  int unstable_directions() const { return tangent < 0.0 ? 1 : 0; }
  double strain_energy() const {
    const double stretch = 1.0 - (1.0 - u) * (1.0 - u);
    return 0.125 * stretch * stretch;
  }
  double load_displacement(const std::vector<double>& z) const { return full_load * z[0]; }
  double load_rate(const std::vector<double>& direction) const { return full_load * direction[0]; }
  bool has_follower_loads() const { return false; }
  double inner(const std::vector<double>& a, const std::vector<double>& b) const {
    return a[0] * b[0];
  }
};
static_assert(LoadedProblem<Truss>);

const double limit_load = 1.0 / (3.0 * std::sqrt(3.0));
const double limit_u = 1.0 - 1.0 / std::sqrt(3.0);

TEST(LoadStepping, TurnsBackAtTheLimitPointOfTheTruss) {
  Truss truss;
  LoadStepping<Truss> stepping(truss, {1e-12, 1e-4});
  ASSERT_TRUE(stepping.start({0.0}));
  SteppingSummary summary;
  for (int step = 1; step <= 20; ++step) {
    summary = stepping.advance(0.05 * step);
    if (summary.outcome != SteppingOutcome::reached) break;
    EXPECT_LT(0.05 * step, limit_load);
  }
  ASSERT_EQ(summary.outcome, SteppingOutcome::limit_point);
  EXPECT_NEAR(summary.load_factor, limit_load, 1e-12);
  ASSERT_EQ(summary.limit_state.size(), 1U);
  EXPECT_NEAR(summary.limit_state[0], limit_u, 1e-6);
  EXPECT_LT(stepping.state()[0], limit_u);
  EXPECT_EQ(stepping.unstable_directions(), 0);
  EXPECT_TRUE(stepping.changes().empty());
}

/// In one long step, Newton converges perfectly on the snapped-through branch (u > 1 + 1/sqrt 3).
/// The step must be refused.
TEST(LoadStepping, DoesNotJumpToTheOtherBranch) {
  Truss truss;
  std::vector<double> z{2.5};
  truss.set_load_factor(1.0);
  ASSERT_EQ(Newton().solve(truss, z).outcome, NewtonOutcome::converged);
  ASSERT_GT(z[0], 2.0);
  LoadStepping<Truss> stepping(truss, {1e-12, 1e-4});
  ASSERT_TRUE(stepping.start({0.0}));
  const SteppingSummary summary = stepping.advance(1.0);
  EXPECT_EQ(summary.outcome, SteppingOutcome::limit_point);
  EXPECT_NEAR(summary.load_factor, limit_load, 1e-12);
}

TEST(LoadStepping, ReachesLoadsBelowTheLimitInAnyNumberOfSteps) {
  std::vector<double> ends;
  for (const int steps : {1, 3, 50}) {
    Truss truss;
    truss.full_load = 0.999 * limit_load;
    LoadStepping<Truss> stepping(truss, {1e-12, 1e-4});
    ASSERT_TRUE(stepping.start({0.0}));
    for (int k = 1; k <= steps; ++k) {
      const double to = k == steps ? 1.0 : static_cast<double>(k) / steps;
      ASSERT_EQ(stepping.advance(to).outcome, SteppingOutcome::reached);
    }
    ends.push_back(stepping.state()[0]);
    EXPECT_GE(stepping.steps(), steps);
    EXPECT_EQ(stepping.iterations(), truss.evaluations);
  }
  EXPECT_NEAR(ends[0], ends[1], 1e-10);
  EXPECT_NEAR(ends[0], ends[2], 1e-10);
  EXPECT_LT(ends[0], limit_u);
}

/// The other way, the truss only stiffens: no limit, and few iterations a step.
TEST(LoadStepping, FollowsAStiffeningPath) {
  Truss truss;
  truss.full_load = -5.0;
  LoadStepping<Truss> stepping(truss, {1e-12, 1e-4});
  ASSERT_TRUE(stepping.start({0.0}));
  ASSERT_EQ(stepping.advance(1.0).outcome, SteppingOutcome::reached);
  const double u = stepping.state()[0];
  EXPECT_NEAR(u - 1.5 * u * u + 0.5 * u * u * u, -5.0, 1e-11);
}

/// A stiff strut (x) that its load bends aside (y) from an imperfection of a millionth of a
/// millionth: W = k x^2/2 + y^2/2 - y^3/3, displacement of the load x + (y^2/2 + e y)/c. With m =
/// load/c, equilibrium is (1 - m) y - y^2 = m e, which turns back at m = 1 + 2e - 2 sqrt(e + e^2).
/// Beyond a gap of four millionths, other equilibria with y < 0 lead on, up to any load.
struct ImperfectStrut {
  static constexpr double k = 1e6, c = 0.0148, e = 1e-12;
  double factor = 0.0, x = 0.0, y = 0.0;

  double bend() const { return 1.0 - 2.0 * y - factor / c; }
  void set_load_factor(double f) { factor = f; }
  bool linearize(const std::vector<double>& z) {
    x = z[0];
    y = z[1];
    return bend() != 0.0 && std::isfinite(y);
  }
  double newton_step(std::vector<double>& step) const {
    step = {(factor - k * x) / k, -(y - y * y - factor / c * (y + e)) / bend()};
    return std::max(std::abs(step[0]), std::abs(step[1]));
  }
  void load_direction(std::vector<double>& direction) const {
    direction = {1.0 / k, (y + e) / c / bend()};
  }
  int unstable_directions() const { return bend() < 0.0 ? 1 : 0; }
  double strain_energy() const { return 0.5 * k * x * x + 0.5 * y * y - y * y * y / 3.0; }
  double load_displacement(const std::vector<double>& z) const {
    return z[0] + (0.5 * z[1] * z[1] + e * z[1]) / c;
  }
  double load_rate(const std::vector<double>& direction) const {
    return direction[0] + (y + e) / c * direction[1];
  }
  bool has_follower_loads() const { return false; }
  double inner(const std::vector<double>& a, const std::vector<double>& b) const {
    return a[0] * b[0] + a[1] * b[1];
  }
};
static_assert(LoadedProblem<ImperfectStrut>);

const double strut_limit =
    ImperfectStrut::c *
    (1.0 + 2.0 * ImperfectStrut::e -
     2.0 * std::sqrt(ImperfectStrut::e + ImperfectStrut::e * ImperfectStrut::e));

TEST(LoadStepping, TurnsBackBeforeAGapOfMillionths) {
  for (const int steps : {1, 20, 300}) {
    ImperfectStrut strut;
    LoadStepping<ImperfectStrut> stepping(strut, {1e-12, 1e-4});
    ASSERT_TRUE(stepping.start({0.0, 0.0}));
    SteppingSummary summary;
    for (int k = 1; k <= steps && summary.outcome == SteppingOutcome::reached; ++k)
      summary = stepping.advance(static_cast<double>(k) / steps);
    ASSERT_EQ(summary.outcome, SteppingOutcome::limit_point) << steps;
    EXPECT_NEAR(summary.load_factor, strut_limit, 1e-10 * strut_limit) << steps;
  }
}

TEST(LoadStepping, ArcLengthsTurnBackBeforeAGapOfMillionths) {
  for (const double largest : {0.1, 0.01}) {
    ImperfectStrut strut;
    Continuation<ImperfectStrut> path(strut, {1e-12, largest, 1e-9});
    ASSERT_TRUE(path.start(0.0, {0.0, 0.0}));
    std::vector<LocatedFeature> found;
    for (int k = 0; k < 300 && found.empty(); ++k) {
      ASSERT_TRUE(path.advance());
      found = path.features();
    }
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].feature, PathFeature::limit_point);
    EXPECT_NEAR(found[0].state.load_factor, strut_limit, 1e-10 * strut_limit);
  }
}

TEST(LoadStepping, ASingularStartIsReported) {
  Truss truss;
  LoadStepping<Truss> stepping(truss, {1e-12, 1e-4});
  EXPECT_FALSE(stepping.start({limit_u}));
}

}  // namespace
}  // namespace flexura

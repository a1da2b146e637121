// Paths that turn back and paths that branch, on equations in two unknowns.
#include "flexura/solvers/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace flexura {
namespace {

/// An energy in (x, y) less f x: residual and tangent from the subclass-free formulas
///     x: f(x) = a x^3 - b x^2 + c x,   y: (k - x) y + y^3,
/// coupled through -x y^2/2: an asymmetric curve in x with limit points and a pitchfork in y.
struct Snap {
  double a = 1.0, b = 3.0, c = 2.4, k = 1e3;
  double factor = 0.0, x = 0.0, y = 0.0;

  double xx() const { return 3.0 * a * x * x - 2.0 * b * x + c; }
  double yy() const { return k - x + 3.0 * y * y; }
  double det() const { return xx() * yy() - y * y; }
  void set_load_factor(double f) { factor = f; }
  bool linearize(const std::vector<double>& z) {
    x = z[0];
    y = z[1];
    return std::abs(det()) > 1e-15;
  }
  std::vector<double> solve(double r0, double r1) const {
    return {(yy() * r0 + y * r1) / det(), (y * r0 + xx() * r1) / det()};
  }
  double newton_step(std::vector<double>& step) const {
    step = solve(factor - (a * x * x * x - b * x * x + c * x - 0.5 * y * y),
                 -((k - x) * y + y * y * y));
    return std::max(std::abs(step[0]), std::abs(step[1]));
  }
  void load_direction(std::vector<double>& direction) const { direction = solve(1.0, 0.0); }
  void critical_direction(std::vector<double>& direction) const {
    if (std::abs(yy()) < std::abs(xx()))
      direction = {0.0, 1.0};
    else
      direction = {1.0, 0.0};
  }
  int unstable_directions() const {
    if (det() < 0.0) return 1;
    return xx() < 0.0 ? 2 : 0;
  }
  double strain_energy() const { return 0.0; }
  double load_displacement(const std::vector<double>& z) const { return z[0]; }
  double load_rate(const std::vector<double>& direction) const { return direction[0]; }
  bool has_follower_loads() const { return false; }
  double inner(const std::vector<double>& u, const std::vector<double>& v) const {
    return u[0] * v[0] + u[1] * v[1];
  }
};

std::vector<LocatedFeature> follow(Snap& problem, double until_x) {
  Continuation<Snap> path(problem, {1e-12, 0.1, 1e-9});
  EXPECT_TRUE(path.start(0.0, {0.0, 0.0}));
  std::vector<LocatedFeature> features;
  for (int k = 0; k < 500 && path.state().z[0] < until_x; ++k) {
    EXPECT_TRUE(path.advance());
    features.insert(features.end(), path.features().begin(), path.features().end());
  }
  return features;
}

TEST(Continuation, LocatesLimitPointsAndZerosOfTheLoad) {
  Snap problem;
  problem.c = 2.0;  // f = x (x - 1) (x - 2)
  const auto features = follow(problem, 2.5);
  ASSERT_EQ(features.size(), 4U);
  const double root = 1.0 / std::numbers::sqrt3;
  EXPECT_EQ(features[0].feature, PathFeature::limit_point);
  EXPECT_NEAR(features[0].state.load_factor, root - root * root * root, 1e-13);
  EXPECT_EQ(features[1].feature, PathFeature::zero_load);
  EXPECT_NEAR(features[1].state.z[0], 1.0, 1e-12);
  EXPECT_EQ(features[1].unstable_before, 1);
  EXPECT_EQ(features[2].feature, PathFeature::limit_point);
  EXPECT_NEAR(features[2].state.load_factor, root * root * root - root, 1e-13);
  EXPECT_EQ(features[3].feature, PathFeature::zero_load);
  EXPECT_NEAR(features[3].state.z[0], 2.0, 1e-12);
  EXPECT_EQ(features[3].unstable_before, 0);
}

TEST(Continuation, PassesABifurcationAndLocatesIt) {
  Snap problem;
  problem.b = 0.0;
  problem.k = 0.7;
  const auto features = follow(problem, 2.0);
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].feature, PathFeature::bifurcation);
  EXPECT_NEAR(features[0].state.z[0], 0.7, 1e-9);
  EXPECT_NEAR(features[0].state.z[1], 0.0, 1e-9);
  EXPECT_EQ(features[0].unstable_before, 0);
  EXPECT_EQ(features[0].unstable_after, 1);
}

TEST(Continuation, LeavesTheBranchToTheSideAskedFor) {
  for (const int side : {1, -1}) {
    Snap problem;
    problem.b = 0.0;
    problem.k = 0.7;
    Continuation<Snap> path(problem, {1e-12, 0.1, 1e-9});
    ASSERT_TRUE(path.start(0.0, {0.0, 0.0}));
    while (path.features().empty()) ASSERT_TRUE(path.advance());
    const ArcState bifurcation = path.features()[0].state;
    ASSERT_TRUE(path.switch_branch(bifurcation, side));
    for (int k = 0; k < 20; ++k) ASSERT_TRUE(path.advance());
    const auto& z = path.state().z;
    EXPECT_GT(side * z[1], 0.1);
    EXPECT_NEAR(z[1] * z[1], z[0] - 0.7, 1e-10);  // the branch: y^2 = x - k
    EXPECT_EQ(path.unstable_directions(), 0);
  }
}

TEST(Continuation, LandsOnALoadFactor) {
  Snap problem;
  problem.b = 0.0;
  Continuation<Snap> path(problem, {1e-12, 0.1, 1e-9});
  ASSERT_TRUE(path.start(0.0, {0.0, 0.0}));
  while (path.state().load_factor < 1.0) ASSERT_TRUE(path.advance());
  ASSERT_TRUE(path.land(1.0));
  const double x = path.state().z[0];
  EXPECT_EQ(path.state().load_factor, 1.0);
  EXPECT_NEAR(x * x * x + 2.4 * x, 1.0, 1e-13);
}

}  // namespace
}  // namespace flexura

// Axis curves: lines, arcs and splines over their arc length.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "flexura/geometry/axis_curve.hpp"

namespace flexura {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Vec2> points_on_arc(double radius, double start, double sweep, int pieces) {
  std::vector<Vec2> points;
  for (int k = 0; k <= pieces; ++k) points.push_back(radius * unit(start + sweep * k / pieces));
  return points;
}

/// Whatever the shape: the tangent is the derivative of the position, has length one, and the
/// curvature is the derivative of its angle. By central differences: errors of order h^2.
void expect_consistent(const AxisCurve& axis, double tolerance) {
  const double h = 1e-5 * axis.length();
  for (int k = 1; k < 12; ++k) {
    const double s = axis.length() * (k - 0.37) / 12.0;
    const Vec2 slope = (0.5 / h) * (axis.position(s + h) - axis.position(s - h));
    EXPECT_LT(norm(slope - unit(axis.tangent_angle(s))), tolerance) << s;
    const double turning = (axis.tangent_angle(s + h) - axis.tangent_angle(s - h)) / (2.0 * h);
    EXPECT_NEAR(turning, axis.curvature(s), tolerance * (1.0 + std::abs(turning))) << s;
  }
}

TEST(AxisCurve, Line) {
  const AxisCurve axis(LineAxis{{1.0, 2.0}, {4.0, -2.0}});
  EXPECT_DOUBLE_EQ(axis.length(), 5.0);
  EXPECT_LT(norm(axis.position(2.5) - Vec2{2.5, 0.0}), 1e-15);
  EXPECT_DOUBLE_EQ(axis.tangent_angle(1.0), std::atan2(-4.0, 3.0));
  EXPECT_EQ(axis.curvature(1.0), 0.0);
  EXPECT_EQ(axis.turning(), 0.0);
}

TEST(AxisCurve, ArcsOfBothSenses) {
  for (const double sweep : {1.2, -4.0 * pi / 3.0}) {
    const AxisCurve axis(ArcAxis{{0.0, 3.0}, 3.0, -0.5 * pi, sweep});
    EXPECT_DOUBLE_EQ(axis.length(), 3.0 * std::abs(sweep));
    EXPECT_LT(norm(axis.position(0.0)), 1e-15);
    EXPECT_DOUBLE_EQ(axis.curvature(1.0), std::copysign(1.0 / 3.0, sweep));
    EXPECT_DOUBLE_EQ(axis.turning(), std::abs(sweep));
    // continuous over more than half a turn
    EXPECT_NEAR(axis.tangent_angle(axis.length()) - axis.tangent_angle(0.0), sweep, 1e-15);
    expect_consistent(axis, 1e-9);
  }
}

TEST(AxisCurve, SplinePassesThroughItsPointsSmoothly) {
  const std::vector<Vec2> points{{0, 0}, {2, 1}, {3, 3}, {2.5, 5}, {0, 5.5}, {-2, 4}};
  const AxisCurve axis(SplineAxis{points, {}, {}});
  ASSERT_EQ(axis.breaks().size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_LT(norm(axis.position(axis.breaks()[k]) - points[k]), 1e-13);
  expect_consistent(axis, 1e-7);
  // C2: the curvature does not jump at the knots
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double s = axis.breaks()[k];
    EXPECT_NEAR(axis.curvature(s - 1e-9), axis.curvature(s + 1e-9), 1e-6);
  }
}

TEST(AxisCurve, SplineThroughCollinearPointsIsTheLine) {
  for (const std::vector<Vec2>& points : {std::vector<Vec2>{{0, 0}, {3, 4}},
                                          {{0, 0}, {0.6, 0.8}, {3, 4}},
                                          {{0, 0}, {0.6, 0.8}, {1.5, 2.0}, {3, 4}}}) {
    const AxisCurve axis(SplineAxis{points, {}, {}});
    EXPECT_NEAR(axis.length(), 5.0, 1e-14);
    EXPECT_LT(norm(axis.position(2.0) - Vec2{1.2, 1.6}), 1e-14);
    EXPECT_NEAR(axis.curvature(1.7), 0.0, 1e-13);
  }
}

/// Whatever the length of the tangent that was given.
TEST(AxisCurve, SplineIsClampedToItsEndTangents) {
  const SplineAxis spline{{{0, 0}, {1, 1}, {3, 1}}, Vec2{0.0, 5.0}, Vec2{1.0, -1.0}};
  const AxisCurve axis(spline);
  EXPECT_NEAR(axis.tangent_angle(0.0), 0.5 * pi, 1e-13);
  EXPECT_NEAR(std::remainder(axis.tangent_angle(axis.length()) + 0.25 * pi, 2.0 * pi), 0.0, 1e-12);
  const AxisCurve two(SplineAxis{{{0, 0}, {1, 0}}, Vec2{1.0, 1.0}, Vec2{1.0, -1.0}});
  EXPECT_NEAR(two.tangent_angle(0.0), 0.25 * pi, 1e-13);
  EXPECT_NEAR(two.tangent_angle(two.length()), -0.25 * pi, 1e-13);
}

/// A cubic spline through points of an arc: its length converges at fourth order, clamped or not;
/// the slope at a free (not-a-knot) end, and with it the turning, at third.
TEST(AxisCurve, SplineThroughPointsOfAnArcApproachesTheArc) {
  const double sweep = 1.5 * pi;
  double before = 0.0;
  for (const int pieces : {16, 32, 64, 128}) {
    const std::vector<Vec2> points = points_on_arc(2.0, 0.3, sweep, pieces);
    const AxisCurve free(SplineAxis{points, {}, {}});
    const AxisCurve clamped(SplineAxis{points, perp(points.front()), perp(points.back())});
    EXPECT_NEAR(free.turning(), sweep, 40.0 / std::pow(pieces, 3));
    EXPECT_NEAR(clamped.turning(), sweep, 1e-13);
    EXPECT_NEAR(free.length(), 2.0 * sweep, 8.0 / std::pow(pieces, 4));
    const double error = std::abs(clamped.length() - 2.0 * sweep);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 4.0, 0.1) << pieces;
    }
    before = error;
  }
}

/// The angle is counted on, over more than a full turn.
TEST(AxisCurve, SplineOfTwoTurns) {
  std::vector<Vec2> spiral;
  for (int k = 0; k <= 32; ++k) spiral.push_back((1.0 + 0.05 * k) * unit(4.0 * pi * k / 32.0));
  const AxisCurve axis(SplineAxis{spiral, {}, {}});
  EXPECT_NEAR(axis.tangent_angle(axis.length()) - axis.tangent_angle(0.0), 4.0 * pi, 0.1);
}

}  // namespace
}  // namespace flexura

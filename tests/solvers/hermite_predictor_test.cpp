// Hermite extrapolation reproduces polynomials of twice as many coefficients as points.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "flexura/solvers/hermite_predictor.hpp"

namespace flexura {
namespace {

/// Two components: a polynomial of the degree given, and minus half of it.
CurvePoint sample(double x, int degree) {
  double value = 0.0, slope = 0.0;
  for (int k = degree; k >= 0; --k) {
    slope = slope * x + value;
    value = value * x + (1.0 - 0.4 * k);
  }
  return {x, {value, -0.5 * value}, {slope, -0.5 * slope}};
}

double error_of_extrapolation(int points, int degree) {
  const double at[] = {-0.2, 0.1, 0.35, 0.8};
  std::deque<CurvePoint> known;
  for (int k = 0; k < points; ++k) known.push_back(sample(at[k], degree));
  std::vector<double> found;
  extrapolate_hermite(known, 1.1, found);
  const CurvePoint truth = sample(1.1, degree);
  return std::hypot(found[0] - truth.value[0], found[1] - truth.value[1]);
}

TEST(HermitePredictor, OnePointIsTheTangent) {
  EXPECT_LT(error_of_extrapolation(1, 1), 1e-15);
  EXPECT_GT(error_of_extrapolation(1, 2), 1e-2);
}

TEST(HermitePredictor, TwoPointsAreExactForCubics) {
  EXPECT_LT(error_of_extrapolation(2, 3), 1e-13);
  EXPECT_GT(error_of_extrapolation(2, 4), 1e-2);
}

TEST(HermitePredictor, ThreePointsAreExactForQuintics) {
  EXPECT_LT(error_of_extrapolation(3, 5), 1e-12);
  EXPECT_GT(error_of_extrapolation(3, 6), 1e-2);
}

TEST(HermitePredictor, OlderPointsAreLeftOut) {
  EXPECT_LT(error_of_extrapolation(4, 5), 1e-13);
  EXPECT_GT(error_of_extrapolation(4, 7), 1e-3);
}

TEST(HermitePredictor, AtAKnownPointItGivesItsValue) {
  const std::deque<CurvePoint> known{sample(0.0, 6), sample(0.5, 6), sample(1.0, 6)};
  std::vector<double> found;
  for (const CurvePoint& point : known) {
    extrapolate_hermite(known, point.parameter, found);
    EXPECT_NEAR(found[0], point.value[0], 1e-15);
  }
}

}  // namespace
}  // namespace flexura

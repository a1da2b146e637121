// Quadrature rules are exact to their degree and no further; Legendre polynomials and integrals.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "flexura/core/quadrature.hpp"

namespace flexura {
namespace {

/// Integral of the Legendre polynomial of that degree: 0 but for degree 0 (2). Unlike powers, it
/// tells exactness at high degrees.
double integrate_legendre_of_degree(const QuadratureRule& rule, int degree) {
  std::vector<double> values(static_cast<std::size_t>(degree) + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    evaluate_legendre(rule.nodes[k], values);
    sum += rule.weights[k] * values.back();
  }
  return sum;
}

class Rules : public ::testing::TestWithParam<int> {};

TEST_P(Rules, GaussIsExactToDegreeTwiceItsPointsLessOne) {
  const int n = GetParam();
  const QuadratureRule& rule = gauss_legendre(n);
  ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(n));
  EXPECT_NEAR(integrate_legendre_of_degree(rule, 0), 2.0, 4e-15);
  for (int degree = 1; degree < 2 * n; ++degree)
    EXPECT_NEAR(integrate_legendre_of_degree(rule, degree), 0.0, 4e-15) << degree;
  EXPECT_GT(std::abs(integrate_legendre_of_degree(rule, 2 * n)), 1e-3);
}

TEST_P(Rules, LobattoIsExactToDegreeTwiceItsPointsLessThree) {
  const int n = GetParam() + 1;
  const QuadratureRule& rule = gauss_lobatto(n);
  ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(rule.nodes.front(), -1.0);
  EXPECT_EQ(rule.nodes.back(), 1.0);
  EXPECT_NEAR(integrate_legendre_of_degree(rule, 0), 2.0, 4e-15);
  for (int degree = 1; degree < 2 * n - 2; ++degree)
    EXPECT_NEAR(integrate_legendre_of_degree(rule, degree), 0.0, 4e-15) << degree;
  EXPECT_GT(std::abs(integrate_legendre_of_degree(rule, 2 * n - 2)), 1e-3);
}

TEST_P(Rules, NodesAscendSymmetricallyWithPositiveWeights) {
  for (const QuadratureRule* rule : {&gauss_legendre(GetParam()), &gauss_lobatto(GetParam() + 1)}) {
    const std::size_t n = rule->nodes.size();
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_GT(rule->weights[k], 0.0);
      EXPECT_NEAR(rule->nodes[k], -rule->nodes[n - 1 - k], 2e-16);
      EXPECT_NEAR(rule->weights[k], rule->weights[n - 1 - k], 2e-16);
      if (k == 0) continue;
      EXPECT_GT(rule->nodes[k], rule->nodes[k - 1]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Quadrature, Rules, ::testing::Values(1, 2, 3, 4, 5, 8, 13, 20, 32, 48));

/// Abramowitz & Stegun, table 25.4: four points of Gauss, five of Lobatto.
TEST(Quadrature, PrintedNodesAndWeights) {
  EXPECT_NEAR(gauss_legendre(4).nodes[3], 0.861136311594053, 1e-15);
  EXPECT_NEAR(gauss_legendre(4).weights[3], 0.347854845137454, 1e-15);
  EXPECT_NEAR(gauss_lobatto(5).nodes[3], std::sqrt(3.0 / 7.0), 1e-15);
  EXPECT_NEAR(gauss_lobatto(5).weights[3], 49.0 / 90.0, 1e-15);
}

TEST(Quadrature, LegendrePolynomialsMatchTheirFormulas) {
  const double x = 0.37;
  double p[5];
  evaluate_legendre(x, p);
  EXPECT_EQ(p[0], 1.0);
  EXPECT_EQ(p[1], x);
  EXPECT_NEAR(p[2], 0.5 * (3 * x * x - 1), 1e-15);
  EXPECT_NEAR(p[3], 0.5 * (5 * x * x * x - 3 * x), 1e-15);
  EXPECT_NEAR(p[4], (35 * std::pow(x, 4) - 30 * x * x + 3) / 8, 1e-15);
}

/// integral of P_i from -1 to x by Gauss quadrature.
TEST(Quadrature, LegendreIntegralsMatchQuadrature) {
  constexpr std::size_t count = 12;
  for (const double x : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
    std::vector<double> found(count), p(count), expected(count, 0.0);
    integrate_legendre(x, found);
    const QuadratureRule& rule = gauss_legendre(8);
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double half = 0.5 * (x + 1.0);
      evaluate_legendre(-1.0 + half * (1.0 + rule.nodes[g]), p);
      for (std::size_t i = 0; i < count; ++i) expected[i] += half * rule.weights[g] * p[i];
    }
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(found[i], expected[i], 1e-15) << i;
  }
}

TEST(Quadrature, RulesAreSharedAcrossThreads) {
  std::vector<const QuadratureRule*> seen(8);
  std::vector<std::thread> threads;
  for (auto& place : seen) threads.emplace_back([&place] { place = &gauss_legendre(27); });
  for (auto& thread : threads) thread.join();
  for (const auto* rule : seen) EXPECT_EQ(rule, seen.front());
}

}  // namespace
}  // namespace flexura

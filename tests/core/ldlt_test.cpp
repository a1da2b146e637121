// L D L^T without pivoting, dense and band: inertia and solutions against Eigen.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "flexura/core/ldlt.hpp"

namespace flexura {
namespace {

/// Symmetric, band of the width given, diagonally dominant with the signs given: no pivot is small.
Eigen::MatrixXd make_matrix(int n, int width, const std::vector<int>& signs, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - width); j < i; ++j) a(i, j) = a(j, i) = uniform(random);
  for (int i = 0; i < n; ++i)
    a(i, i) = signs[static_cast<std::size_t>(i)] * (1.0 + 2.0 * std::min(n, width + 1));
  return a;
}

int negative_eigenvalues(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a, Eigen::EigenvaluesOnly);
  return static_cast<int>((eigen.eigenvalues().array() < 0.0).count());
}

std::vector<double> store(const Eigen::MatrixXd& a, const BandLayout& layout) {
  std::vector<double> entries(layout.n * layout.row_stride + layout.shift, -777.0);
  for (std::size_t i = 0; i < layout.n; ++i)
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j)
      layout.row(entries.data(), i)[j] =
          a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return entries;
}

void expect_solves(const Eigen::MatrixXd& a, const BandLayout& layout) {
  std::vector<double> entries = store(a, layout);
  std::vector<double> scratch(layout.n);
  const LdltInertia inertia = factorize_ldlt(entries.data(), layout, scratch.data());
  EXPECT_FALSE(inertia.weak);
  EXPECT_EQ(inertia.negative, negative_eigenvalues(a));

  const auto n = static_cast<Eigen::Index>(layout.n);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  std::srand(7);
  const Rows b = Rows::Random(n, 4);
  Rows x = b;
  solve_ldlt<4>(entries.data(), layout, x.data());
  EXPECT_LT((a * x - b).cwiseAbs().maxCoeff(), 1e-13);
}

class Ldlt : public ::testing::TestWithParam<int> {};

TEST_P(Ldlt, DenseMatchesEigen) {
  const int n = GetParam();
  std::vector<int> signs(static_cast<std::size_t>(n), 1);
  expect_solves(make_matrix(n, n, signs, 1), dense_layout(static_cast<std::size_t>(n)));
  for (std::size_t i = 0; i < signs.size(); i += 3) signs[i] = -1;
  expect_solves(make_matrix(n, n, signs, 2), dense_layout(static_cast<std::size_t>(n)));
}

TEST_P(Ldlt, BandMatchesEigen) {
  const int n = GetParam();
  std::vector<int> signs(static_cast<std::size_t>(n), 1);
  for (std::size_t i = 1; i < signs.size(); i += 4) signs[i] = -1;
  for (const int width : {1, 2, 5})
    expect_solves(make_matrix(n, width, signs, 3),
                  band_layout(static_cast<std::size_t>(n), static_cast<std::size_t>(width)));
}

INSTANTIATE_TEST_SUITE_P(Sizes, Ldlt, ::testing::Values(1, 2, 3, 7, 20, 61));

/// A matrix of general inertia whose leading minors are far from zero.
TEST(LdltInertia, CountsEveryMixOfSigns) {
  for (unsigned signs = 0; signs < 32; ++signs) {
    std::vector<int> of(5);
    for (std::size_t i = 0; i < 5; ++i) of[i] = (signs >> i & 1U) != 0 ? -1 : 1;
    expect_solves(make_matrix(5, 5, of, signs), dense_layout(5));
  }
}

/// Singular or merely in need of pivoting: either way the caller must do something else.
TEST(LdltWeak, AVanishingPivotIsReported) {
  Eigen::Matrix3d a;
  a << 2.0, 1.0, 3.0, 1.0, 0.5, 1.5, 3.0, 1.5, 9.0;  // second row is half of the first
  std::vector<double> entries = store(a, dense_layout(3));
  double scratch[3];
  EXPECT_TRUE(factorize_ldlt(entries.data(), dense_layout(3), scratch).weak);
  Eigen::Matrix3d saddle;
  saddle << 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 2.0;
  entries = store(saddle, dense_layout(3));
  EXPECT_TRUE(factorize_ldlt(entries.data(), dense_layout(3), scratch).weak);
  std::vector<double> zero(9, 0.0);
  EXPECT_TRUE(factorize_ldlt(zero.data(), dense_layout(3), scratch).weak);
  std::vector<double> nan(9, NAN);
  EXPECT_TRUE(factorize_ldlt(nan.data(), dense_layout(3), scratch).weak);
}

TEST(LdltWeak, AnEmptyMatrixIsRegular) {
  EXPECT_FALSE(factorize_ldlt<double>(nullptr, dense_layout(0), nullptr).weak);
}

}  // namespace
}  // namespace flexura

// Bunch-Kaufman factors: solutions and inertia against Eigen, matrices that need pivoting included.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "flexura/core/ldlt.hpp"
#include "flexura/core/symmetric_factor.hpp"

namespace flexura {
namespace {

Eigen::MatrixXd random_symmetric(int n, unsigned seed) {
  std::srand(seed);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  return a + a.transpose();
}

int negative_eigenvalues(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a, Eigen::EigenvaluesOnly);
  return static_cast<int>((eigen.eigenvalues().array() < 0.0).count());
}

TEST(SymmetricFactor, SolvesAndCountsLikeEigen) {
  SymmetricFactor factor;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const int n = 1 + static_cast<int>(seed);
    const Eigen::MatrixXd a = random_symmetric(n, seed);
    ASSERT_TRUE(factor.factorize(a)) << n;
    EXPECT_EQ(factor.negative(), negative_eigenvalues(a)) << n;
    const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
    Eigen::VectorXd x = b;
    factor.solve(x);
    EXPECT_LT((a * x - b).norm(), 1e-11 * b.norm()) << n;
  }
}

/// A saddle point with a zero block, which no L D L^T without pivoting survives.
TEST(SymmetricFactor, SaddlePointsHaveOneNegativeEigenvaluePerConstraint) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(7, 7);
  a.diagonal().head(4).setConstant(3.0);
  a.bottomLeftCorner(3, 4) << 1, 2, 0, 0, 0, 1, -1, 0, 0, 0, 1, 1;
  a.topRightCorner(4, 3) = a.bottomLeftCorner(3, 4).transpose();
  SymmetricFactor factor;
  ASSERT_TRUE(factor.factorize(a));
  EXPECT_EQ(factor.negative(), 3);
  Eigen::MatrixXd swap(2, 2);
  swap << 0, 1, 1, 0;
  ASSERT_TRUE(factor.factorize(swap));
  EXPECT_EQ(factor.negative(), 1);
  EXPECT_DOUBLE_EQ(factor.pivot_ratio(), 1.0);
}

TEST(SymmetricFactor, ReadsTheLowerTriangleOnly) {
  Eigen::MatrixXd a = random_symmetric(6, 3);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(6);
  const Eigen::VectorXd expected = a.partialPivLu().solve(b);
  a.triangularView<Eigen::StrictlyUpper>().setConstant(NAN);
  SymmetricFactor factor;
  ASSERT_TRUE(factor.factorize(a));
  Eigen::VectorXd x = b;
  factor.solve(x);
  EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm());
}

TEST(SymmetricFactor, SaysHowNearlySingular) {
  SymmetricFactor factor;
  EXPECT_FALSE(factor.factorize(Eigen::MatrixXd::Zero(3, 3)));
  Eigen::MatrixXd rank_one = Eigen::MatrixXd::Ones(3, 3);
  EXPECT_FALSE(factor.factorize(rank_one) && factor.pivot_ratio() > 1e-14);
  Eigen::MatrixXd nearly = Eigen::MatrixXd::Identity(3, 3);
  nearly(1, 1) = nearly(1, 0) = nearly(0, 1) = 1.0;
  nearly(0, 0) += 1e-9;
  ASSERT_TRUE(factor.factorize(nearly));
  EXPECT_NEAR(factor.pivot_ratio(), 1e-9, 1e-15);
  nearly(1, 1) = NAN;
  EXPECT_FALSE(factor.factorize(nearly));
}

/// What takes over where a band has a pivot too weak to divide by: here, every first one vanishes.
TEST(SolveSymmetric, BandsThatNeedPivoting) {
  const BandLayout layout = band_layout(9, 2);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(9, 9);
  for (int i = 0; i < 9; ++i)
    for (int j = std::max(0, i - 2); j < i; ++j) a(i, j) = a(j, i) = 1.0 + 0.1 * i - 0.3 * j;
  std::vector<double> band(9 * 3 + 2, NAN);
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = i > 2 ? i - 2 : 0; j <= i; ++j)
      layout.row(band.data(), i)[j] = a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  using Columns = Eigen::Matrix<double, 9, 4, Eigen::RowMajor>;
  const Columns b = Columns::Random();
  Columns x = b;
  int negative = -1;
  std::vector<double> factor(band.size()), column(9);
  ASSERT_TRUE(
      solve_symmetric(band.data(), layout, factor.data(), column.data(), x.data(), negative));
  EXPECT_EQ(negative, negative_eigenvalues(a));
  EXPECT_LT((a * x - b).cwiseAbs().maxCoeff(), 1e-12);
  const std::vector<double> zero(29, 0.0);
  EXPECT_FALSE(
      solve_symmetric(zero.data(), layout, factor.data(), column.data(), x.data(), negative));
}

TEST(SymmetricFactor, NothingToFactorizeIsRegular) {
  SymmetricFactor factor;
  EXPECT_TRUE(factor.factorize(Eigen::MatrixXd(0, 0)));
  Eigen::VectorXd x(0);
  factor.solve(x);
  EXPECT_EQ(factor.negative(), 0);
}

/// Rows that differ by eight decades say nothing about singularity: stiff flexures beside ones
/// whose load stays unknown give such matrices. Rows of rounding do.
TEST(SymmetricFactor, BadlyScaledRowsAreBalanced) {
  const int n = 8;
  const Eigen::MatrixXd a = random_symmetric(n, 3);
  Eigen::VectorXd scale(n);
  for (int k = 0; k < n; ++k) scale[k] = std::pow(10.0, 1.2 * ((3 * k) % n) - 4.0);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * a * scale.asDiagonal();
  SymmetricFactor factor;
  ASSERT_TRUE(factor.factorize(scaled));
  EXPECT_GT(factor.pivot_ratio(), 1e-4);
  EXPECT_EQ(factor.negative(), negative_eigenvalues(a));
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0);
  Eigen::VectorXd x = scale.cwiseProduct(a * expected);
  factor.solve(x);
  EXPECT_LT((scale.cwiseProduct(x) - expected).norm(), 1e-11);
  Eigen::MatrixXd rounded = Eigen::MatrixXd::Identity(3, 3);
  rounded(2, 2) = 1e-17;
  EXPECT_FALSE(factor.factorize(rounded) && factor.pivot_ratio() > 1e-14);
}

}  // namespace
}  // namespace flexura

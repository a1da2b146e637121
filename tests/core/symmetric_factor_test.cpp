// Bunch-Kaufman factors: solutions and inertia against Eigen, matrices that need pivoting included.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

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
  nearly(1, 1) = 1e-9;
  ASSERT_TRUE(factor.factorize(nearly));
  EXPECT_NEAR(factor.pivot_ratio(), 1e-9, 1e-20);
  nearly(1, 1) = NAN;
  EXPECT_FALSE(factor.factorize(nearly));
}

TEST(SymmetricFactor, NothingToFactorizeIsRegular) {
  SymmetricFactor factor;
  EXPECT_TRUE(factor.factorize(Eigen::MatrixXd(0, 0)));
  Eigen::VectorXd x(0);
  factor.solve(x);
  EXPECT_EQ(factor.negative(), 0);
}

}  // namespace
}  // namespace flexura

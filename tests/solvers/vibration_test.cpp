// Small vibrations of masses and springs, against closed forms.
#include "flexura/solvers/vibration.hpp"

#include <gtest/gtest.h>

namespace flexura {
namespace {

/// Springs of stiffness k between neighbours of a free row of equal masses.
Eigen::MatrixXd free_row(Eigen::Index masses, double k) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(masses, masses);
  for (Eigen::Index i = 0; i + 1 < masses; ++i)
    stiffness.block<2, 2>(i, i) += k * (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished();
  return stiffness;
}

/// What is free has a frequency of zero, and that must not hide the others, however small the shift
/// is that makes its stiffness regular.
TEST(DenseVibrations, FreeMassesKeepTheirOtherFrequencies) {
  for (const double k : {1e-6, 1.0, 1e9}) {
    const Vibrations modes = dense_vibrations(free_row(3, k), Eigen::Matrix3d::Identity(),
                                              Eigen::MatrixXd::Zero(0, 3), 3);
    ASSERT_TRUE(modes.found);
    ASSERT_EQ(modes.squares.size(), 3);
    EXPECT_EQ(modes.squares[0], 0.0);
    EXPECT_NEAR(modes.squares[1], k, 1e-11 * k);
    EXPECT_NEAR(modes.squares[2], 3.0 * k, 1e-11 * k);
    const Eigen::Matrix3d products = modes.shapes.transpose() * modes.shapes;
    EXPECT_LT((products - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(DenseVibrations, ConstraintsHoldAndMasslessUnknownsFollow) {
  // a mass on two springs in a row, without mass between them, and a mass that is held
  Eigen::Matrix3d stiffness = free_row(3, 2.0);
  const Eigen::Matrix3d mass = Eigen::Vector3d(5.0, 0.0, 4.0).asDiagonal();
  const Eigen::MatrixXd constraints = Eigen::RowVector3d(1.0, 0.0, 0.0);
  const Vibrations modes = dense_vibrations(stiffness, mass, constraints, 3);
  ASSERT_EQ(modes.squares.size(), 1);
  EXPECT_NEAR(modes.squares[0], 0.25, 1e-13);
  EXPECT_NEAR(modes.shapes(0, 0), 0.0, 1e-14);
  EXPECT_NEAR(modes.shapes(1, 0), 0.5 * modes.shapes(2, 0), 1e-14);
}

}  // namespace
}  // namespace flexura

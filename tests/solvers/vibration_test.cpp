// Small vibrations of masses and springs, against closed forms.
#include "flexura/solvers/vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/core/symmetric_factor.hpp"
#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/motion_start.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

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

TEST(DenseVibrations, WithoutMassThereAreNone) {
  const Eigen::Matrix3d stiffness = Eigen::Matrix3d::Identity();
  const Eigen::MatrixXd free(0, 3);
  EXPECT_FALSE(dense_vibrations(stiffness, Eigen::Matrix3d::Zero(), free, 3).found);
  const Eigen::MatrixXd nothing(0, 0);
  EXPECT_FALSE(dense_vibrations(nothing, nothing, nothing, 3).found);
}

/// What the sparse solver asks for, of matrices.
class MatrixOperator final : public VibrationOperator {
 public:
  MatrixOperator(Eigen::MatrixXd stiffness, Eigen::VectorXd mass)
      : stiffness_(std::move(stiffness)), mass_(std::move(mass)) {}
  Eigen::Index size() const override { return mass_.size(); }
  Eigen::Index most_rigid() const override { return 3; }
  bool set_shift(double shift) override {
    factor_.compute(shifted(shift));
    return true;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const override { return factor_.solve(b); }
  Eigen::VectorXd multiply_mass(const Eigen::VectorXd& x) const override {
    return mass_.cwiseProduct(x);
  }
  std::optional<int> count_below(double square) const override {
    SymmetricFactor factor;
    if (!factor.factorize(shifted(-square))) return std::nullopt;
    return factor.negative();
  }

 private:
  Eigen::MatrixXd shifted(double shift) const {
    const Eigen::MatrixXd mass = mass_.asDiagonal();
    return stiffness_ + shift * mass;
  }

  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd mass_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

/// 4 k sin^2(i pi/2n) for unit masses.
double free_row_square(int i, int masses, double k) {
  return 4.0 * k * std::pow(std::sin(0.5 * std::numbers::pi * i / masses), 2);
}

TEST(SparseVibrations, AFreeRowHasItsClosedForm) {
  for (const double k : {1e-6, 1.0, 1e9}) {
    MatrixOperator op(free_row(400, k), Eigen::VectorXd::Ones(400));
    const Vibrations modes = sparse_vibrations(op, 12);
    ASSERT_TRUE(modes.found);
    ASSERT_EQ(modes.squares.size(), 12);
    EXPECT_EQ(modes.squares[0], 0.0);
    for (int i = 1; i < 12; ++i) {
      const double truth = free_row_square(i, 400, k);
      EXPECT_NEAR(modes.squares[i] / truth, 1.0, 1e-10) << i;
    }
    const Eigen::MatrixXd products = modes.shapes.transpose() * modes.shapes;
    EXPECT_LT((products - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Many at once: the lowest and the highest of them are 1e-5 of each other.
TEST(SparseVibrations, ManyKeepTheirDigits) {
  MatrixOperator op(free_row(600, 1e6), Eigen::VectorXd::Ones(600));
  const Vibrations modes = sparse_vibrations(op, 150);
  ASSERT_EQ(modes.squares.size(), 150);
  EXPECT_EQ(modes.squares[0], 0.0);
  for (int i = 1; i < 150; ++i)
    EXPECT_NEAR(modes.squares[i] / free_row_square(i, 600, 1e6), 1.0, 1e-9) << i;
  const Eigen::MatrixXd products = modes.shapes.transpose() * modes.shapes;
  EXPECT_LT((products - Eigen::MatrixXd::Identity(150, 150)).cwiseAbs().maxCoeff(), 1e-9);
}

/// Six equal rows side by side: every frequency six times, more than a block of vectors has.
TEST(SparseVibrations, EqualFrequenciesAreAllFound) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(360, 360);
  for (Eigen::Index row = 0; row < 6; ++row)
    stiffness.block<60, 60>(60 * row, 60 * row) = free_row(60, 2.0);
  stiffness.diagonal().array() += 1e-3;
  MatrixOperator op(stiffness, Eigen::VectorXd::Ones(360));
  const Vibrations modes = sparse_vibrations(op, 20);
  ASSERT_EQ(modes.squares.size(), 20);
  for (int i = 0; i < 20; ++i)
    EXPECT_NEAR(modes.squares[i], 1e-3 + free_row_square(i / 6, 60, 2.0), 1e-12) << i;
}

TEST(SparseVibrations, UnstableOnesAndMasslessUnknowns) {
  Eigen::MatrixXd stiffness = free_row(301, 5.0);
  stiffness(0, 0) -= 2.0;
  Eigen::VectorXd mass = Eigen::VectorXd::Ones(301);
  for (Eigen::Index i = 1; i < 301; i += 2) mass[i] = 0.0;
  MatrixOperator op(stiffness, mass);
  const Vibrations sparse = sparse_vibrations(op, 5);
  const Vibrations dense =
      dense_vibrations(stiffness, mass.asDiagonal(), Eigen::MatrixXd::Zero(0, 301), 5);
  ASSERT_EQ(sparse.squares.size(), 5);
  EXPECT_LT(sparse.squares[0], -0.1);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(sparse.squares[i] / dense.squares[i], 1.0, 1e-9) << i;
}

TEST(SparseVibrations, AllThatThereAreAndNoMore) {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(310);
  mass[3] = mass[200] = 2.0;
  Eigen::MatrixXd stiffness = free_row(310, 1.0);
  stiffness(309, 309) += 1.0;
  MatrixOperator op(stiffness, mass);
  const Vibrations modes = sparse_vibrations(op, 6);
  ASSERT_TRUE(modes.found);
  EXPECT_EQ(modes.squares.size(), 2);
}

/// A row of beams in space, ten pinned to one another, of more than 300 coordinates: three rigid
/// motions and nine turns of the pins.
TEST(SparseVibrations, AFreeChainOfBeamsIsTheDenseSolvers) {
  testing::Mechanism chain;
  chain.material(210e3, 0.3).density(7.85e-9).section(RectangleSection{1.0, 10.0});
  for (int i = 0; i < 10; ++i) {
    const std::string left = "left" + std::to_string(i), right = "right" + std::to_string(i);
    const double x = 100.0 * i;
    chain.body(left).centre({x, 0.0}).mass(1e-6, 1e-5).free();
    chain.body(right).centre({x + 100.0, 0.0}).mass(1e-6, 1e-5);
    chain.flexure(left, right, LineAxis{{x, 0.0}, {x + 100.0, 0.0}});
    if (i > 0) chain.pin("right" + std::to_string(i - 1), left, {x, 0.0});
  }
  ModesStudy study;
  const ModelingSettings settings = testing::beam(6, 2);
  MotionStart start = drawn_start(chain, settings, study.inertia);
  ASSERT_GT(start.system->coordinates(), 300);
  const Vibrations sparse =
      find_vibrations(*start.system, start.moment, 30, ModesStudy::Solver::sparse);
  const Vibrations dense =
      find_vibrations(*start.system, start.moment, 30, ModesStudy::Solver::dense);
  ASSERT_TRUE(sparse.found);
  ASSERT_EQ(sparse.squares.size(), 30);
  for (int i = 0; i < 30; ++i) {
    if (i < 12) {
      EXPECT_EQ(sparse.squares[i], 0.0) << i;
    } else {
      EXPECT_GT(sparse.squares[i], 0.0) << i;
      EXPECT_NEAR(sparse.squares[i] / dense.squares[i], 1.0, 1e-9) << i;
    }
  }
  const ModelingModes modes = run_modes(chain, study, settings, {});  // refines, sparse again
  EXPECT_TRUE(modes.termination.converged()) << modes.termination.reason;
  EXPECT_TRUE(modes.error_estimate.has_value() || modes.modes.back().value == 0.0);
}

}  // namespace
}  // namespace flexura

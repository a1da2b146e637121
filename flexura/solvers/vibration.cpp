#include "flexura/solvers/vibration.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace flexura {
namespace {

/// K + shift M with the constraints around it, rows and columns scaled to entries of order one.
struct Bordered {
  Bordered(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
           const Eigen::MatrixXd& constraints, double shift) {
    const Eigen::Index n = stiffness.rows();
    const Eigen::Index m = constraints.rows();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + m, n + m);
    matrix.topLeftCorner(n, n) = stiffness + shift * mass;
    matrix.bottomLeftCorner(m, n) = constraints;
    matrix.topRightCorner(n, m) = constraints.transpose();
    scale = Eigen::VectorXd::Ones(n + m);
    for (int pass = 0; pass < 3; ++pass) {
      const Eigen::VectorXd largest = matrix.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300);
      const Eigen::VectorXd by = largest.cwiseSqrt().cwiseInverse();
      matrix = by.asDiagonal() * matrix * by.asDiagonal();
      scale.array() *= by.array();
    }
    factor.compute(matrix);
  }
  bool is_regular() const { return factor.rcond() > 1e-15; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(scale.size(), b.cols());
    whole.topRows(b.rows()) = b;
    whole = scale.asDiagonal() * factor.solve(scale.asDiagonal() * whole);
    return whole.topRows(b.rows());
  }

  Eigen::VectorXd scale;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor;
};

/// B of M = B^T B, what has no mass left out. (Where some motion has none, pivots are no guide:
/// they need not descend, and those that should be zero are followed by rounding.)
Eigen::MatrixXd mass_root(const Eigen::MatrixXd& mass) {
  constexpr double nothing = 1e-13;  // of the largest
  const Eigen::VectorXd size = mass.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd by = (size.array() > 0.0).select(size.cwiseInverse(), 0.0);
  const Eigen::MatrixXd sized = size.asDiagonal();
  const Eigen::MatrixXd scaled = by.asDiagonal() * mass * by.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
  if (factor.vectorD().minCoeff() > 1e-12) {
    const Eigen::MatrixXd permuted = factor.transpositionsP() * sized;
    const Eigen::MatrixXd upper = factor.matrixU();
    return factor.vectorD().cwiseSqrt().asDiagonal() * (upper * permuted);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const Eigen::VectorXd& masses = eigen.eigenvalues();  // ascending
  const double largest = masses.tail(1).sum();
  const auto rank = (masses.array() > nothing * largest).count();
  return masses.tail(rank).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().rightCols(rank).transpose() * sized;
}

void normalize(Vibrations& modes, const Eigen::VectorXd& squared_sizes) {
  for (Eigen::Index i = 0; i < modes.shapes.cols(); ++i)
    modes.shapes.col(i) /= std::sqrt(squared_sizes[i]);
}

/// Spectra's view of the operator.
struct ShiftedSolve {
  using Scalar = double;
  VibrationOperator& op;
  Eigen::Index rows() const { return op.size(); }
  Eigen::Index cols() const { return op.size(); }
  void set_shift(double) {}  // done before
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, op.size()) =
        op.solve(Eigen::Map<const Eigen::VectorXd>(in, op.size()));
  }
};
struct MassProduct {
  using Scalar = double;
  VibrationOperator& op;
  Eigen::Index rows() const { return op.size(); }
  Eigen::Index cols() const { return op.size(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, op.size()) =
        op.multiply_mass(Eigen::Map<const Eigen::VectorXd>(in, op.size()));
  }
};

}  // namespace

Vibrations dense_vibrations(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                            const Eigen::MatrixXd& constraints, int count) {
  Vibrations modes;
  const Eigen::MatrixXd root = mass_root(mass);
  const double unit = stiffness.trace() / std::max(mass.trace(), 1e-300);
  double shift = 0.0;
  Bordered bordered(stiffness, mass, constraints, shift);
  for (double share = 1e-14; !bordered.is_regular(); share *= 10.0) {
    if (share > 1e3 || root.rows() == 0) return modes;
    shift = share * std::abs(unit);
    bordered = Bordered(stiffness, mass, constraints, shift);
  }
  const Eigen::MatrixXd moved = bordered.solve(root.transpose());
  const Eigen::MatrixXd inverse = root * moved;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (inverse + inverse.transpose()));
  if (eigen.info() != Eigen::Success) return modes;
  const Eigen::VectorXd& theta = eigen.eigenvalues();  // 1/(square + shift)
  const double largest = theta.cwiseAbs().maxCoeff();
  std::vector<std::pair<double, Eigen::Index>> found;
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    if (!(std::abs(theta[i]) > 1e-13 * largest)) continue;
    const double square = 1.0 / theta[i] - shift;
    found.emplace_back(std::abs(square) < 1e-9 * shift ? 0.0 : square, i);
  }
  std::sort(found.begin(), found.end());
  const auto wanted = std::min<Eigen::Index>(count, static_cast<Eigen::Index>(found.size()));
  modes.squares.resize(wanted);
  modes.shapes.resize(mass.rows(), wanted);
  for (Eigen::Index k = 0; k < wanted; ++k) {
    const auto [square, i] = found[static_cast<std::size_t>(k)];
    modes.squares[k] = square;
    modes.shapes.col(k) = moved * eigen.eigenvectors().col(i);
  }
  normalize(modes, (modes.shapes.transpose() * mass * modes.shapes).diagonal());
  modes.found = true;
  return modes;
}

Vibrations sparse_vibrations(VibrationOperator& op, int count, double shift_unit) {
  using Solver =
      Spectra::SymGEigsShiftSolver<ShiftedSolve, MassProduct, Spectra::GEigsMode::ShiftInvert>;
  Vibrations modes;
  double shift = 0.0;
  const int wanted = static_cast<int>(std::min<Eigen::Index>(count, op.size() - 1));
  const int vectors = static_cast<int>(std::min<Eigen::Index>(op.size(), 2 * wanted + 20));
  for (int attempt = 0; attempt < 8; ++attempt) {
    if (!op.set_shift(shift)) {
      shift = std::max(10.0 * shift, shift_unit);
      continue;
    }
    ShiftedSolve solve{op};
    MassProduct product{op};
    Solver solver(solve, product, wanted, vectors, -shift);
    // what has no mass is no part of the start
    const Eigen::VectorXd start = op.solve(Eigen::VectorXd::LinSpaced(op.size(), 1.0, 1.7));
    solver.init(start.data());
    const auto converged = solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12,
                                          Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful || converged < wanted) return modes;
    const Eigen::VectorXd squares = solver.eigenvalues();
    if (squares.minCoeff() < -shift) {  // beyond the shift: others may be hidden behind it
      shift = 2.0 * std::abs(squares.minCoeff());
      continue;
    }
    modes.squares = squares;
    modes.shapes = solver.eigenvectors();
    Eigen::VectorXd sizes(wanted);
    for (Eigen::Index i = 0; i < wanted; ++i) {
      // once more through the operator: drops what the mass does not see
      modes.shapes.col(i) = op.solve(op.multiply_mass(modes.shapes.col(i)));
      sizes[i] = modes.shapes.col(i).dot(op.multiply_mass(modes.shapes.col(i)));
    }
    normalize(modes, sizes);
    modes.found = true;
    return modes;
  }
  return modes;
}

}  // namespace flexura

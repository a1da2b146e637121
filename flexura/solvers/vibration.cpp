#include "flexura/solvers/vibration.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

constexpr double regular = 1e-11;  // least over largest pivot

/// Cholesky's pivots tell whether the matrix is positive definite, and how safely.
bool is_positive(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::MatrixXd unit =
      scale.cwiseInverse().asDiagonal() * matrix * scale.cwiseInverse().asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(unit);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd pivots = Eigen::MatrixXd(factor.matrixL()).diagonal();
  return pivots.size() == 0 || pivots.minCoeff() > std::sqrt(regular) * pivots.maxCoeff();
}

/// Orthonormal basis of what the constraints leave.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& constraints) {
  const Eigen::Index n = constraints.cols();
  if (constraints.rows() == 0) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(constraints.transpose());
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
  return q.rightCols(n - qr.rank());
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
  const Eigen::MatrixXd basis = null_space(constraints);
  const Eigen::MatrixXd k = basis.transpose() * stiffness * basis;
  const Eigen::MatrixXd m = basis.transpose() * mass * basis;
  if (basis.cols() == 0) {
    modes.found = true;
    return modes;
  }
  const double unit = k.trace() / std::max(m.trace(), 1e-300);
  double shift = 0.0;
  for (double share = 1e-14; !is_positive(k + shift * m); share *= 10.0) {
    if (share > 1e3) return modes;
    shift = share * unit;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(m, k + shift * m);
  if (eigen.info() != Eigen::Success) return modes;
  // theta ascends: the lowest frequencies come last, what has no mass first
  const double largest = eigen.eigenvalues().tail(1)[0];
  const Eigen::Index n = basis.cols();
  Eigen::Index wanted = 0;
  while (wanted < std::min<Eigen::Index>(count, n) &&
         eigen.eigenvalues()[n - 1 - wanted] > 1e-13 * largest)
    ++wanted;
  modes.squares.resize(wanted);
  modes.shapes.resize(basis.rows(), wanted);
  for (Eigen::Index i = 0; i < wanted; ++i) {
    const double theta = eigen.eigenvalues()[n - 1 - i];
    modes.squares[i] = 1.0 / theta - shift;
    if (std::abs(modes.squares[i]) < 1e-9 * shift) modes.squares[i] = 0.0;
    modes.shapes.col(i) = basis * eigen.eigenvectors().col(n - 1 - i);
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

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

/// Takes out what rounding has left in a shape of those before it: zero frequencies answer the
/// least load without bound.
void part_from_lower(Vibrations& modes, const Eigen::MatrixXd& mass) {
  for (Eigen::Index k = 1; k < modes.shapes.cols(); ++k) {
    const Eigen::VectorXd momentum = mass * modes.shapes.col(k);
    const Eigen::VectorXd shares = modes.shapes.leftCols(k).transpose() * momentum;
    modes.shapes.col(k) -= modes.shapes.leftCols(k) * shares;
  }
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

/// Eigenvectors of B A^-1 B^T with their eigenvalues 1/(square + shift).
struct Inverse {
  Inverse(const Bordered& bordered, const Eigen::MatrixXd& root)
      : moved(bordered.solve(root.transpose())) {
    const Eigen::MatrixXd product = root * moved;
    eigen.compute(0.5 * (product + product.transpose()));
  }
  /// The largest eigenvalue but for those of squares below the shift, by that of a square of zero.
  double beyond(double shift) const {
    double largest = 0.0;
    for (const double theta : eigen.eigenvalues())
      if (const double share = std::abs(theta) * shift; share < 0.5)
        largest = std::max(largest, share);
    return largest;
  }

  Eigen::MatrixXd moved;  // A^-1 B^T
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
};

}  // namespace

Vibrations dense_vibrations(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                            const Eigen::MatrixXd& constraints, int count) {
  constexpr double most = 1e3;     // shift, in ratios of the traces
  constexpr double enough = 1e-4;  // beside zero frequencies: eleven digits of the others are left
  Vibrations modes;
  const Eigen::MatrixXd root = mass_root(mass);
  const double unit = std::abs(stiffness.trace() / std::max(mass.trace(), 1e-300));
  double share = 0.0;
  Bordered bordered(stiffness, mass, constraints, 0.0);
  const auto raise = [&] {
    share = std::max(1e-14, 10.0 * share);
    bordered = Bordered(stiffness, mass, constraints, share * unit);
  };
  while (!bordered.is_regular()) {
    if (share > most || root.rows() == 0) return modes;
    raise();
  }
  Inverse inverse(bordered, root);
  // a shift far below the other frequencies hides them behind those that are zero
  while (share > 0.0 && share < most && inverse.eigen.info() == Eigen::Success &&
         inverse.beyond(share * unit) < enough) {
    raise();
    inverse = Inverse(bordered, root);
  }
  if (inverse.eigen.info() != Eigen::Success) return modes;
  const double shift = share * unit;
  const Eigen::VectorXd& theta = inverse.eigen.eigenvalues();
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
    modes.shapes.col(k) = inverse.moved * inverse.eigen.eigenvectors().col(i);
  }
  normalize(modes, (modes.shapes.transpose() * mass * modes.shapes).diagonal());
  if (shift > 0.0) part_from_lower(modes, mass);
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

#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/core/ldlt.hpp"

namespace flexura {

/// Scales a square matrix in place to diag(d) A diag(d) and returns d: rows come to be alike in
/// size where they differed by more than a factor of a million. Stiff flexures beside ones whose
/// load stays unknown make them differ by the square of the slenderness and more, and soft
/// directions would drown in the rounding of stiff ones. Other matrices stay as they are, and those
/// with rows of nothing but rounding.
Eigen::VectorXd balance_rows(Eigen::Ref<Eigen::MatrixXd> matrix);

/// Bunch-Kaufman factorization (LAPACK dsytrf) of a dense symmetric indefinite matrix, with its
/// inertia. Badly scaled rows are balanced first.
class SymmetricFactor {
 public:
  /// Reads the lower triangle. False where a pivot vanishes; `pivot_ratio` says how nearly.
  bool factorize(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
  void solve(Eigen::Ref<Eigen::VectorXd> b) const;

  int negative() const { return negative_; }
  /// |smallest| / |largest| eigenvalue of the pivot blocks.
  double pivot_ratio() const { return pivot_ratio_; }

 private:
  Eigen::MatrixXd factor_;
  Eigen::VectorXd balance_;
  std::vector<int> pivots_;
  std::vector<double> work_;
  int negative_ = 0;
  double pivot_ratio_ = 0.0;
};

/// Solves with a symmetric band matrix (laid out as for factorize_ldlt) for four interleaved
/// right-hand sides, in place: unpivoted, and by the pivoted factorization of the dense matrix in
/// the rare case that a pivot is weak. `factor` is scratch for a copy of the matrix, `column` for n
/// doubles. `negative` counts negative eigenvalues; false where the matrix is singular.
bool solve_symmetric(const double* a, const BandLayout& layout, double* factor, double* column,
                     double* right_hand_sides, int& negative);

}  // namespace flexura

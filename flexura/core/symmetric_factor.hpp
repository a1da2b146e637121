#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/core/ldlt.hpp"

namespace flexura {

/// Bunch-Kaufman factorization (LAPACK dsytrf) of a dense symmetric indefinite matrix, with its
/// inertia.
class SymmetricFactor {
 public:
  /// Reads the lower triangle. False where a pivot vanishes; `smallest_pivot` says how nearly.
  bool factorize(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
  void solve(Eigen::Ref<Eigen::VectorXd> b) const;

  int negative() const { return negative_; }
  /// |smallest| / |largest| eigenvalue of the pivot blocks.
  double pivot_ratio() const { return pivot_ratio_; }

 private:
  Eigen::MatrixXd factor_;
  std::vector<int> pivots_;
  std::vector<double> work_;
  int negative_ = 0;
  double pivot_ratio_ = 0.0;
};

/// Solves with a symmetric band matrix (laid out as for factorize_ldlt, not factorized) for four
/// interleaved right-hand sides by the pivoted factorization, as a dense matrix. False where it is
/// singular or too large for that. Allocates; for the rare matrix that factorize_ldlt finds weak.
bool solve_symmetric(const double* a, const BandLayout& layout, double* columns, int& negative);

}  // namespace flexura

#include "flexura/core/symmetric_factor.hpp"

#include <algorithm>
#include <cmath>

extern "C" {
void dsytrf_(const char* uplo, const int* n, double* a, const int* lda, int* ipiv, double* work,
             const int* lwork, int* info, std::size_t uplo_length);
void dsytrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda,
             const int* ipiv, double* b, const int* ldb, int* info, std::size_t uplo_length);
}

namespace flexura {

bool SymmetricFactor::factorize(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  factor_ = matrix;
  const int n = static_cast<int>(matrix.rows());
  negative_ = 0;
  pivot_ratio_ = 1.0;
  if (n == 0) return true;
  pivots_.resize(static_cast<std::size_t>(n));
  work_.resize(static_cast<std::size_t>(n) * 64);
  const int work_size = static_cast<int>(work_.size());
  int info = 0;
  dsytrf_("L", &n, factor_.data(), &n, pivots_.data(), work_.data(), &work_size, &info, 1);
  if (info < 0) return false;

  double smallest = INFINITY;
  double largest = 0.0;
  const auto count = [&](double eigenvalue) {
    if (eigenvalue < 0.0) ++negative_;
    smallest = std::fmin(smallest, std::abs(eigenvalue));
    largest = std::fmax(largest, std::abs(eigenvalue));
  };
  for (int k = 0; k < n; ++k) {
    if (pivots_[static_cast<std::size_t>(k)] > 0) {
      count(factor_(k, k));
      continue;
    }
    // a 2 x 2 pivot block, always indefinite
    const double mean = 0.5 * (factor_(k, k) + factor_(k + 1, k + 1));
    const double radius =
        std::hypot(0.5 * (factor_(k, k) - factor_(k + 1, k + 1)), factor_(k + 1, k));
    count(mean - radius);
    count(mean + radius);
    ++k;
  }
  pivot_ratio_ = smallest / largest;
  return info == 0 && std::isfinite(largest) && smallest > 0.0;
}

void SymmetricFactor::solve(Eigen::Ref<Eigen::VectorXd> b) const {
  const int n = static_cast<int>(factor_.rows());
  if (n == 0) return;
  const int one = 1;
  int info = 0;
  dsytrs_("L", &n, &one, factor_.data(), &n, pivots_.data(), b.data(), &n, &info, 1);
}

}  // namespace flexura

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

Eigen::VectorXd balance_rows(Eigen::Ref<Eigen::MatrixXd> matrix) {
  constexpr double alike = 1e-6, even = 0.1, rounding = 1e-13;
  constexpr int most_sweeps = 8;
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(matrix.rows());
  if (matrix.rows() == 0) return factors;
  Eigen::VectorXd sizes = matrix.cwiseAbs().rowwise().maxCoeff();
  const auto spread = [&sizes] { return sizes.minCoeff() / sizes.maxCoeff(); };
  // rows of zeros, but for rounding, have no size: the factorization will say what they mean
  if (!sizes.allFinite() || !(spread() > rounding) || spread() > alike) return factors;
  for (int sweep = 0; sweep < most_sweeps && spread() < even; ++sweep) {
    sizes = sizes.cwiseSqrt().cwiseInverse();
    matrix = sizes.asDiagonal() * matrix * sizes.asDiagonal();
    factors.array() *= sizes.array();
    sizes = matrix.cwiseAbs().rowwise().maxCoeff();
  }
  return factors;
}

bool SymmetricFactor::factorize(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  factor_ = matrix.selfadjointView<Eigen::Lower>();
  balance_ = balance_rows(factor_);
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
  b.array() *= balance_.array();
  dsytrs_("L", &n, &one, factor_.data(), &n, pivots_.data(), b.data(), &n, &info, 1);
  b.array() *= balance_.array();
}

namespace {

bool solve_pivoted(const double* a, const BandLayout& layout, double* columns, int& negative) {
  constexpr std::size_t largest_dense = 2000;
  if (layout.n > largest_dense) return false;
  const auto n = static_cast<Eigen::Index>(layout.n);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < layout.n; ++i)
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j)
      dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = layout.row(a, i)[j];
  SymmetricFactor factor;
  if (!factor.factorize(dense) || factor.pivot_ratio() < 1e-15) return false;
  negative = factor.negative();
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>> b(columns, n, 4);
  for (Eigen::Index c = 0; c < 4; ++c) {
    Eigen::VectorXd column = b.col(c);
    factor.solve(column);
    b.col(c) = column;
  }
  return true;
}

}  // namespace

bool solve_symmetric(const double* a, const BandLayout& layout, double* factor, double* column,
                     double* right_hand_sides, int& negative) {
  std::copy_n(a, layout.n * layout.row_stride, factor);
  const LdltInertia inertia = factorize_ldlt(factor, layout, column);
  if (inertia.weak) return solve_pivoted(a, layout, right_hand_sides, negative);
  negative = inertia.negative;
  solve_ldlt<4>(factor, layout, right_hand_sides);
  return true;
}

}  // namespace flexura

#pragma once

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <memory>
#include <mutex>
#include <vector>

namespace flexura {

/// L D L^T of a sparse symmetric matrix in an order of little fill, which is found once.
class LinkFactor {
 public:
  explicit LinkFactor(const Eigen::SparseMatrix<double>& pattern) : matrix_(pattern) {
    solver_.analyzePattern(matrix_);
  }

  /// In the order of the pattern.
  double* values() { return matrix_.valuePtr(); }
  void clear() { matrix_.coeffs().setZero(); }

  struct Pivots {
    int negative = 0;
    bool weak = false;  ///< one of them is rounding
  };
  Pivots factorize() {
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success) return {0, true};
    const Eigen::ArrayXd d = solver_.vectorD().array();
    constexpr double rounding = 1e-14;
    return {static_cast<int>((d < 0.0).count()),
            !(d.abs().minCoeff() > rounding * d.abs().maxCoeff())};
  }

  template <class Matrix>
  Eigen::MatrixXd solve(const Matrix& sides) const {
    return solver_.solve(sides);
  }

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

/// As many factors as threads ask for at a time.
class LinkFactors {
 public:
  explicit LinkFactors(const Eigen::SparseMatrix<double>& pattern) : pattern_(pattern) {
    idle_.push_back(std::make_unique<LinkFactor>(pattern_));
  }

  std::unique_ptr<LinkFactor> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<LinkFactor>(pattern_);
    auto factor = std::move(idle_.back());
    idle_.pop_back();
    return factor;
  }
  void give_back(std::unique_ptr<LinkFactor> factor) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(factor));
  }

 private:
  const Eigen::SparseMatrix<double>& pattern_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<LinkFactor>> idle_;
};

}  // namespace flexura

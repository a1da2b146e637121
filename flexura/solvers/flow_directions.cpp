#include "flexura/solvers/flow_directions.hpp"

#include <algorithm>
#include <numeric>

namespace flexura {
namespace {

/// What is left of a vector that lies in the span is rounding.
constexpr double in_span = 1e-8;

void append(Eigen::MatrixXd& columns, const Eigen::VectorXd& column) {
  columns.conservativeResize(column.size(), columns.cols() + 1);
  columns.rightCols<1>() = column;
}

}  // namespace

void FlowDirections::clear() {
  directions_.resize(0, 0);
  images_.resize(0, 0);
}

/// Gram and Schmidt's, twice, so that what it leaves is across to rounding.
Eigen::VectorXd FlowDirections::across(const Eigen::VectorXd& x) const {
  const double before = x.norm();
  if (!(before > 0.0)) return {};
  Eigen::VectorXd left = x / before;
  for (int pass = 0; pass < 2 && count() > 0; ++pass)
    left -= directions_ * (directions_.transpose() * left);
  const double length = left.norm();
  if (!(length > in_span)) return {};
  return left / length;
}

void FlowDirections::add(const Eigen::VectorXd& direction, const Eigen::VectorXd& image) {
  append(directions_, direction);
  append(images_, image);
}

void FlowDirections::learn(const Eigen::VectorXd& step, const Eigen::VectorXd& image) {
  constexpr double little = 1e-2;  // of the step, across
  const double square = step.squaredNorm();
  if (!(square > 0.0)) return;
  Eigen::VectorXd defect = image;
  if (count() > 0) {
    const Eigen::VectorXd shares = directions_.transpose() * step;
    defect -= images_ * shares;
    images_ += defect * shares.transpose() / square;
  }
  const Eigen::VectorXd direction = across(step);
  if (direction.size() == 0) return;
  const double part = direction.dot(step);
  if (part * part > little * little * square) add(direction, part / square * defect);
}

auto FlowDirections::solve(const Eigen::VectorXd& r) const -> Solution {
  if (count() == 0) return {Eigen::VectorXd::Zero(r.size()), r};
  const Eigen::MatrixXd moved = images_ - directions_;
  const Eigen::VectorXd shares = moved.colPivHouseholderQr().solve(-r);
  return {directions_ * shares, r + moved * shares};
}

std::vector<RitzPair> FlowDirections::ritz_pairs() const {
  const Eigen::Index n = count();
  if (n == 0) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(directions_.transpose() * images_);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  // of a conjugate pair, the one above the real axis first
  const auto precedes = [&](Eigen::Index a, Eigen::Index b) {
    const std::complex<double> x = eigen.eigenvalues()[a], y = eigen.eigenvalues()[b];
    if (x == std::conj(y)) return x.imag() > y.imag();
    return std::abs(x) > std::abs(y);
  };
  std::stable_sort(order.begin(), order.end(), precedes);
  std::vector<RitzPair> pairs;
  for (const Eigen::Index k : order) {
    const std::complex<double> value = eigen.eigenvalues()[k];
    const Eigen::VectorXcd shares = eigen.eigenvectors().col(k).normalized();
    RitzPair pair{value, directions_ * shares, {}};
    pair.residual = images_ * shares - value * pair.vector;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace flexura

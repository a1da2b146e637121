#include "flexura/solvers/block_lanczos.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

constexpr Eigen::Index block = 4;
constexpr double least_residual = 1e-13;  // of the largest value: what solving leaves
constexpr double residual = 1e-9;         // of the value, whose error is of second order
constexpr double enough = 1e-6;           // where a space grows beyond what is usual

}  // namespace

BlockLanczos::BlockLanczos(SymmetricPencil pencil) : pencil_(std::move(pencil)) { reserve(block); }

/// Numbers between -1 and 1, the same on every machine (Marsaglia's xorshift).
Eigen::VectorXd BlockLanczos::next_random() {
  Eigen::VectorXd x(pencil_.size);
  for (double& value : x) {
    seed_ ^= seed_ << 13;
    seed_ ^= seed_ >> 7;
    seed_ ^= seed_ << 17;
    value = static_cast<double>(seed_ >> 11) * 0x1p-52 - 1.0;
  }
  return x;
}

void BlockLanczos::reserve(Eigen::Index columns) {
  if (columns <= basis_.cols()) return;
  const Eigen::Index room = std::max(columns, 2 * basis_.cols());
  basis_.conservativeResize(pencil_.size, room);
  momenta_.conservativeResize(pencil_.size, room);
  matrix_.conservativeResize(room, room);
}

/// Adds what is new of x, unless its size is below `least` of that of x.
bool BlockLanczos::append(Eigen::VectorXd x, double least) {
  double before = x.dot(pencil_.multiply_mass(x));
  if (!(before > 0.0)) return false;
  const double whole = before;
  for (int pass = 0; pass < 3; ++pass) {  // twice is enough, if rounding were all
    x -= basis_.leftCols(columns_) * (momenta_.leftCols(columns_).transpose() * x);
    const double after = x.dot(pencil_.multiply_mass(x));
    if (!(after > least * least * whole)) return false;
    if (after > 0.25 * before && pass > 0) break;
    before = after;
  }
  const Eigen::VectorXd momentum = pencil_.multiply_mass(x);
  const double size = std::sqrt(x.dot(momentum));
  reserve(columns_ + 1);
  basis_.col(columns_) = x / size;
  momenta_.col(columns_) = momentum / size;
  ++columns_;
  return true;
}

/// One block more: images of the last, or vectors from nowhere.
bool BlockLanczos::grow() {
  const Eigen::Index first = images_;
  const Eigen::Index last = columns_;
  for (Eigen::Index j = first; j < last; ++j) {
    const Eigen::VectorXd image = pencil_.inverse(momenta_.col(j));
    if (!image.allFinite()) return false;
    matrix_.col(j).head(last) = momenta_.leftCols(last).transpose() * image;
    append(image, 1e-13);
  }
  // what the images of this block have in the next one
  images_ = last;
  const bool stuck = columns_ == last;
  if (stuck || from_nowhere_) {
    const Eigen::Index before = columns_;
    for (Eigen::Index i = 0; i < block; ++i)
      append(pencil_.inverse(pencil_.multiply_mass(next_random())), 1e-10);
    exhausted_ = columns_ == before && stuck;
    from_nowhere_ = false;
  }
  return true;
}

void BlockLanczos::project() {
  const Eigen::MatrixXd upper = matrix_.topLeftCorner(images_, images_);
  // columns of earlier blocks were projected onto fewer vectors: their lower part is by symmetry
  const Eigen::MatrixXd whole = upper.selfadjointView<Eigen::Upper>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(whole);
  values_ = eigen.eigenvalues().reverse();
  shapes_ = eigen.eigenvectors().rowwise().reverse();
}

/// The smallest values settle last.
bool BlockLanczos::has_settled(Eigen::Index count) const {
  if (exhausted_) return true;
  if (values_.size() < count + block) return false;
  const double share = images_ > 4 * count + 200 ? enough : residual;
  for (Eigen::Index i = count; i-- > 0;) {
    const Eigen::VectorXd x = basis_.leftCols(images_) * shapes_.col(i);
    const Eigen::VectorXd momentum = momenta_.leftCols(images_) * shapes_.col(i);
    const Eigen::VectorXd rest = pencil_.inverse(momentum) - values_[i] * x;
    const double size = std::sqrt(std::max(0.0, rest.dot(pencil_.multiply_mass(rest))));
    if (size > least_residual * values_[0] + share * std::abs(values_[i])) return false;
  }
  return true;
}

bool BlockLanczos::settle(Eigen::Index count) {
  Eigen::Index next = std::max(columns_ + block, count + 2 * block);
  while (!exhausted_) {
    while (!exhausted_ && columns_ < next)
      if (!grow()) return false;
    project();
    if (has_settled(count)) return true;
    next = columns_ + std::max(block, columns_ / 4);
  }
  project();
  return true;
}

Eigen::MatrixXd BlockLanczos::vectors(Eigen::Index count) const {
  return basis_.leftCols(images_) * shapes_.leftCols(count);
}

}  // namespace flexura

#include "flexura/solvers/vibration.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "flexura/solvers/block_lanczos.hpp"

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

/// Takes out what rounding has left in a shape of those before it: low frequencies answer the
/// least load by much, zero ones without bound.
template <class MassProduct>
void part_from_lower(Vibrations& modes, const MassProduct& multiply_mass) {
  for (Eigen::Index k = 1; k < modes.shapes.cols(); ++k) {
    const Eigen::VectorXd momentum = multiply_mass(modes.shapes.col(k));
    const Eigen::VectorXd shares = modes.shapes.leftCols(k).transpose() * momentum;
    modes.shapes.col(k) -= modes.shapes.leftCols(k) * shares;
  }
}

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
  if (mass.isZero(0.0)) return modes;
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
  part_from_lower(modes, [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(mass * x); });
  modes.found = true;
  return modes;
}

namespace {

/// The sparse solver at work: frequencies from the bottom of the spectrum, at shifts with which
/// K + shift M is definite, so that nothing hides below.
class SparseSolver {
  static constexpr double nothing = 1e-9;  // of a shift: zero
  // of the highest square that is wanted: the shift, with which those between lie well apart
  static constexpr double part = 0.03;

 public:
  SparseSolver(VibrationOperator& op, int count)
      : op_(&op), count_(std::min<Eigen::Index>(count, op.size())) {}

  Vibrations run();

 private:
  bool find_shift();
  bool grow_until_definite();
  bool solve();
  bool descend();
  int missed(const BlockLanczos& lanczos) const;
  std::optional<int> below(double square) const;

  VibrationOperator* op_;
  Eigen::Index count_;
  double shift_ = 1.0;
  Eigen::VectorXd squares_;  // ascending
  Eigen::MatrixXd shapes_;
  struct Part {
    Eigen::VectorXd squares;
    Eigen::MatrixXd shapes;
  };
  std::vector<Part> above_;  // found at higher shifts, the highest first
};

/// How many squares lie below; at a square itself, a little beside it.
std::optional<int> SparseSolver::below(double square) const {
  for (const double by : {1.0, 1.0 + 1e-9, 1.0 + 1e-7})
    if (const auto count = op_->count_below(square * by)) return count;
  return std::nullopt;
}

/// By the square of the first frequency that is not zero and not among those wanted, known to a
/// factor of ten: of the size of what is asked for, in whatever units. Where masses are fewer, by
/// the highest.
bool SparseSolver::find_shift() {
  constexpr int most = 60;   // powers of ten
  constexpr int quiet = 12;  // without one more: there are no more
  const int wanted = static_cast<int>(std::max(count_, op_->most_rigid())) + 1;
  const auto count = [&](int power) { return below(std::pow(10.0, power)).value_or(0); };
  int power = 0;
  int found = count(0);
  for (int higher = 1; higher < most && found < wanted; ++higher) {
    const int now = count(higher);
    if (now > found) {
      found = now;
      power = higher;
    } else if (found > 0 && higher - power > quiet) {
      break;
    }
  }
  if (found == 0) return false;
  const int enough = std::min(found, wanted);
  while (power > -most && count(power - 1) >= enough) --power;
  shift_ = part * std::pow(10.0, power);
  return grow_until_definite();
}

bool SparseSolver::grow_until_definite() {
  for (int attempt = 0; attempt < 60; ++attempt, shift_ *= 10.0)
    if (below(-shift_) == 0 && op_->set_shift(shift_)) return true;
  return false;
}

/// Modes that an inertia counts below the highest, and that were not found.
int SparseSolver::missed(const BlockLanczos& lanczos) const {
  const Eigen::VectorXd& values = lanczos.values();
  double edge = 1.0 / values[count_ - 1];  // of square + shift
  double gap = 1e-6;
  for (int doubled = 0; doubled < 19; ++doubled, gap *= 2.0) {
    edge = (1.0 - gap) / values[count_ - 1];
    const auto is_near = [&](double value) { return std::abs(value * edge - 1.0) < 0.1 * gap; };
    if (std::none_of(values.begin(), values.begin() + count_, is_near)) break;
  }
  const auto all = below(edge - shift_);
  const auto found = std::count_if(values.begin(), values.begin() + count_,
                                   [&](double value) { return value * edge > 1.0; });
  return all ? *all - static_cast<int>(found) : 0;
}

bool SparseSolver::solve() {
  constexpr int most_attempts = 5;
  const auto inverse = [&](const Eigen::VectorXd& b) { return op_->solve(b); };
  const auto mass = [&](const Eigen::VectorXd& x) { return op_->multiply_mass(x); };
  BlockLanczos lanczos({op_->size(), inverse, mass});
  Eigen::Index count = 0;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    if (!op_->set_shift(shift_) || !lanczos.settle(count_)) return false;
    // what an exhausted space has besides is rounding, or held by the constraints
    const Eigen::VectorXd& values = lanczos.values();
    const auto is_real = [&](double value) { return value > 1e-13 * values[0]; };
    count = std::min<Eigen::Index>(count_, std::count_if(values.begin(), values.end(), is_real));
    if (count == 0) return false;
    if (count < count_ || missed(lanczos) <= 0) {
      squares_ = values.head(count).cwiseInverse().array() - shift_;
      shapes_ = lanczos.vectors(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        // once more through the operator: drops what the mass does not see
        const Eigen::VectorXd x = op_->solve(op_->multiply_mass(shapes_.col(i)));
        shapes_.col(i) = x / std::sqrt(x.dot(op_->multiply_mass(x)));
      }
      return true;
    }
    lanczos.widen();
  }
  return false;
}

/// A shift far above squares costs their digits: those again, by the largest of them. Of squares
/// that are nothing at all beside the shift, nothing is known but that a mechanism has them; if all
/// are, the shift may have been too large by far.
bool SparseSolver::descend() {
  constexpr double far = 1e-3;
  const Eigen::ArrayXd sizes = squares_.array().abs();
  const Eigen::Index low = (sizes < far * shift_).count();  // among the lowest, as shift_ is above
  if (low == 0) return false;
  const double largest = sizes.head(low).maxCoeff();
  const bool vanish = largest < nothing * shift_;
  if (vanish && low < squares_.size()) return false;
  const SparseSolver before = *this;
  shift_ = vanish ? 1e-6 * shift_ : part * largest;
  count_ = low;
  const bool better = grow_until_definite() && shift_ < before.shift_ && solve() &&
                      squares_.size() == low &&
                      !(vanish && squares_.cwiseAbs().maxCoeff() < far * shift_);
  if (!better) {
    *this = before;
    return false;
  }
  const Eigen::Index high = before.squares_.size() - low;
  above_.push_back({before.squares_.tail(high), before.shapes_.rightCols(high)});
  return true;
}

Vibrations SparseSolver::run() {
  Vibrations modes;
  if (count_ == 0 || !find_shift() || !solve()) return modes;
  while (descend()) {
  }
  squares_ = (squares_.array().abs() < nothing * shift_).select(0.0, squares_);
  std::reverse(above_.begin(), above_.end());
  for (const auto& higher : above_) {
    const Eigen::VectorXd squares = squares_;
    const Eigen::MatrixXd shapes = shapes_;
    squares_.resize(squares.size() + higher.squares.size());
    squares_ << squares, higher.squares;
    shapes_.resize(shapes.rows(), squares_.size());
    shapes_ << shapes, higher.shapes;
  }
  modes.squares = squares_;
  modes.shapes = shapes_;
  part_from_lower(modes, [&](const Eigen::VectorXd& x) { return op_->multiply_mass(x); });
  modes.found = modes.shapes.allFinite();
  return modes;
}

}  // namespace

Vibrations sparse_vibrations(VibrationOperator& op, int count) {
  return SparseSolver(op, count).run();
}

}  // namespace flexura

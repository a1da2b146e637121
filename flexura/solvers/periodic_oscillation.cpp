#include "flexura/solvers/periodic_oscillation.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/radau_rule.hpp"

namespace flexura {
namespace {

constexpr double closed = 1e-13;     // residual of the periodic motion
constexpr double known_ritz = 1e-6;  // residual of a multiplier that counts as found
constexpr double no_multiplier = 1e-9;

/// Arnoldi's orthonormal basis of a Krylov space, and what the map does in it.
struct KrylovSpace {
  std::vector<Eigen::VectorXd> basis;
  Eigen::MatrixXd map;  // Hessenberg, one row more than columns

  explicit KrylovSpace(Eigen::Index most) : map(Eigen::MatrixXd::Zero(most + 1, most)) {}

  /// Adds the image of the last vector; its part outside the space.
  double extend(Eigen::VectorXd image) {
    const auto k = static_cast<Eigen::Index>(basis.size()) - 1;
    const double size = image.norm();
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index i = 0; i <= k; ++i) {
        const double along = basis[static_cast<std::size_t>(i)].dot(image);
        map(i, k) += along;
        image -= along * basis[static_cast<std::size_t>(i)];
      }
    const double outside = image.norm();
    if (outside <= 1e-15 * size) return 0.0;
    map(k + 1, k) = outside;
    basis.push_back(image / outside);
    return outside;
  }
};

std::vector<std::complex<double>> ritz_values(const KrylovSpace& space, Eigen::Index k) {
  const Eigen::MatrixXd square = space.map.topLeftCorner(k, k);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(square);
  std::vector<std::complex<double>> values;
  for (Eigen::Index i = 0; i < k; ++i) {
    const double last = std::abs(solver.eigenvectors()(k - 1, i));
    const double residual = space.map(k, k - 1) * last;
    const std::complex<double> value = solver.eigenvalues()[i];
    if (std::abs(value) > no_multiplier && residual <= known_ritz * std::abs(value))
      values.push_back(value);
  }
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return values;
}

}  // namespace

PeriodicOscillation::PeriodicOscillation(std::vector<double> ends, int stages, const Matrices& at) {
  const RadauRule rule = radau_rule(stages);
  nodes_ = rule.nodes;
  once_ = rule.integrals;
  twice_ = once_ * once_;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    Interval interval;
    interval.length = ends[k + 1] - ends[k];
    for (Eigen::Index i = 0; i < nodes_.size(); ++i)
      interval.stages.push_back(at(ends[k] + nodes_[i] * interval.length));
    const Eigen::Index n = interval.stages.front().mass.rows();
    size_ = n;
    const double h = interval.length;
    Eigen::MatrixXd matrix(n * stages, n * stages);
    for (Eigen::Index i = 0; i < stages; ++i) {
      const OscillationMatrices& stage = interval.stages[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < stages; ++j)
        matrix.block(n * i, n * j, n, n) =
            h * once_(i, j) * stage.damping + h * h * twice_(i, j) * stage.stiffness;
      matrix.block(n * i, n * i, n, n) += stage.mass;
      // the mass is not needed any more
      interval.stages[static_cast<std::size_t>(i)].mass.resize(0, 0);
    }
    interval.factor.compute(matrix);
    intervals_.push_back(std::move(interval));
  }
}

Eigen::VectorXd PeriodicOscillation::stage_rates(const Interval& interval, const Eigen::VectorXd& y,
                                                 bool loaded) const {
  const Eigen::Index n = size_;
  Eigen::VectorXd right(n * nodes_.size());
  for (Eigen::Index i = 0; i < nodes_.size(); ++i) {
    const OscillationMatrices& stage = interval.stages[static_cast<std::size_t>(i)];
    auto part = right.segment(n * i, n);
    part.noalias() = -(stage.damping * y.tail(n));
    part.noalias() -= stage.stiffness * (y.head(n) + interval.length * nodes_[i] * y.tail(n));
    if (loaded) part += stage.load;
  }
  return interval.factor.solve(right);
}

/// Radau's last point is the end of the interval.
void PeriodicOscillation::finish(const Interval& interval, const Eigen::VectorXd& rates,
                                 Eigen::VectorXd& y) const {
  const Eigen::Index n = size_, last = nodes_.size() - 1;
  const double h = interval.length;
  y.head(n) += h * y.tail(n);
  for (Eigen::Index j = 0; j <= last; ++j) {
    y.head(n) += h * h * twice_(last, j) * rates.segment(n * j, n);
    y.tail(n) += h * once_(last, j) * rates.segment(n * j, n);
  }
}

Eigen::VectorXd PeriodicOscillation::advance(Eigen::VectorXd y, bool loaded) const {
  for (const Interval& interval : intervals_) finish(interval, stage_rates(interval, y, loaded), y);
  return y;
}

std::vector<OscillationState> PeriodicOscillation::states(const Eigen::VectorXd& start) const {
  const Eigen::Index n = size_;
  Eigen::VectorXd y = start;
  std::vector<OscillationState> states{{y.head(n), y.tail(n), Eigen::VectorXd::Zero(n)}};
  for (const Interval& interval : intervals_) {
    const Eigen::VectorXd rates = stage_rates(interval, y, true);
    finish(interval, rates, y);
    states.push_back({y.head(n), y.tail(n), rates.tail(n)});
  }
  return states;
}

std::vector<Eigen::VectorXd> PeriodicOscillation::stage_displacements(
    const Eigen::VectorXd& start) const {
  const Eigen::Index n = size_;
  Eigen::VectorXd y = start;
  std::vector<Eigen::VectorXd> displacements;
  for (const Interval& interval : intervals_) {
    const Eigen::VectorXd rates = stage_rates(interval, y, true);
    const double h = interval.length;
    for (Eigen::Index i = 0; i < nodes_.size(); ++i) {
      Eigen::VectorXd u = y.head(n) + h * nodes_[i] * y.tail(n);
      for (Eigen::Index j = 0; j < nodes_.size(); ++j)
        u += h * h * twice_(i, j) * rates.segment(n * j, n);
      displacements.push_back(std::move(u));
    }
    finish(interval, rates, y);
  }
  return displacements;
}

PeriodicOscillation::Periodic PeriodicOscillation::solve_periodic() const {
  const Eigen::Index most = 2 * size_;
  Periodic periodic;
  // (1 - map) y = what the loads leave of rest after a turn
  const Eigen::VectorXd right = advance(Eigen::VectorXd::Zero(most), true);
  periodic.turns = 1;
  const double size = right.norm();
  periodic.start = Eigen::VectorXd::Zero(most);
  if (!std::isfinite(size) || size == 0.0) {
    periodic.residual = size;
    return periodic;
  }
  KrylovSpace space(most);
  space.basis.push_back(right / size);
  Eigen::Index k = 0;
  Eigen::VectorXd weights;
  for (bool open = true; open && k < most;) {
    open = space.extend(advance(space.basis.back(), false)) > 0.0;
    ++k;
    ++periodic.turns;
    Eigen::MatrixXd system = -space.map.topLeftCorner(k + 1, k);
    system.diagonal().array() += 1.0;
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(k + 1);
    wanted[0] = size;
    weights = system.colPivHouseholderQr().solve(wanted);
    periodic.residual = (system * weights - wanted).norm() / size;
    open = open && periodic.residual > closed;
  }
  for (Eigen::Index i = 0; i < k; ++i)
    periodic.start += weights[i] * space.basis[static_cast<std::size_t>(i)];
  periodic.multipliers = ritz_values(space, k);
  return periodic;
}

}  // namespace flexura

#include "flexura/studies/free_state.hpp"

#include "flexura/assembly/mechanism_scale.hpp"

namespace flexura {

FreeState::FreeState(MotionSystem& system, const Moment& about, double span)
    : system_(system), free_(system.coordinates() - system.multipliers()), origin_(about.q) {
  Eigen::VectorXd r;
  Eigen::MatrixXd stiffness, mass;
  system_.residual(about, r);
  system_.linearize(about);
  system_.dense(stiffness, mass);
  const Eigen::Index n = system_.coordinates();
  const Eigen::MatrixXd constraints = stiffness.bottomLeftCorner(system_.multipliers(), n);
  const auto lengths = system_.weights().cwiseInverse().asDiagonal();
  factor_.compute(lengths * constraints.transpose());
  measure(lengths * stiffness.topLeftCorner(n, n) * lengths, lengths * mass * lengths, span);
}

/// Where the state is no stable equilibrium of what holds still, or a factor fails for other
/// reasons, plain lengths have to do.
void FreeState::measure(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                        double span) {
  constexpr double small = 1e-6;  // of span^2: unknowns without mass have a rate all the same
  const double energy = scale_of(system_.layout().mechanism).energy;
  const auto free = [&](const Eigen::MatrixXd& whole) -> Eigen::MatrixXd {
    Eigen::MatrixXd turned = factor_.householderQ().transpose() * whole;
    turned = turned * factor_.householderQ();
    return turned.bottomRightCorner(free_, free_) / energy;
  };
  const Eigen::MatrixXd k = free(stiffness), m = free(mass);
  const Eigen::MatrixXd plain = Eigen::MatrixXd::Identity(free_, free_);
  by_energy_.compute(k + m / (span * span));
  by_momentum_.compute(m + small * span * span * k);
  if (by_energy_.info() == Eigen::Success && by_momentum_.info() == Eigen::Success) return;
  by_energy_.compute(plain);
  by_momentum_.compute(span * span * plain);
}

Eigen::VectorXd FreeState::along_constraints(const Eigen::VectorXd& shares) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(system_.coordinates());
  whole.head(shares.size()) = shares;
  whole = factor_.householderQ() * whole;
  return whole.cwiseQuotient(system_.weights());
}

Eigen::VectorXd FreeState::along_free(const Eigen::Ref<const Eigen::VectorXd>& x,
                                      const Factor& by) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(system_.coordinates());
  whole.tail(free_) = by.matrixU().solve(x);
  whole = factor_.householderQ() * whole;
  return whole.cwiseQuotient(system_.weights());
}

Eigen::VectorXd FreeState::free_part(const Eigen::VectorXd& x, const Factor& by) const {
  Eigen::VectorXd whole = x.cwiseProduct(system_.weights());
  whole = factor_.householderQ().transpose() * whole;
  return by.matrixU() * whole.tail(free_);
}

Eigen::VectorXd FreeState::reduce(const Moment& moment) const {
  Eigen::VectorXd x(size());
  x << free_part(moment.q - origin_, by_energy_), free_part(moment.v, by_momentum_);
  return x;
}

Eigen::MatrixXd FreeState::slopes(const Moment& moment, Eigen::MatrixXd& constraints) const {
  Eigen::MatrixXd stiffness, mass;
  system_.linearize(moment);
  system_.dense(stiffness, mass);
  const Eigen::Index m = system_.multipliers();
  constraints = stiffness.bottomLeftCorner(m, system_.coordinates());
  Eigen::MatrixXd turned = system_.weights().cwiseInverse().asDiagonal() * constraints.transpose();
  turned = factor_.householderQ().transpose() * turned;
  return turned.topRows(m).transpose();
}

/// Newton's method along R.
bool FreeState::close(Moment& moment) const {
  constexpr int most_iterations = 20;
  constexpr double closed = 1e-13, rounding = 1e-9;  // in mean flexure lengths
  Eigen::VectorXd r;
  Eigen::MatrixXd constraints;
  double before = INFINITY;
  for (int k = 0; k < most_iterations; ++k) {
    system_.residual(moment, r);
    const double gap = system_.relative_gap(r);
    if (!std::isfinite(gap) || gap > 10.0) return false;
    if (gap < closed || (gap < rounding && gap > 0.3 * before)) return true;
    before = gap;
    const Eigen::MatrixXd along = slopes(moment, constraints);
    const Eigen::VectorXd shares = along.partialPivLu().solve(-r.tail(system_.multipliers()));
    moment.q += along_constraints(shares);
  }
  return false;
}

bool FreeState::restore(const Eigen::VectorXd& x, Moment& moment) const {
  moment.q = origin_ + along_free(x.head(free_), by_energy_);
  moment.v = along_free(x.tail(free_), by_momentum_);
  if (system_.multipliers() == 0) return true;
  if (!close(moment)) return false;
  Eigen::MatrixXd constraints;
  const Eigen::MatrixXd along = slopes(moment, constraints);
  moment.v += along_constraints(along.partialPivLu().solve(-system_.constraint_rates(moment)));
  return moment.v.allFinite();
}

}  // namespace flexura

#pragma once

#include <cmath>
#include <vector>

#include "flexura/solvers/motion_problem.hpp"

namespace flexura {

/// A midpoint rule for the velocities of mass points with discrete derivatives of all forces:
/// energy and momenta of a mechanism left alone stay as they are, to what Newton's iteration
/// leaves. Order 2. `Discrete` has place(q, places), velocities(state, velocities),
/// residual(from, to, change, r), with the problem of the other integrators as its system().
template <class Discrete, class State, template <class> class Factor, class Vector>
class EnergyMomentum {
 public:
  struct Options {
    double newton_tolerance = 1e-11;
  };

  EnergyMomentum(Discrete& discrete, Options options) : discrete_(discrete), options_(options) {}

  static constexpr int order = 2;
  static constexpr double error_order = 3.0;
  /// Loads may jump, as a step knows nothing of the last one's forces; rates may not.
  void restart(bool rates_jump) {
    if (rates_jump) velocities_.clear();
  }
  StepReport step(State& state, double h);

  const std::vector<Vector>& places() const { return places_; }
  const std::vector<Vector>& velocities() const { return velocities_; }

 private:
  Discrete& discrete_;
  Options options_;
  std::vector<Vector> places_, velocities_;
  Factor<double> factor_;
};

template <class Discrete, class State, template <class> class Factor, class Vector>
StepReport EnergyMomentum<Discrete, State, Factor, Vector>::step(State& state, double h) {
  constexpr int most_iterations = 40;
  StepReport report;
  auto& system = discrete_.system();
  const Eigen::Index n = system.coordinates();
  if (velocities_.empty()) {
    if (!project_rates(system, state, h, factor_)) return report;
    start_acceleration(system, state, h, factor_);
    discrete_.velocities(state, velocities_);
    discrete_.place(state.q, places_);
  }
  State next = state;
  next.time += h;
  next.q += h * state.v + 0.5 * h * h * state.a;
  State middle = state;
  middle.time += 0.5 * h;
  std::vector<Vector> places, change(velocities_.size());
  Eigen::VectorXd r, unused;
  double before = INFINITY;
  for (report.iterations = 1; report.iterations <= most_iterations; ++report.iterations) {
    discrete_.place(next.q, places);
    for (std::size_t g = 0; g < change.size(); ++g)
      change[g] = (2.0 / h) * (places[g] - places_[g]) - 2.0 * velocities_[g];
    discrete_.residual(state, next, change, r);
    middle.q = 0.5 * (state.q + next.q);
    middle.v = (next.q - state.q) / h;
    middle.a = (2.0 / h) * (middle.v - state.v);
    middle.multipliers = next.multipliers;
    system.residual(middle, unused);
    system.linearize(middle);
    if (!r.allFinite() || !system.factorize(4.0 / (h * h), 2.0 / h, factor_)) return report;
    r.head(n) *= -2.0;
    r.tail(r.size() - n) *= -1.0;
    system.solve(factor_, r);
    const double size = system.size_of(r.head(n));
    if (!std::isfinite(size) || (report.iterations > 8 && size > 2.0 * before)) return report;
    next.q += r.head(n);
    next.multipliers += 0.5 * r.tail(r.size() - n);
    const double rate = size / before;
    // to the last digit, as the balance of energy is no better than the iteration leaves it
    if (size < options_.newton_tolerance &&
        (rate > 0.3 || size < 1e-4 * options_.newton_tolerance)) {
      discrete_.place(next.q, places);
      for (std::size_t g = 0; g < change.size(); ++g)
        velocities_[g] = (2.0 / h) * (places[g] - places_[g]) + (-1.0) * velocities_[g];
      places_ = std::move(places);
      next.v = 2.0 * (next.q - state.q) / h - state.v;
      next.a = (next.v - state.v) / h;
      state = std::move(next);
      report.outcome = StepOutcome::accepted;
      return report;
    }
    before = size;
  }
  return report;
}

}  // namespace flexura

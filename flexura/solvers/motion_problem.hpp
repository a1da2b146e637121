#pragma once

#include <Eigen/Dense>
#include <complex>
#include <concepts>

namespace flexura {

/// Equations of motion for the time integrators: coordinates q with rates v and a, multipliers;
/// residual (coordinates first, then the constraints), and solutions with
/// K + mass factor * M + damping factor * C, constraints included. `State` has members time, q, v,
/// a, multipliers; `Factor<T>` is for T double or complex.
template <class P, class State, template <class> class Factor>
concept MotionProblem = requires(P p, const P& c, const State& state, Eigen::VectorXd& r,
                                 const Eigen::VectorXd& x, Factor<double>& f, Eigen::VectorXcd& z,
                                 Factor<std::complex<double>>& g) {
  { c.coordinates() } -> std::convertible_to<Eigen::Index>;
  { c.multipliers() } -> std::convertible_to<Eigen::Index>;
  p.residual(state, r);
  p.linearize(state);
  { c.factorize(1.0, 1.0, f) } -> std::same_as<bool>;
  { c.factorize(std::complex<double>(), std::complex<double>(), g) } -> std::same_as<bool>;
  c.solve(f, r);
  c.solve(g, z);
  { c.multiply_mass(x) } -> std::convertible_to<Eigen::VectorXd>;
  { c.constraint_rates(state) } -> std::convertible_to<Eigen::VectorXd>;
  { c.size_of(x) } -> std::convertible_to<double>;
};

/// What a time step came to.
enum class StepOutcome { accepted, inaccurate, diverged };

struct StepReport {
  StepOutcome outcome = StepOutcome::diverged;
  int iterations = 0;  ///< of Newton's method
  double error =
      0.0;  ///< estimated, of the step, by the problem's size; 0 where there is no estimate
};

/// Brings v onto the constraints' rates, changing it as little as mass and stiffness over a time
/// `span` let it. The system is linearized and factorized there. False where that is singular.
template <class System, class State, class Factor>
bool project_rates(System& system, State& state, double span, Factor& factor) {
  Eigen::VectorXd r;
  system.residual(state, r);
  system.linearize(state);
  if (!system.factorize(1.0 / (span * span), 0.0, factor)) return false;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(system.coordinates() + system.multipliers());
  b.tail(system.multipliers()) = -system.constraint_rates(state);
  system.solve(factor, b);
  state.v += b.head(system.coordinates());
  return state.v.allFinite();
}

/// Accelerations and multipliers that go with q and v, smoothed over `span`: what is stiffer is
/// taken as if at rest. The factor is that of project_rates at the same span.
template <class System, class State, class Factor>
void start_acceleration(System& system, State& state, double span, const Factor& factor) {
  const Eigen::Index n = system.coordinates();
  Eigen::VectorXd r, ahead;
  State still = state;
  still.a.setZero();
  system.residual(still, r);
  State moved = still;
  moved.q += span * moved.v;
  moved.time += span;
  system.residual(moved, ahead);
  Eigen::VectorXd b(r.size());
  b.head(n) = -r.head(n);
  b.tail(r.size() - n) = -2.0 * ahead.tail(r.size() - n);
  system.solve(factor, b);
  state.a = b.head(n) / (span * span);
  state.multipliers += b.tail(r.size() - n);
}

}  // namespace flexura

#pragma once

#include <cmath>

#include "flexura/solvers/motion_problem.hpp"

namespace flexura {

/// Generalized-alpha for constrained mechanical systems (Arnold, Bruels, Multibody Syst. Dyn. 18,
/// 2007): order 2 in coordinates and multipliers, dissipation of high frequencies by the spectral
/// radius at infinity, in [0, 1]. One step solves
///     (1 - am) a' + am a = (1 - af) w' + af w,
///     q' = q + h v + h^2 ((1/2 - beta) a + beta a'),  v' = v + h ((1 - gamma) a + gamma a')
/// with the equations of motion at (q', v', w') for the accelerations w'.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
class GeneralizedAlpha {
 public:
  struct Options {
    double spectral_radius = 0.8;
    double newton_tolerance = 1e-10;
    double tolerance = 0.0;  ///< of a step's error; 0: steps are what they are
  };

  GeneralizedAlpha(System& system, Options options) : system_(system), options_(options) {
    const double rho = options.spectral_radius;
    mass_share_ = (2.0 * rho - 1.0) / (rho + 1.0);
    force_share_ = rho / (rho + 1.0);
    gamma_ = 0.5 + force_share_ - mass_share_;
    beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
  }

  static constexpr int order = 2;
  static constexpr double error_order = 3.0;  ///< of the estimate, in the step
  /// Forgets the step before: where loads or rates jump.
  void restart(bool /*rates_jump*/) { auxiliary_.resize(0); }

  /// From `state` to a time h later; unchanged unless accepted.
  StepReport step(State& state, double h);

 private:
  double estimate(const Eigen::VectorXd& auxiliary, double h);

  System& system_;
  Options options_;
  double mass_share_ = 0.0;   // alpha_m
  double force_share_ = 0.0;  // alpha_f
  double gamma_ = 0.5;
  double beta_ = 0.25;
  Eigen::VectorXd auxiliary_;  // a
  Factor<double> factor_;
};

template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor> StepReport
GeneralizedAlpha<System, State, Factor>::step(State& state, double h) {
  constexpr int most_iterations = 25;
  StepReport report;
  const Eigen::Index n = system_.coordinates();
  if (auxiliary_.size() == 0) {
    if (!project_rates(system_, state, h, factor_)) return report;
    start_acceleration(system_, state, h, factor_);
    auxiliary_ = state.a;
  }
  const double mass = (1.0 - mass_share_) / (h * h * beta_ * (1.0 - force_share_));
  const double damping = gamma_ / (h * beta_);
  State next = state;
  next.time += h;
  Eigen::VectorXd auxiliary(n), r;
  const auto update = [&] {
    auxiliary =
        ((1.0 - force_share_) * next.a + force_share_ * state.a - mass_share_ * auxiliary_) /
        (1.0 - mass_share_);
    next.q = state.q + h * state.v + h * h * ((0.5 - beta_) * auxiliary_ + beta_ * auxiliary);
    next.v = state.v + h * ((1.0 - gamma_) * auxiliary_ + gamma_ * auxiliary);
  };
  update();
  double before = INFINITY;
  for (report.iterations = 1; report.iterations <= most_iterations; ++report.iterations) {
    system_.residual(next, r);
    system_.linearize(next);
    if (!r.allFinite() || !system_.factorize(mass, damping, factor_)) return report;
    r = -r;
    system_.solve(factor_, r);
    const double size = system_.size_of(r.head(n));
    if (!std::isfinite(size) || (report.iterations > 6 && size > 2.0 * before)) return report;
    next.a += mass * r.head(n);
    next.multipliers += r.tail(r.size() - n);
    update();
    const double rate = size / before;
    // at a linear rate what is left is about size rate/(1 - rate)
    if (size < options_.newton_tolerance ||
        (report.iterations > 1 && rate < 0.5 && size * rate < 0.5 * options_.newton_tolerance)) {
      report.error = options_.tolerance > 0.0 ? estimate(auxiliary, h) : 0.0;
      if (report.error > options_.tolerance && options_.tolerance > 0.0) {
        report.outcome = StepOutcome::inaccurate;
        return report;
      }
      report.outcome = StepOutcome::accepted;
      state = std::move(next);
      auxiliary_ = std::move(auxiliary);
      return report;
    }
    before = size;
  }
  return report;
}

/// Of the displacements: what the change of acceleration leaves out, filtered as the step is.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
double GeneralizedAlpha<System, State, Factor>::estimate(const Eigen::VectorXd& auxiliary,
                                                         double h) {
  const Eigen::Index n = system_.coordinates();
  const double mass = (1.0 - mass_share_) / (h * h * beta_ * (1.0 - force_share_));
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + system_.multipliers());
  b.head(n) = mass * system_.multiply_mass((beta_ - 1.0 / 6.0) * h * h * (auxiliary - auxiliary_));
  system_.solve(factor_, b);
  return system_.size_of(b.head(n));
}

}  // namespace flexura

#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>

#include "flexura/solvers/motion_problem.hpp"

namespace flexura {

/// The three-stage Radau IIA method (Hairer, Wanner, Solving Ordinary Differential Equations II,
/// sect. IV.8): collocation at c = (4 - sqrt 6)/10, (4 + sqrt 6)/10, 1.
struct RadauTableau {
  RadauTableau();
  /// Of the stages in the polynomial through them and 0 at a place x of the step.
  Eigen::Vector3d shares(double x) const;

  Eigen::Vector3d nodes;
  Eigen::Matrix3d inverse;  ///< of the matrix A
  Eigen::Vector3d weights;
  Eigen::Vector3d error;  ///< e_i of the embedded method of order 3, times gamma_0
  double real = 0.0;      ///< eigenvalues of the inverse
  std::complex<double> complex;
  Eigen::Matrix3cd to_eigen;  ///< into its eigenvectors: real one, complex one, its conjugate
  Eigen::Matrix3cd from_eigen;
};

/// Radau IIA of three stages for q'' with constraints on q: order 5, L-stable, stiffly accurate.
/// Stage rates follow from stage coordinates, so the unknowns of a step are coordinates and
/// multipliers alone; the iteration splits into one real and one complex system. Rates at the end
/// of a step are of order 3 across the constraints, which the steps after it do not feel (Hairer,
/// Lubich, Roche, The Numerical Solution of Differential-Algebraic Systems by Runge-Kutta Methods,
/// sect. 6): they are handed on as they are. Brought onto the constraints by any matrices but those
/// at the end of the step, they would take the order of all coordinates down to 3.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
class Radau {
 public:
  struct Options {
    double newton_tolerance = 1e-10;
    double tolerance = 0.0;  ///< of a step's error; 0: steps are what they are
  };

  Radau(System& system, Options options) : system_(system), options_(options) {}

  static constexpr int order = 5;
  static constexpr double error_order = 4.0;  ///< of the estimate, in the step
  void restart(bool /*rates_jump*/) { last_step_ = 0.0; }
  StepReport step(State& state, double h);
  /// Of the last accepted step: states at its stages, for quadrature with the tableau's weights.
  const std::array<State, 3>& stages() const { return stages_; }
  const RadauTableau& tableau() const { return tableau_; }

 private:
  void predict(const State& state, double h);
  bool refresh(const State& state, double h);
  void set_rates(const State& state, double h);
  double iterate(const State& state, double h);
  void solve_stages(const State& state, double h, StepReport& report);
  double estimate(const State& state, double h);
  double gap_between(const State& state, double h);

  System& system_;
  Options options_;
  RadauTableau tableau_;
  std::array<State, 3> stages_;
  Eigen::MatrixXd moved_;  // stage coordinates less those at the start
  Eigen::MatrixXd last_moved_;
  double last_step_ = 0.0;
  double factored_step_ = 0.0;
  bool fresh_ = false;
  double contraction_ = 0.0;   // of the iteration, the slowest since the matrices were made
  double force_change_ = 0.0;  // of the multipliers by the last iteration, relative
  Factor<double> real_;
  Factor<std::complex<double>> complex_;
};

inline RadauTableau::RadauTableau() {
  const double root = std::sqrt(6.0);
  nodes << (4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0;
  // integrals of the polynomials through the nodes: sum_j A_ij c_j^k = c_i^(k+1)/(k+1)
  Eigen::Matrix3d powers, integrals;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      powers(k, i) = std::pow(nodes[i], k);
      integrals(i, k) = std::pow(nodes[i], k + 1) / (k + 1);
    }
  const Eigen::Matrix3d a = integrals * powers.transpose().inverse();
  inverse = a.inverse();
  weights = a.row(2).transpose();
  const Eigen::EigenSolver<Eigen::Matrix3d> eigen(inverse);
  int order[3] = {0, 1, 2};
  for (int i = 0; i < 3; ++i) {
    const auto value = eigen.eigenvalues()[i];
    if (std::abs(value.imag()) < 1e-9) order[0] = i;
    if (value.imag() > 1e-9) order[1] = i;
    if (value.imag() < -1e-9) order[2] = i;
  }
  for (int i = 0; i < 3; ++i) from_eigen.col(i) = eigen.eigenvectors().col(order[i]);
  to_eigen = from_eigen.inverse();
  real = eigen.eigenvalues()[order[0]].real();
  complex = eigen.eigenvalues()[order[1]];
  error << -13.0 - 7.0 * root, -13.0 + 7.0 * root, -1.0;
  error /= 3.0 * real;
}

inline Eigen::Vector3d RadauTableau::shares(double x) const {
  Eigen::Vector3d all;
  for (int j = 0; j < 3; ++j) {
    all[j] = x / nodes[j];
    for (int k = 0; k < 3; ++k)
      if (k != j) all[j] *= (x - nodes[k]) / (nodes[j] - nodes[k]);
  }
  return all;
}

/// Stages at the polynomial of the last step, or along the rates.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
void Radau<System, State, Factor>::predict(const State& state, double h) {
  moved_.resize(system_.coordinates(), 3);
  for (auto& stage : stages_) stage = state;
  if (last_step_ == 0.0) {
    for (int i = 0; i < 3; ++i) moved_.col(i) = h * tableau_.nodes[i] * state.v;
    return;
  }
  const double ratio = h / last_step_;
  for (int i = 0; i < 3; ++i)
    moved_.col(i) =
        last_moved_ * tableau_.shares(1.0 + tableau_.nodes[i] * ratio) - last_moved_.col(2);
}

template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
bool Radau<System, State, Factor>::refresh(const State& state, double h) {
  Eigen::VectorXd r;
  system_.residual(state, r);
  system_.linearize(state);
  factored_step_ = h;
  fresh_ = true;
  contraction_ = 0.0;
  return system_.factorize(std::pow(tableau_.real / h, 2), tableau_.real / h, real_) &&
         system_.factorize(tableau_.complex * tableau_.complex / (h * h), tableau_.complex / h,
                           complex_);
}

template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
void Radau<System, State, Factor>::set_rates(const State& state, double h) {
  const Eigen::MatrixXd rates = moved_ * tableau_.inverse.transpose() / h;
  const Eigen::MatrixXd seconds = (rates.colwise() - state.v) * tableau_.inverse.transpose() / h;
  for (int i = 0; i < 3; ++i) {
    State& stage = stages_[static_cast<std::size_t>(i)];
    stage.time = state.time + tableau_.nodes[i] * h;
    stage.q = state.q + moved_.col(i);
    stage.v = rates.col(i);
    stage.a = seconds.col(i);
  }
}

/// One step of the simplified Newton iteration; its size.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
double Radau<System, State, Factor>::iterate(const State& state, double h) {
  const Eigen::Index n = system_.coordinates();
  const Eigen::Index m = system_.multipliers();
  Eigen::MatrixXd residuals(n + m, 3);
  Eigen::VectorXd r;
  set_rates(state, h);
  for (int i = 0; i < 3; ++i) {
    system_.residual(stages_[static_cast<std::size_t>(i)], r);
    residuals.col(i) = -r;
  }
  if (!residuals.allFinite()) return INFINITY;
  const Eigen::MatrixXcd turned = residuals * tableau_.to_eigen.transpose();
  Eigen::VectorXd own = turned.col(0).real();
  Eigen::VectorXcd pair = turned.col(1);
  system_.solve(real_, own);
  system_.solve(complex_, pair);
  Eigen::MatrixXcd solved(n + m, 3);
  solved << own, pair, pair.conjugate();
  const Eigen::MatrixXd change = (solved * tableau_.from_eigen.transpose()).real();
  moved_ += change.topRows(n);
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    stages_[static_cast<std::size_t>(i)].multipliers += change.col(i).tail(m);
    size = std::max(size, system_.size_of(change.col(i).head(n)));
  }
  const double forces = m > 0 ? stages_[2].multipliers.template lpNorm<Eigen::Infinity>() : 0.0;
  force_change_ = forces > 0.0 ? change.col(2).tail(m).lpNorm<Eigen::Infinity>() / forces : 0.0;
  return size;
}

/// Hairer and Wanner's (8.19), of the coordinates: with the real system, gamma = 1/gamma_0,
///     (gamma^2/h^2 M + K) err = M (a + gamma/h (e.v) + gamma/h (v + gamma/h (e.q))).
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
double Radau<System, State, Factor>::estimate(const State& state, double h) {
  const Eigen::Index n = system_.coordinates();
  const double g = tableau_.real / h;
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < 3; ++i)
    rates += tableau_.error[i] * (stages_[static_cast<std::size_t>(i)].v - state.v);
  const Eigen::VectorXd by_q = state.v + g * (moved_ * tableau_.error);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + system_.multipliers());
  b.head(n) = system_.multiply_mass(state.a + g * rates + g * by_q);
  system_.solve(real_, b);
  return system_.size_of(b.head(n));
}

/// How far the constraints are from closed between the stages, where the polynomial strays most:
/// the estimate is blind to what the constraints alone decide, as the way of a body that is driven.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
double Radau<System, State, Factor>::gap_between(const State& state, double h) {
  if constexpr (requires(Eigen::VectorXd r) { system_.relative_gap(r); }) {
    constexpr double place = 0.85;
    State between = stages_[2];
    between.time = state.time + place * h;
    between.q = state.q + moved_ * tableau_.shares(place);
    Eigen::VectorXd r;
    system_.residual(between, r);
    return system_.relative_gap(r);
  }
  return 0.0;
}

/// The simplified Newton iteration with the matrices at hand. Its error is judged by its slowest
/// contraction, as matrices of an earlier step may reduce what constraints decide fast, the rest
/// not.
template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor>
void Radau<System, State, Factor>::solve_stages(const State& state, double h, StepReport& report) {
  constexpr int most_iterations = 12;
  const double force_tolerance = 1e4 * options_.newton_tolerance;  // relative
  double before = 0.0, two_before = 0.0;
  for (int k = 1; k <= most_iterations; ++k) {
    const double size = iterate(state, h);
    ++report.iterations;
    if (!std::isfinite(size)) break;
    const double rate = k > 1 ? size / before : 0.5;
    const bool accepted = report.outcome == StepOutcome::accepted;
    if (k > 1 && !accepted) contraction_ = std::max(contraction_, rate);
    // it may contract by turns only, in every second iteration
    if (k > 2 && rate > 0.9 && size > 0.5 * two_before) break;
    if (size < options_.newton_tolerance ||
        (k > 1 && contraction_ < 1.0 &&
         size * contraction_ / (1.0 - contraction_) < options_.newton_tolerance)) {
      report.outcome = StepOutcome::accepted;
      // forces may lag behind where constraints alone decide the coordinates
      if (force_change_ < force_tolerance || rate > 0.5) break;
    }
    two_before = before;
    before = size;
  }
}

template <class System, class State, template <class> class Factor>
requires MotionProblem<System, State, Factor> StepReport
Radau<System, State, Factor>::step(State& state, double h) {
  StepReport report;
  if (last_step_ == 0.0) {
    Factor<double> factor;
    if (!project_rates(system_, state, h, factor)) return report;
    start_acceleration(system_, state, h, factor);
    factored_step_ = 0.0;
  }
  const bool same = std::abs(h - factored_step_) < 1e-9 * h;
  fresh_ = false;
  if ((!same || contraction_ > 0.05) && !refresh(state, h)) return report;
  predict(state, h);
  for (int attempt = 0; attempt < 2; ++attempt) {
    solve_stages(state, h, report);
    if (report.outcome == StepOutcome::accepted || fresh_) break;
    // once more about where the step leads, with matrices of its own
    if (!refresh(state, h)) return report;
    predict(state, h);
  }
  if (report.outcome != StepOutcome::accepted) return report;
  set_rates(state, h);
  if (options_.tolerance > 0.0) {
    report.error = std::max(estimate(state, h), gap_between(state, h));
    if (!(report.error <= options_.tolerance)) {
      report.outcome = StepOutcome::inaccurate;
      return report;
    }
  }
  state = stages_[2];
  last_moved_ = moved_;
  last_step_ = h;
  return report;
}

}  // namespace flexura

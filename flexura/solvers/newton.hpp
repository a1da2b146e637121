#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <vector>

namespace flexura {

/// Equations in unknowns z that can be linearized and know the size of a change of z.
template <class P>
concept NewtonProblem = requires(P problem, const std::vector<double>& z,
                                 std::vector<double>& step) {
  { problem.linearize(z) } -> std::same_as<bool>;
  { problem.newton_step(step) } -> std::convertible_to<double>;
};

struct NewtonOptions {
  double tolerance = 1e-11;  ///< of the size of what is left to correct
  int max_iterations = 30;
  int max_halvings = 6;
};

enum class NewtonOutcome { converged, singular, diverged };

struct NewtonSummary {
  NewtonOutcome outcome = NewtonOutcome::diverged;
  int iterations = 0;       ///< linearizations
  double first_step = 0.0;  ///< size of the first step: how far the start was off
  double last_step = 0.0;
  int unstable_at_start = 0;  ///< directions, where the problem knows them
};

inline void add_scaled(std::vector<double>& z, double factor, const std::vector<double>& step) {
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += factor * step[i];
}

/// Newton's method with a line search on the size of the Newton step itself, which does not depend
/// on the units of the equations. It keeps what it learns of its own quadratic rate, size_{k+1} =
/// curvature size_k^2, from solve to solve, and so need not evaluate once more to see that it is
/// done.
class Newton {
 public:
  explicit Newton(NewtonOptions options = {}) : options_(options) {}

  void set_tolerance(double tolerance) { options_.tolerance = tolerance; }
  /// Solves from z, which holds the solution if converged and is unchanged if not.
  template <NewtonProblem Problem>
  NewtonSummary solve(Problem& problem, std::vector<double>& z);

 private:
  template <NewtonProblem Problem>
  bool advance(Problem& problem, NewtonSummary& summary);
  bool is_done(double size, double contraction) const;

  /// Steps below this that do not shrink any more are rounding, amplified by a stiff and slender,
  /// or nearly singular, mechanism.
  static constexpr double rounding_floor = 1e-7;

  NewtonOptions options_;
  double curvature_ = 0.0;  // 0: not known yet
  double size_ = 0.0;
  std::vector<double> z_, trial_, step_, next_step_;
};

template <NewtonProblem Problem>
NewtonSummary Newton::solve(Problem& problem, std::vector<double>& z) {
  NewtonSummary summary;
  z_ = z;
  summary.iterations = 1;
  if (!problem.linearize(z_)) {
    summary.outcome = NewtonOutcome::singular;
    return summary;
  }
  if constexpr (requires { problem.unstable_directions(); })
    summary.unstable_at_start = problem.unstable_directions();
  size_ = problem.newton_step(step_);
  summary.first_step = size_;
  double contraction = 1.0;
  while (!is_done(size_, contraction)) {
    const double before = size_;
    if (summary.iterations >= options_.max_iterations || !std::isfinite(size_)) return summary;
    if (!advance(problem, summary)) {
      if (size_ > rounding_floor) return summary;
      break;
    }
    contraction = size_ / before;
    // above rounding only, and below the region where the rate is not quadratic yet
    if (size_ > 1e-12 && before < 0.1)
      curvature_ = std::max(0.5 * curvature_, size_ / (before * before));
  }
  add_scaled(z_, 1.0, step_);
  std::swap(z, z_);
  summary.last_step = size_;
  summary.outcome = NewtonOutcome::converged;
  return summary;
}

inline bool Newton::is_done(double size, double contraction) const {
  if (size <= options_.tolerance) return true;
  if (curvature_ > 0.0 && size < 1e-3 && 4.0 * curvature_ * size * size <= options_.tolerance)
    return true;
  return size < rounding_floor && contraction > 0.3;
}

/// One step, halved until the next one is not larger; from a shortened step, twice as large is not
/// running away yet.
template <NewtonProblem Problem>
bool Newton::advance(Problem& problem, NewtonSummary& summary) {
  double factor = 1.0;
  for (int halving = 0; halving <= options_.max_halvings; ++halving, factor *= 0.5) {
    trial_ = z_;
    add_scaled(trial_, factor, step_);
    ++summary.iterations;
    if (!problem.linearize(trial_)) continue;
    const double next = problem.newton_step(next_step_);
    if (!(next <= size_ * (halving == 0 ? 1.0 : 2.0))) continue;
    std::swap(z_, trial_);
    std::swap(step_, next_step_);
    size_ = next;
    return true;
  }
  return false;
}

}  // namespace flexura

#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "flexura/solvers/motion_problem.hpp"

namespace flexura {

/// What a march through time has taken so far.
struct MarchCounts {
  int steps = 0;
  int rejected = 0;
  int iterations = 0;
  double smallest_step = INFINITY;
  double largest_step = 0.0;
};

/// Steps of an integrator from one time to the next: equal ones, or such that the estimated error
/// of each stays below a tolerance. `Integrator` has step(state, h), restart() and the `order` of
/// its coordinates.
template <class Integrator>
class TimeMarch {
 public:
  struct Options {
    double step = 0.0;       ///< fixed; 0: by tolerance
    double tolerance = 0.0;  ///< that of the integrator
    double first_step = 0.0;
    double shortest = 0.0;  ///< no step is shorter: the march ends there
  };

  TimeMarch(Integrator& integrator, Options options)
      : integrator_(integrator), options_(options), next_(options.first_step) {}

  /// To `until`; calls `after` with the step's length after each. False where no step is possible
  /// (`state` is then the last one reached) or `after` says so.
  template <class State>
  bool advance(State& state, double until, const std::function<bool(double)>& after);

  /// Where loads jump, or what is imposed and with it rates: what those change is not carried over.
  void restart(bool rates_jump) {
    integrator_.restart(rates_jump);
    if (options_.step == 0.0) next_ = std::min(next_, options_.first_step);
  }
  const MarchCounts& counts() const { return counts_; }
  bool was_stopped() const { return stopped_; }

 private:
  template <class State>
  StepReport take(State& state, double h, const std::function<bool(double)>& after);
  template <class State>
  bool advance_equally(State& state, double until, const std::function<bool(double)>& after);
  /// One fixed step.
  template <class State>
  bool advance_in_parts(State& state, double goal, const std::function<bool(double)>& after);

  Integrator& integrator_;
  Options options_;
  double next_;
  MarchCounts counts_;
  bool stopped_ = false;
};

template <class Integrator>
template <class State>
StepReport TimeMarch<Integrator>::take(State& state, double h,
                                       const std::function<bool(double)>& after) {
  const StepReport report = integrator_.step(state, h);
  counts_.iterations += report.iterations;
  if (report.outcome != StepOutcome::accepted) {
    ++counts_.rejected;
    return report;
  }
  ++counts_.steps;
  counts_.smallest_step = std::min(counts_.smallest_step, h);
  counts_.largest_step = std::max(counts_.largest_step, h);
  stopped_ = after && !after(h);
  return report;
}

/// Where Newton's method fails in a step, the step is taken in halves, and those again where need
/// be. The next part is as long as the last one or, once that completes a pair, the pair: parts
/// stay halves of halves, and what follows a hard place is not as short as the place itself.
template <class Integrator>
template <class State>
bool TimeMarch<Integrator>::advance_equally(State& state, double until,
                                            const std::function<bool(double)>& after) {
  const double start = state.time;
  const double span = until - start;
  const auto count = std::max(1LL, std::llround(std::ceil(span / options_.step - 1e-6)));
  for (auto k = 1LL; k <= count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count);
    const double goal = k == count ? until : start + span * share;
    if (!advance_in_parts(state, goal, after)) return false;
  }
  return true;
}

template <class Integrator>
template <class State>
bool TimeMarch<Integrator>::advance_in_parts(State& state, double goal,
                                             const std::function<bool(double)>& after) {
  const double start = state.time;
  const double whole = goal - start;
  double parts = 1.0;  // that the step is cut into at present
  double done = 0.0;   // of them
  while (done < parts) {
    if (take(state, whole / parts, after).outcome != StepOutcome::accepted) {
      parts *= 2.0;
      done *= 2.0;
      if (whole / parts < options_.shortest) return false;
      continue;
    }
    done += 1.0;
    state.time = done == parts ? goal : start + whole * (done / parts);
    if (stopped_) return false;
    if (parts > 1.0 && std::fmod(done, 2.0) == 0.0) {
      parts *= 0.5;
      done *= 0.5;
    }
  }
  return true;
}

template <class Integrator>
template <class State>
bool TimeMarch<Integrator>::advance(State& state, double until,
                                    const std::function<bool(double)>& after) {
  if (options_.step > 0.0) return advance_equally(state, until, after);
  while (state.time < until) {
    const double left = until - state.time;
    // equal steps to the goal rather than long ones and a very short one
    const double h = left / std::max(1.0, std::ceil(left / next_ - 1e-3));
    const StepReport report = take(state, h, after);
    const double growth = 0.9 * std::pow(options_.tolerance / std::max(report.error, 1e-300),
                                         1.0 / Integrator::error_order);
    if (report.outcome == StepOutcome::accepted) {
      if (h == left) state.time = until;
      // a little more is not worth new matrices
      next_ = h * (growth > 1.0 && growth < 1.2 ? 1.0 : std::clamp(growth, 0.3, 4.0));
      if (stopped_) return false;
      continue;
    }
    next_ = h * (report.outcome == StepOutcome::inaccurate ? std::clamp(growth, 0.1, 0.8) : 0.3);
    if (next_ < options_.shortest) return false;
  }
  return true;
}

}  // namespace flexura

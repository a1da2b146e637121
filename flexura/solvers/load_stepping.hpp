#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <deque>
#include <numbers>
#include <optional>
#include <vector>

#include "flexura/solvers/continuation.hpp"
#include "flexura/solvers/hermite_predictor.hpp"
#include "flexura/solvers/newton.hpp"
#include "flexura/solvers/step_checks.hpp"

namespace flexura {

enum class SteppingOutcome { reached, limit_point, wound_up, lost };

/// A change of the number of unstable directions, located on the path.
struct StabilityChange {
  double load_factor = 0.0;
  int before = 0;
  int after = 0;
  std::vector<double> z;
};

struct SteppingSummary {
  SteppingOutcome outcome = SteppingOutcome::reached;
  double load_factor = 0.0;         ///< of the last converged state, or of the limit point
  std::vector<double> limit_state;  ///< where the outcome is limit_point
};

struct SteppingOptions {
  double tolerance = 1e-11;
  double smallest_step = 1e-4;  ///< of the load factor, before the path is followed by arc length
};

/// Turns of a flexure's end sections against each other from which on a path that does not get on
/// is taken to wind up.
inline constexpr double wound_up_turn = 6.0 * std::numbers::pi;

/// Follows the equilibria z(load factor) from the unloaded state: predicts from the last states,
/// corrects by Newton, and accepts a step only if the new state is where the path leads: the
/// prediction was near, the step heads where the path does, the stability is the same (or its
/// change is located), and the loads' work is the gain of energy. Otherwise the step is halved. A
/// small residual alone does not prove that.
template <LoadedProblem Problem>
class LoadStepping {
 public:
  LoadStepping(Problem& problem, SteppingOptions options)
      : problem_(&problem), options_(options), newton_({options.tolerance, 30, 6}) {}

  /// The start of the path. False where the unloaded mechanism is singular.
  bool start(const std::vector<double>& z);
  /// On to a larger load factor.
  SteppingSummary advance(double load_factor);

  const std::vector<double>& state() const { return state_; }
  int unstable_directions() const { return unstable_; }
  const std::vector<StabilityChange>& changes() const { return changes_; }
  int steps() const { return steps_; }
  int iterations() const { return iterations_; }

  /// Solves again at the last load factor, for a problem that has changed since.
  bool correct();
  /// Goes on with another problem whose unknowns `prolong` makes from this one's.
  template <class Prolong>
  void change_problem(Problem& problem, const Prolong& prolong);

 private:
  bool try_step(double to, double meet = states_meet);
  bool step_over(double target);
  bool cross_over(double target);
  bool is_wound_up() const;
  bool came_as_predicted(const NewtonSummary& summary, double moved) const;
  bool passes_unstable_states(const NewtonSummary& summary, int unstable) const;
  void accept(CurvePoint point, const PathEnergy& energy);
  bool locate_change(double from, double to, const std::vector<double>& z, int after, double meet);
  SteppingSummary follow_arc(double target);

  static constexpr int most_tries = 1000;   // for one load factor asked for
  static constexpr int tries_unwound = 50;  // likewise, before it is asked whether it winds up
  static constexpr double states_meet = 1e-7;

  Problem* problem_;
  SteppingOptions options_;
  Newton newton_;
  std::deque<CurvePoint> points_;
  PathEnergy energy_;
  int unstable_ = 0;
  double next_step_ = 1.0;
  std::vector<StabilityChange> changes_;
  int steps_ = 0;
  int iterations_ = 0;
  std::vector<double> start_;
  std::vector<double> state_;  // at the load factor asked for
};

template <LoadedProblem Problem>
bool LoadStepping<Problem>::start(const std::vector<double>& z) {
  problem_->set_load_factor(0.0);
  ++iterations_;
  if (!problem_->linearize(z)) return false;
  unstable_ = problem_->unstable_directions();
  points_.push_back({0.0, z, {}});
  energy_ = measure_energy(*problem_, z, points_.back().slope);
  state_ = z;
  start_ = z;
  return true;
}

template <LoadedProblem Problem>
SteppingSummary LoadStepping<Problem>::advance(double target) {
  for (int tries = 0; points_.back().parameter < target; ++tries) {
    if (tries > tries_unwound && is_wound_up())
      return {SteppingOutcome::wound_up, points_.back().parameter, {}};
    if (tries == most_tries) return {SteppingOutcome::lost, points_.back().parameter, {}};
    const double from = points_.back().parameter;
    double step = std::min(next_step_, target - from);
    if (target - from - step < 0.2 * step) step = target - from;
    if (try_step(from + step == target ? target : from + step)) {
      next_step_ = std::max(next_step_, 2.0 * step);
      continue;
    }
    next_step_ = 0.5 * step;
    if (next_step_ < options_.smallest_step) {
      if (step_over(target)) break;
      SteppingSummary followed = follow_arc(target);
      next_step_ = 4.0 * options_.smallest_step;
      if (followed.outcome == SteppingOutcome::reached) continue;
      if (followed.outcome == SteppingOutcome::lost && cross_over(target)) continue;
      return followed;
    }
  }
  return {SteppingOutcome::reached, target, {}};
}

/// A bifurcation that is perfect to rounding: so near to it that nothing moves but by rounding, no
/// path is left to follow, and beside it states scatter. Steps lead across it.
template <LoadedProblem Problem>
bool LoadStepping<Problem>::cross_over(double target) {
  constexpr double scatter = 1e-4;
  constexpr int doublings = 5;
  const double from = points_.back().parameter;
  double step = options_.smallest_step;
  for (int k = 0; k < doublings; ++k, step *= 2.0)
    if (try_step(std::min(from + step, target), scatter)) return true;
  return false;
}

/// Flexures that wind up around each other without end, under loads far beyond what bends them.
template <LoadedProblem Problem>
bool LoadStepping<Problem>::is_wound_up() const {
  if constexpr (requires { problem_->largest_turn(state_); })
    return problem_->largest_turn(state_) > wound_up_turn;
  return false;
}

/// Where the load factor asked for is critical itself, no Newton iteration converges on it: goes a
/// little further, and takes the state from the interpolated path.
template <LoadedProblem Problem>
bool LoadStepping<Problem>::step_over(double target) {
  constexpr double little = 1e-6;
  if (target - points_.back().parameter > 2.0 * options_.smallest_step) return false;
  if (!try_step(target * (1.0 + little))) return false;
  extrapolate_hermite(points_, target, state_);
  problem_->set_load_factor(target);
  return true;
}

template <LoadedProblem Problem>
bool LoadStepping<Problem>::try_step(double to, double meet) {
  const CurvePoint& last = points_.back();
  const double from = last.parameter;
  CurvePoint next{to, {}, {}};
  extrapolate_hermite(points_, to, next.value);
  problem_->set_load_factor(to);
  // what moves little is found to as many digits
  const double reach = distance(*problem_, start_, next.value);
  newton_.set_tolerance(options_.tolerance * std::clamp(reach, 1e-4, 1.0));
  const NewtonSummary summary = newton_.solve(*problem_, next.value);
  iterations_ += summary.iterations;
  if (summary.outcome != NewtonOutcome::converged) return false;

  const double moved = distance(*problem_, last.value, next.value);
  if (!came_as_predicted(summary, moved)) return false;
  const int unstable = problem_->unstable_directions();
  if (passes_unstable_states(summary, unstable)) return false;
  const PathEnergy energy = measure_energy(*problem_, next.value, next.slope);
  // where nothing moves but by rounding, directions and work mean nothing
  if (moved >= 1e-7 &&
      !(goes_on(*problem_, last, next) && work_is_smooth(*problem_, from, energy_, to, energy) &&
        middle_fits(*problem_, last, next, {unstable_, unstable}, iterations_)))
    return false;
  if (unstable != unstable_) {
    if (to - from > 0.01 || !locate_change(from, to, next.value, unstable, meet)) return false;
    unstable_ = unstable;
  }
  accept(std::move(next), energy);
  return true;
}

template <LoadedProblem Problem>
bool LoadStepping<Problem>::came_as_predicted(const NewtonSummary& summary, double moved) const {
  const double off = summary.first_step;
  // without an energy to tell branches apart, only short steps are sure to stay on theirs; with
  // one, long steps that came out as predicted are, too
  const bool follows = problem_->has_follower_loads();
  if ((points_.size() > 1 || follows) && off > 0.02 && off > 0.1 * moved) return false;
  if (moved > 0.5 && follows) return false;
  return moved <= 1.0 || points_.size() == 1 || off <= 0.01 * moved;
}

template <LoadedProblem Problem>
bool LoadStepping<Problem>::passes_unstable_states(const NewtonSummary& summary,
                                                   int unstable) const {
  return points_.size() == 1 && summary.unstable_at_start > std::max(unstable, unstable_);
}

template <LoadedProblem Problem>
void LoadStepping<Problem>::accept(CurvePoint point, const PathEnergy& energy) {
  ++steps_;
  energy_ = energy;
  problem_->set_load_factor(point.parameter);
  state_ = point.value;
  if (points_.size() == 3) points_.pop_front();
  points_.push_back(std::move(point));
}

/// Bisection on the load factor between two states of different stability. False where the states
/// on both sides of the change do not meet: then a limit point lies between them, and the step has
/// gone beyond it to another branch.
template <LoadedProblem Problem>
bool LoadStepping<Problem>::locate_change(double from, double to, const std::vector<double>& z,
                                          int after, double meet) {
  StabilityChange change{to, unstable_, after, {}};
  double low = from;
  double high = to;
  std::vector<double> at_low = points_.back().value;
  std::vector<double> at_high = z;
  int at_change = after;
  const double moved = distance(*problem_, at_low, at_high);
  while (high - low > 1e-11) {
    const double middle = 0.5 * (low + high);
    std::vector<double> trial;
    extrapolate_hermite(points_, middle, trial);
    problem_->set_load_factor(middle);
    const NewtonSummary summary = newton_.solve(*problem_, trial);
    iterations_ += summary.iterations;
    if (summary.outcome != NewtonOutcome::converged) break;
    const int unstable = problem_->unstable_directions();
    const bool before = unstable == unstable_;
    (before ? low : high) = middle;
    (before ? at_low : at_high) = trial;
    if (before) continue;
    at_change = unstable;
    change.z = std::move(trial);
  }
  // at the change itself Newton's method may fail: near it the path is still one
  const double bracket = (high - low) / (to - from);
  if (bracket > 0.01 ||
      distance(*problem_, at_low, at_high) > std::max(std::max(1e-3, 3.0 * bracket) * moved, meet))
    return false;
  // directions lost one after another are found by shorter steps
  if (at_change != after && to - from > 2.0 * options_.smallest_step) return false;
  change.load_factor = high;
  changes_.push_back(std::move(change));
  return true;
}

/// Where load control fails: either the load factor turns back (a limit point) or the path is
/// merely steep, and load control takes over again past it.
template <LoadedProblem Problem>
SteppingSummary LoadStepping<Problem>::follow_arc(double target) {
  const double start = points_.back().parameter;
  Continuation<Problem> path(*problem_,
                             {options_.tolerance, 0.05, 1e-9, 0.5, options_.smallest_step, false});
  const auto lost = [&]() -> SteppingSummary {
    iterations_ += path.iterations();
    return {SteppingOutcome::lost, start, {}};
  };
  if (!path.start(start, points_.back().value)) return lost();
  const auto slope_of = [this](const ArcState& state) {
    return std::sqrt(problem_->inner(state.tangent_z, state.tangent_z)) / state.tangent_load;
  };
  const double steep = slope_of(path.state());
  std::vector<StabilityChange> passed;  // of no account where the arc is lost
  const auto keep = [&] {
    changes_.insert(changes_.end(), passed.begin(), passed.end());
    iterations_ += path.iterations();
  };
  for (int k = 0; k < 400; ++k) {
    if (!path.advance()) return lost();
    for (const LocatedFeature& found : path.features()) {
      if (found.feature == PathFeature::limit_point) {
        if (found.state.load_factor <= start) return lost();
        keep();
        return {SteppingOutcome::limit_point, found.state.load_factor, found.state.z};
      }
      passed.push_back(
          {found.state.load_factor, found.unstable_before, found.unstable_after, found.state.z});
    }
    const bool arrived = path.state().load_factor >= target;
    if (arrived && !path.land(target)) return lost();
    if (!arrived && k <= 200 && slope_of(path.state()) > 0.5 * steep) continue;
    CurvePoint here{path.state().load_factor, path.state().z, {}};
    problem_->set_load_factor(here.parameter);
    ++iterations_;
    if (!problem_->linearize(here.value)) return lost();
    // what lies beyond is met again
    while (!passed.empty() && passed.back().load_factor > here.parameter) passed.pop_back();
    if (path.unstable_directions() != (passed.empty() ? unstable_ : passed.back().after))
      return lost();
    unstable_ = path.unstable_directions();
    keep();
    const PathEnergy energy = measure_energy(*problem_, here.value, here.slope);
    accept(std::move(here), energy);
    return {SteppingOutcome::reached, points_.back().parameter, {}};
  }
  return lost();
}

template <LoadedProblem Problem>
bool LoadStepping<Problem>::correct() {
  CurvePoint& last = points_.back();
  problem_->set_load_factor(last.parameter);
  const NewtonSummary summary = newton_.solve(*problem_, last.value);
  iterations_ += summary.iterations;
  if (summary.outcome != NewtonOutcome::converged) return false;
  unstable_ = problem_->unstable_directions();
  energy_ = measure_energy(*problem_, last.value, last.slope);
  state_ = last.value;
  return true;
}

template <LoadedProblem Problem>
template <class Prolong>
void LoadStepping<Problem>::change_problem(Problem& problem, const Prolong& prolong) {
  problem_ = &problem;
  for (CurvePoint& point : points_) {
    point.value = prolong(point.value);
    point.slope = prolong(point.slope);
  }
  start_ = prolong(start_);
}

}  // namespace flexura

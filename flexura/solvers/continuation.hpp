#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "flexura/solvers/arc_length.hpp"
#include "flexura/solvers/newton.hpp"

namespace flexura {

/// A loaded problem that knows, at a critical state, the direction it gives way in.
template <class P>
concept BranchingProblem = LoadedProblem<P> && requires(P p, std::vector<double>& direction) {
  p.critical_direction(direction);
};

enum class PathFeature { limit_point, bifurcation, zero_load };

/// Something located between two states of a continuation.
struct LocatedFeature {
  PathFeature feature = PathFeature::limit_point;
  ArcState state;
  int unstable_before = 0;
  int unstable_after = 0;
};

struct ContinuationOptions {
  double tolerance = 1e-11;
  double largest_step = 0.1;     ///< arc length
  double smallest_step = 1e-7;   ///< likewise, of stiff mechanisms as much less as they move less
  double straight_step = 0.0;    ///< largest where the path turns by less than 3 degrees, if more
  double first_rise = INFINITY;  ///< of the load factor, in the first step
  bool crosses = true;           ///< bifurcations that are perfect to rounding, where no step meets
};

/// Follows a path of equilibria by pseudo-arc-length steps, through limit points and past
/// bifurcations. A step is accepted where the path heads along it at both ends, to within 25
/// degrees: only a short step can leave the path and still do that. Between two states it locates
/// limit points (the load factor stands still), bifurcations (a direction becomes unstable or
/// stable though the load factor does not turn) and zeros of the load factor.
template <LoadedProblem Problem>
class Continuation {
 public:
  Continuation(Problem& problem, ContinuationOptions options)
      : problem_(&problem),
        options_(options),
        arc_(problem, options.tolerance),
        newton_({options.tolerance, 30, 6}) {}

  /// Begins at a state, in the sense of a growing load factor. False where it is singular.
  bool start(double load_factor, const std::vector<double>& z);
  /// One step on. False where no step of any size succeeds.
  bool advance();
  /// Replaces the last step by a state of the same stretch with this load factor, which must lie
  /// between those of the last two states.
  bool land(double load_factor);
  /// Leaves the path at a bifurcation, along the critical direction (side 1) or against it (-1).
  bool switch_branch(const ArcState& bifurcation, int side) requires BranchingProblem<Problem>;
  /// Goes on from a state of another, finer problem.
  void change_problem(Problem& problem, const ArcState& here);

  const ArcState& state() const { return here_; }
  /// How much of an arc length a load factor of 1 is: what the mechanism moves by at first.
  double load_scale() const { return load_scale_; }
  int unstable_directions() const { return unstable_; }
  /// What the last `advance` passed, in order.
  const std::vector<LocatedFeature>& features() const { return features_; }
  int iterations() const { return arc_.iterations() + iterations_; }

 private:
  bool falls_back(const ArcState& next) const;
  bool try_sizes(double meet);
  bool locate_features(const ArcState& next, double size, int after, double meet);
  bool locate_change(double size, double meet, ArcState& at, double& place);
  void narrow(const ArcState& low, const ArcState& high, ArcState& at);
  bool changes_at_once(double place, double size, int after);
  bool locate_zero(double size, ArcState& at);

  static constexpr double meet_by_size = 0.0;

  /// The first step that was refused, as what it passed could not be located, and how much of it
  /// shorter ones have still to do.
  struct Refused {
    ArcState from;
    double size = 0.0;
    double left = 0.0;
  };
  std::optional<Refused> refused_;

  Problem* problem_;
  ContinuationOptions options_;
  ArcLength<Problem> arc_;
  Newton newton_;
  double size_ = 0.0;
  double load_scale_ = 1.0;
  ArcState here_;
  ArcState before_;
  int unstable_ = 0;
  std::vector<LocatedFeature> features_;
  int iterations_ = 0;
};

template <LoadedProblem Problem>
bool Continuation<Problem>::start(double load_factor, const std::vector<double>& z) {
  here_ = {load_factor, z, {}, 0.0};
  problem_->set_load_factor(load_factor);
  ++iterations_;
  if (!problem_->linearize(z)) return false;
  problem_->load_direction(here_.tangent_z);
  const double slope = std::sqrt(problem_->inner(here_.tangent_z, here_.tangent_z));
  // what does not move at all, but for rounding, has no scale
  load_scale_ = slope < 1e-11 ? 1.0 : std::clamp(slope, 1e-7, 1.0);
  arc_.set_load_scale(load_scale_);
  unstable_ = problem_->unstable_directions();
  if (!arc_.set_tangent(here_, nullptr)) return false;
  size_ =
      std::min(0.2 * options_.largest_step * load_scale_, options_.first_rise / here_.tangent_load);
  return true;
}

template <LoadedProblem Problem>
bool Continuation<Problem>::advance() {
  if (try_sizes(meet_by_size)) return true;
  if (!options_.crosses || !refused_) return false;
  // Beside a bifurcation that is perfect to rounding, states scatter: across it from farther off.
  constexpr double scatter = 1e-4;
  here_ = std::move(refused_->from);
  size_ = refused_->size;
  refused_.reset();
  return try_sizes(scatter);
}

template <LoadedProblem Problem>
bool Continuation<Problem>::try_sizes(double meet) {
  while (size_ >= options_.smallest_step * load_scale_) {
    ArcState next;
    features_.clear();
    if (!arc_.step(here_, size_, next) || !arc_.heads_along(here_, next) || falls_back(next)) {
      size_ *= 0.5;
      continue;
    }
    const int after = problem_->unstable_directions();
    if (!locate_features(next, size_, after, meet)) {
      if (!refused_) refused_ = Refused{here_, size_, size_};
      size_ *= 0.5;
      continue;
    }
    // what was found is behind, and so is a step that shorter ones have done
    if (refused_ && ((refused_->left -= size_) < 0.0 || !features_.empty())) refused_.reset();
    const bool straight = arc_.heads_along(here_, next, 0.9986);
    before_ = std::move(here_);
    here_ = std::move(next);
    unstable_ = after;
    const double largest = std::max(options_.largest_step, straight ? options_.straight_step : 0.0);
    size_ = std::min(1.5 * size_, largest);
    return true;
  }
  return false;
}

/// Whether the load factor grows at both ends of a step and is less at its end, or the other way
/// round: then it turns twice in between, or the end lies on another part of the path.
template <LoadedProblem Problem>
bool Continuation<Problem>::falls_back(const ArcState& next) const {
  const double rise = next.load_factor - here_.load_factor;
  return here_.tangent_load * next.tangent_load > 0.0 && rise * next.tangent_load < 0.0;
}

/// False where a limit point cannot be located, or the states on both sides of a change of
/// stability do not meet: then the step has left the path for another one that passes close by.
template <LoadedProblem Problem>
bool Continuation<Problem>::locate_features(const ArcState& next, double size, int after,
                                            double meet) {
  ArcState at = next;
  if (here_.tangent_load * next.tangent_load < 0.0) {
    if (!arc_.locate(here_, size, at)) return false;
    features_.push_back({PathFeature::limit_point, at, unstable_, after});
  } else if (after != unstable_) {
    double place = 0.0;
    if (!locate_change(size, meet, at, place)) return false;
    if (meet == meet_by_size && !changes_at_once(place, size, after)) return false;
    features_.push_back({PathFeature::bifurcation, at, unstable_, after});
  }
  if (here_.load_factor * next.load_factor < 0.0) {
    at = next;
    if (locate_zero(size, at)) {
      const int unstable = problem_->unstable_directions();
      features_.push_back({PathFeature::zero_load, at, unstable, unstable});
    }
  }
  return true;
}

/// Bisection on the arc length for the end of the stretch with as many unstable directions as at
/// its start. At the change itself the equations are singular: failing there is as near as it gets.
template <LoadedProblem Problem>
bool Continuation<Problem>::locate_change(double size, double meet, ArcState& at, double& place) {
  double low = 0.0, high = size;
  ArcState at_low = here_, at_high = at;
  double steepness = INFINITY;
  while (high - low > 1e-11 * size) {
    const double middle = 0.5 * (low + high);
    ArcState trial;
    if (!arc_.step(here_, middle, trial)) break;
    const bool before = problem_->unstable_directions() == unstable_;
    (before ? low : high) = middle;
    (before ? at_low : at_high) = trial;
    // the load factor standing still there, this is a fold that the step has jumped
    if (high - low > 5e-4 * size) steepness = std::abs(trial.tangent_load);
    at = std::move(trial);
  }
  if (steepness < 0.5 * std::abs(here_.tangent_load)) return false;
  std::vector<double> gap = at_high.z;
  add_scaled(gap, -1.0, at_low.z);
  const double apart = std::sqrt(problem_->inner(gap, gap));
  place = high;
  if (meet == meet_by_size ? high - low > 1e-4 * size || apart > 1e-3 * size
                           : high - low > 1e-2 * size || apart > meet)
    return false;
  if (high - low > 1e-11 * size) narrow(at_low, at_high, at);
  return true;
}

/// Where no step converges any more, the states between two that nearly meet do as well: how many
/// directions are unstable there narrows the change down.
template <LoadedProblem Problem>
void Continuation<Problem>::narrow(const ArcState& low, const ArcState& high, ArcState& at) {
  double from = 0.0, to = 1.0;
  for (int k = 0; k < 40; ++k) {
    const double share = 0.5 * (from + to);
    ArcState between = low;
    for (double& z : between.z) z *= 1.0 - share;
    add_scaled(between.z, share, high.z);
    between.load_factor += share * (high.load_factor - low.load_factor);
    problem_->set_load_factor(between.load_factor);
    ++iterations_;
    if (!problem_->linearize(between.z)) break;
    (problem_->unstable_directions() == unstable_ ? from : to) = share;
    at = std::move(between);
  }
}

/// Whether all directions that a step gains or loses do so at the place located; else a shorter
/// step will find them one by one.
template <LoadedProblem Problem>
bool Continuation<Problem>::changes_at_once(double place, double size, int after) {
  if (std::abs(after - unstable_) < 2) return true;
  ArcState beyond;
  const double further = std::min(size, place + 1e-3 * size);
  return !arc_.step(here_, further, beyond) || problem_->unstable_directions() == after;
}

/// The load factor's zero by regula falsi on the arc length, then by Newton at no load.
template <LoadedProblem Problem>
bool Continuation<Problem>::locate_zero(double size, ArcState& at) {
  double low = 0.0, high = size;
  double at_low = here_.load_factor, at_high = at.load_factor;
  for (int k = 0; k < 40 && high - low > 1e-8 * size; ++k) {
    const double share = k % 3 == 2 ? 0.5 : at_low / (at_low - at_high);
    const double middle = low + share * (high - low);
    ArcState trial;
    if (!arc_.step(here_, middle, trial)) break;
    const bool below = (trial.load_factor < 0.0) == (at_low < 0.0);
    (below ? low : high) = middle;
    (below ? at_low : at_high) = trial.load_factor;
    at = std::move(trial);
  }
  problem_->set_load_factor(0.0);
  const NewtonSummary summary = newton_.solve(*problem_, at.z);
  iterations_ += summary.iterations + 1;
  at.load_factor = 0.0;
  return summary.outcome == NewtonOutcome::converged && problem_->linearize(at.z);
}

template <LoadedProblem Problem>
bool Continuation<Problem>::land(double load_factor) {
  const double rise = here_.load_factor - before_.load_factor;
  const double share = rise == 0.0 ? 1.0 : (load_factor - before_.load_factor) / rise;
  std::vector<double> z = before_.z;
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += share * (here_.z[i] - before_.z[i]);
  problem_->set_load_factor(load_factor);
  const NewtonSummary summary = newton_.solve(*problem_, z);
  iterations_ += summary.iterations + 1;
  if (summary.outcome != NewtonOutcome::converged || !problem_->linearize(z)) return false;
  here_ = {load_factor, std::move(z), {}, 0.0};
  unstable_ = problem_->unstable_directions();
  return arc_.set_tangent(here_, &before_);
}

template <LoadedProblem Problem>
bool Continuation<Problem>::switch_branch(const ArcState& bifurcation,
                                          int side) requires BranchingProblem<Problem> {
  ArcState from = bifurcation;
  problem_->set_load_factor(from.load_factor);
  ++iterations_;
  if (!problem_->linearize(from.z)) return false;
  problem_->critical_direction(from.tangent_z);
  // across the path that is left
  const double along = problem_->inner(from.tangent_z, bifurcation.tangent_z);
  const double square = problem_->inner(bifurcation.tangent_z, bifurcation.tangent_z);
  if (square > 0.0) add_scaled(from.tangent_z, -along / square, bifurcation.tangent_z);
  const double length = std::sqrt(problem_->inner(from.tangent_z, from.tangent_z));
  if (!(length > 1e-6)) return false;
  for (double& t : from.tangent_z) t *= side / length;
  from.tangent_load = 0.0;
  double size = 0.2 * options_.largest_step;
  for (int tries = 0; tries < 11; ++tries, size *= 0.5) {
    ArcState next;
    if (!arc_.step(from, size, next)) continue;
    features_.clear();
    refused_.reset();
    unstable_ = problem_->unstable_directions();
    before_ = from;
    here_ = std::move(next);
    size_ = size;
    return true;
  }
  return false;
}

template <LoadedProblem Problem>
void Continuation<Problem>::change_problem(Problem& problem, const ArcState& here) {
  iterations_ += arc_.iterations();
  problem_ = &problem;
  refused_.reset();  // a state of the problem before
  arc_ = ArcLength<Problem>(problem, options_.tolerance);
  arc_.set_load_scale(load_scale_);
  here_ = here;
  problem_->set_load_factor(here_.load_factor);
  if (problem_->linearize(here_.z)) unstable_ = problem_->unstable_directions();
}

}  // namespace flexura

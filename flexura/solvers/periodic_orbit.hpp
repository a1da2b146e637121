#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <functional>
#include <vector>

#include "flexura/solvers/flow_directions.hpp"

namespace flexura {

/// Where a period takes a state x. `turn` gives the state at its end, with windings taken off: it
/// is x again on a periodic orbit; false where there is no way through. `flow` gives the image of a
/// small direction under the derivative of that, at the x of the last turn.
template <class P>
concept PeriodMap = requires(P map, const Eigen::VectorXd& x, Eigen::VectorXd& end) {
  { map.turn(x, end) } -> std::same_as<bool>;
  { map.flow(x, end) } -> std::same_as<bool>;
};

/// A period map of which only the turn is known: its flow is taken by forward differences.
template <class Turn>
class DifferencedMap {
 public:
  /// `step`: of a state, as long as a direction of length 1.
  explicit DifferencedMap(Turn turn, double step = 1e-6) : turn_(std::move(turn)), step_(step) {}

  bool turn(const Eigen::VectorXd& x, Eigen::VectorXd& end) {
    if (!turn_(x, end)) return false;
    at_ = x;
    end_ = end;
    return true;
  }
  bool flow(const Eigen::VectorXd& direction, Eigen::VectorXd& image) {
    if (!turn_(at_ + step_ * direction, image)) return false;
    image = (image - end_) / step_;
    return true;
  }

 private:
  Turn turn_;
  double step_;
  Eigen::VectorXd at_, end_;
};

struct PeriodicOrbitOptions {
  double tolerance = 1e-9;  ///< of the length by which a state misses itself after a period
  /// Of that length, what a solution of the linear equations leaves.
  double forcing = 0.05;
  int most_iterations = 40;
  int most_turns = 1000;      ///< for the orbit, linearised ones included
  int most_directions = 120;  ///< of the Krylov space
  int multipliers = 6;        ///< so many of the largest are wanted; 0: none
  double multiplier_tolerance = 1e-3;
  std::function<bool()> keep_going;  ///< asked after every turn; none: always
};

enum class OrbitOutcome {
  not_run,
  converged,
  no_turn,    ///< from the start there is no way through a period
  stalled,    ///< no step leads nearer
  exhausted,  ///< iterations or turns came to their end
  cancelled
};

struct OrbitIteration {
  double miss = 0.0;     ///< how far the state misses itself after a period
  double factor = 0.0;   ///< of the step that led there; 0: the start
  int directions = 0;    ///< of the Krylov space that it was taken in
  bool renewed = false;  ///< the space was built anew for it
};

struct PeriodicOrbitSummary {
  OrbitOutcome outcome = OrbitOutcome::not_run;
  std::vector<OrbitIteration> iterations;
  int turns = 0;             ///< of the map
  int flows = 0;             ///< linearised turns for the orbit
  int multiplier_flows = 0;  ///< and for the multipliers
  /// Floquet multipliers, the largest first, and the length of A x - multiplier x, |x| = 1, that
  /// tells how well each is known.
  std::vector<std::complex<double>> multipliers;
  std::vector<double> multiplier_residuals;

  bool converged() const { return outcome == OrbitOutcome::converged; }
  double miss() const { return iterations.empty() ? INFINITY : iterations.back().miss; }
};

/// The fixed point of a period map by shooting: Newton's method with linear equations solved in a
/// Krylov space. Directions and images are kept from one iteration to the next for as long as they
/// serve, and what the space leaves of a miss is taken as the turn itself leaves it (Picard's
/// step), since a turn all but extinguishes whatever the space does not need: the idea of Lust,
/// Roose, Spence and Champneys, An adaptive Newton-Picard algorithm with subspace iteration for
/// computing periodic solutions, SIAM J. Sci. Comput. 19, 1998. So a period map whose changes are
/// nearly linear takes about as many linearised turns as it has multipliers that are not small,
/// whatever their distance from 1, and a turn for every iteration.
template <PeriodMap Map>
class PeriodicOrbit {
 public:
  PeriodicOrbit(Map& map, PeriodicOrbitOptions options) : map_(map), options_(std::move(options)) {}

  /// From x, which holds the state with the smallest miss at the end: the orbit if converged.
  PeriodicOrbitSummary solve(Eigen::VectorXd& x);

 private:
  bool turn(const Eigen::VectorXd& x);
  bool asks_to_stop();
  bool add_direction(const Eigen::VectorXd& towards, int& flows);
  FlowDirections::Solution linear_solution();
  bool advance(Eigen::VectorXd& x);
  bool try_step(Eigen::VectorXd& x, const Eigen::VectorXd& step);
  void iterate(Eigen::VectorXd& x);
  void find_multipliers(Eigen::Index size);
  bool renew_images();
  void record_multipliers(const std::vector<RitzPair>& pairs);

  Map& map_;
  PeriodicOrbitOptions options_;
  PeriodicOrbitSummary summary_;
  FlowDirections directions_;
  Eigen::VectorXd miss_;    // of the last turn
  Eigen::VectorXd before_;  // of the last iterate
  bool aged_ = false;       // images are those of an earlier iterate
  bool renewed_ = false;
};

template <PeriodMap Map>
PeriodicOrbitSummary PeriodicOrbit<Map>::solve(Eigen::VectorXd& x) {
  summary_ = {};
  directions_.clear();
  if (!turn(x)) {
    summary_.outcome = OrbitOutcome::no_turn;
    return summary_;
  }
  summary_.iterations.push_back({miss_.norm(), 0.0, 0, false});
  iterate(x);
  if (summary_.converged() && options_.multipliers > 0) find_multipliers(x.size());
  return summary_;
}

template <PeriodMap Map>
bool PeriodicOrbit<Map>::turn(const Eigen::VectorXd& x) {
  Eigen::VectorXd end;
  ++summary_.turns;
  if (!map_.turn(x, end) || !end.allFinite()) return false;
  miss_ = end - x;
  return true;
}

template <PeriodMap Map>
bool PeriodicOrbit<Map>::asks_to_stop() {
  if (!options_.keep_going || options_.keep_going()) return false;
  summary_.outcome = OrbitOutcome::cancelled;
  return true;
}

template <PeriodMap Map>
void PeriodicOrbit<Map>::iterate(Eigen::VectorXd& x) {
  while (summary_.miss() > options_.tolerance) {
    if (static_cast<int>(summary_.iterations.size()) > options_.most_iterations ||
        summary_.turns + summary_.flows >= options_.most_turns) {
      summary_.outcome = OrbitOutcome::exhausted;
      return;
    }
    const double before = summary_.miss();
    if (!advance(x)) {
      if (summary_.outcome == OrbitOutcome::not_run) summary_.outcome = OrbitOutcome::stalled;
      return;
    }
    // a space that served badly has aged, or the map is far from linear
    constexpr double slow = 0.5;
    aged_ = true;
    if (summary_.miss() > slow * before) directions_.clear();
  }
  summary_.outcome = OrbitOutcome::converged;
}

template <PeriodMap Map>
bool PeriodicOrbit<Map>::add_direction(const Eigen::VectorXd& towards, int& flows) {
  const Eigen::VectorXd direction = directions_.across(towards);
  Eigen::VectorXd image;
  if (direction.size() == 0 || directions_.count() >= options_.most_directions) return false;
  ++flows;
  if (!map_.flow(direction, image) || !image.allFinite() || asks_to_stop()) return false;
  directions_.add(direction, image);
  return true;
}

/// The space grows by remainders until it leaves little enough.
template <PeriodMap Map>
FlowDirections::Solution PeriodicOrbit<Map>::linear_solution() {
  if (directions_.count() == 0) aged_ = false;
  FlowDirections::Solution solution = directions_.solve(miss_);
  while (solution.remainder.norm() > options_.forcing * miss_.norm() &&
         add_direction(solution.remainder, summary_.flows))
    solution = directions_.solve(miss_);
  return solution;
}

/// One iteration. Where no step of an aged space leads nearer, there is another in a new one.
template <PeriodMap Map>
bool PeriodicOrbit<Map>::advance(Eigen::VectorXd& x) {
  for (const bool last : {false, true}) {
    renewed_ = directions_.count() == 0;
    const FlowDirections::Solution solution = linear_solution();
    if (summary_.outcome == OrbitOutcome::cancelled) return false;
    const bool aged = aged_;
    const Eigen::VectorXd start = x;
    if (try_step(x, solution.step + solution.remainder)) return true;
    if (summary_.outcome == OrbitOutcome::cancelled) return false;
    // the flow is that of the last turn
    if (!turn(start) || last || !aged) return false;
    directions_.clear();
  }
  return false;
}

/// Shortened until the miss falls.
template <PeriodMap Map>
bool PeriodicOrbit<Map>::try_step(Eigen::VectorXd& x, const Eigen::VectorXd& step) {
  constexpr int most_halvings = 6;
  const double before = summary_.miss();
  before_ = miss_;
  for (int halvings = 0; halvings <= most_halvings; ++halvings) {
    const double factor = std::ldexp(1.0, -halvings);
    const Eigen::VectorXd trial = x + factor * step;
    const bool through = turn(trial);
    if (asks_to_stop()) return false;
    if (!through || !(miss_.norm() < (1.0 - 0.1 * factor) * before)) {
      if (aged_ && factor < 0.5) return false;  // rather a new space than creeping
      continue;
    }
    const Eigen::VectorXd taken = trial - x;
    directions_.learn(taken, miss_ - before_ + taken);
    x = trial;
    const auto count = static_cast<int>(directions_.count());
    summary_.iterations.push_back({miss_.norm(), factor, count, renewed_});
    return true;
  }
  return false;
}

template <PeriodMap Map>
bool PeriodicOrbit<Map>::renew_images() {
  for (Eigen::Index k = 0; k < directions_.count(); ++k) {
    Eigen::VectorXd image;
    ++summary_.multiplier_flows;
    if (!map_.flow(directions_.direction(k), image) || !image.allFinite()) return false;
    directions_.set_image(k, image);
    if (options_.keep_going && !options_.keep_going()) return false;
  }
  return true;
}

/// Directions of the orbit's own Krylov space, with their images at the orbit, and others until the
/// largest eigenvalues are known: along the residual of the first that is not (Arnoldi's method
/// goes the same way). A direction of no preference finds what no miss had a part of.
template <PeriodMap Map>
void PeriodicOrbit<Map>::find_multipliers(Eigen::Index size) {
  if (!renew_images()) return;
  Eigen::VectorXd any(size);
  for (Eigen::Index i = 0; i < size; ++i) any[i] = std::cos(1.0 + 2.4 * static_cast<double>(i));
  int& flows = summary_.multiplier_flows;
  bool grows = add_direction(any, flows);
  while (true) {
    const std::vector<RitzPair> pairs = directions_.ritz_pairs();
    record_multipliers(pairs);
    const auto wanted = std::min(pairs.size(), static_cast<std::size_t>(options_.multipliers));
    const auto unknown = std::find_if(
        pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(wanted),
        [&](const auto& pair) { return pair.residual.norm() > options_.multiplier_tolerance; });
    const bool all =
        wanted == static_cast<std::size_t>(std::min<Eigen::Index>(options_.multipliers, size));
    if (!grows || (all && unknown == pairs.begin() + static_cast<std::ptrdiff_t>(wanted))) break;
    const RitzPair& next = unknown == pairs.end() ? pairs.back() : *unknown;
    grows = add_direction(next.residual.real(), flows);
    if (std::abs(next.value.imag()) > 0.0)
      grows = add_direction(next.residual.imag(), flows) || grows;
  }
  // the orbit is what it is, whether or not all of its multipliers were found
  if (summary_.outcome == OrbitOutcome::cancelled) summary_.outcome = OrbitOutcome::converged;
}

template <PeriodMap Map>
void PeriodicOrbit<Map>::record_multipliers(const std::vector<RitzPair>& pairs) {
  summary_.multipliers.clear();
  summary_.multiplier_residuals.clear();
  for (const RitzPair& pair : pairs) {
    summary_.multipliers.push_back(pair.value);
    summary_.multiplier_residuals.push_back(pair.residual.norm());
  }
}

}  // namespace flexura

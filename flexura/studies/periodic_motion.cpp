#include "flexura/studies/periodic_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "flexura/solvers/periodic_orbit.hpp"
#include "flexura/studies/turn_layout.hpp"
#include "flexura/studies/turn_map.hpp"

namespace flexura {
namespace {

double period_of(double speed) { return 2.0 * std::numbers::pi / std::abs(speed); }

/// As drawn, moving as if flexures were rigid: the rates that take the least strain.
Moment rigid_start(MotionSystem& system, double period) {
  Moment moment = system.drawn_moment();
  MotionFactor<double> factor;
  if (!project_rates(system, moment, period, factor)) moment.v.setZero();
  return moment;
}

class PeriodicSearch {
 public:
  PeriodicSearch(const Model& model, const PeriodicMotionStudy& study,
                 const ModelingSettings& settings, const std::function<bool()>& keep_going)
      : layout_(model, study, settings), study_(study), keep_going_(keep_going) {}

  PeriodicMotion run();

 private:
  /// Where an orbit starts. Rates per speed hardly change at low speeds.
  struct Orbit {
    double speed = 0.0;
    Eigen::VectorXd q, rates;
  };
  bool try_speed(double speed, const std::optional<Orbit>& start);
  bool keep(std::unique_ptr<MotionSystem> system, TurnMap& map,
            const PeriodicOrbitSummary& summary);
  void explain(const PeriodicOrbitSummary& summary, double speed, const TurnMap& map);
  bool find_slower();
  void speed_up();
  Orbit predicted(double speed) const;

  TurnLayout layout_;
  const PeriodicMotionStudy& study_;
  const std::function<bool()>& keep_going_;
  bool cancelled_ = false;
  std::vector<Orbit> orbits_;  // found so far, by speed
  std::string failure_;        // of the last speed that failed
  PeriodicMotion motion_;
};

/// From a free state, or from the drawn mechanism moving as if rigid.
bool PeriodicSearch::try_speed(double speed, const std::optional<Orbit>& start) {
  auto system = std::make_unique<MotionSystem>(layout_.at(speed));
  const double period = period_of(speed);
  TurnMap map(*system, system->drawn_moment(),
              {period, study_.outputs, study_.tolerance, layout_.breaks(speed)});
  PeriodicOrbitOptions options;
  options.tolerance = study_.miss;
  options.most_turns = study_.most_turns;
  options.multipliers = speed == study_.speed ? study_.multipliers : 0;
  options.keep_going = keep_going_;
  PeriodicOrbit<TurnMap> orbit(map, options);
  Moment moment = rigid_start(*system, period);
  if (start) {
    moment.q = start->q;
    moment.v = speed * start->rates;
  }
  Eigen::VectorXd x = map.free_state().reduce(moment);
  const PeriodicOrbitSummary summary = orbit.solve(x);
  motion_.turns += summary.turns;
  motion_.flows += summary.flows;
  motion_.multiplier_flows += summary.multiplier_flows;
  motion_.speeds.push_back({speed, false, static_cast<int>(summary.iterations.size()) - 1,
                            summary.turns + summary.flows});
  cancelled_ = summary.outcome == OrbitOutcome::cancelled;
  const bool found = summary.converged() && keep(std::move(system), map, summary);
  motion_.speeds.back().found = found;
  if (!found) explain(summary, speed, map);
  motion_.iterations += map.counts().iterations;
  return found;
}

bool PeriodicSearch::keep(std::unique_ptr<MotionSystem> system, TurnMap& map,
                          const PeriodicOrbitSummary& summary) {
  ++motion_.turns;
  std::vector<Moment> moments;
  if (!map.record(moments)) return false;
  motion_.moments = std::move(moments);
  motion_.speed = motion_.speeds.back().speed;
  const Moment& start = motion_.moments.front();
  orbits_.push_back({motion_.speed, start.q, start.v / motion_.speed});
  motion_.system = std::move(system);
  motion_.multipliers = summary.multipliers;
  motion_.multiplier_residuals = summary.multiplier_residuals;
  motion_.steps_per_turn = map.steps_per_turn();
  motion_.misses.clear();
  for (const OrbitIteration& iteration : summary.iterations)
    motion_.misses.push_back(iteration.miss);
  return true;
}

void PeriodicSearch::explain(const PeriodicOrbitSummary& summary, double speed,
                             const TurnMap& map) {
  const double angle = map.failed_at() * std::abs(speed) * 180.0 / std::numbers::pi;
  switch (summary.outcome) {
    case OrbitOutcome::no_turn:
      failure_ = fmt::format(
          "at speed {:.6g} the mechanism does not come round: no step leads on from {:.4g} degrees "
          "of the driven body, where it locks, or moves too fast for its modes",
          speed, angle);
      break;
    case OrbitOutcome::stalled:
      failure_ = fmt::format(
          "at speed {:.6g} no step leads to a motion that repeats itself: the last misses itself "
          "by {:.3g} (as radians of bending) after a turn",
          speed, summary.miss());
      break;
    case OrbitOutcome::cancelled:
      failure_ = fmt::format("cancelled at speed {:.6g}", speed);
      break;
    default:
      failure_ = fmt::format(
          "at speed {:.6g} {} turns do not find a motion that repeats itself: the last misses "
          "itself by {:.3g} (as radians of bending) after a turn",
          speed, summary.turns + summary.flows, summary.miss());
  }
}

/// Halved until there is an orbit.
bool PeriodicSearch::find_slower() {
  constexpr int most_halvings = 6;
  double speed = study_.speed;
  for (int k = 0; k < most_halvings && !cancelled_; ++k) {
    speed *= 0.5;
    if (try_speed(speed, std::nullopt)) return true;
  }
  return false;
}

/// Along the line through the last two orbits, by the speed's logarithm.
PeriodicSearch::Orbit PeriodicSearch::predicted(double speed) const {
  const Orbit& last = orbits_.back();
  if (orbits_.size() < 2) return last;
  const Orbit& before = orbits_[orbits_.size() - 2];
  const double share =
      std::min(2.0, std::log(speed / last.speed) / std::log(last.speed / before.speed));
  return {speed, last.q + share * (last.q - before.q),
          last.rates + share * (last.rates - before.rates)};
}

/// In steps that grow where a speed costs little and shrink where it fails.
void PeriodicSearch::speed_up() {
  constexpr double smallest = 0.005;  // of the speed's logarithm
  constexpr int few = 4;              // iterations
  double step = 0.5 * std::log(study_.speed / motion_.speed);
  while (motion_.speed != study_.speed && step > smallest && !cancelled_) {
    const double left = std::log(study_.speed / motion_.speed);
    const double speed = step > 0.99 * left ? study_.speed : motion_.speed * std::exp(step);
    const double tried = std::log(speed / motion_.speed);
    if (!try_speed(speed, predicted(speed))) {
      step = 0.4 * tried;
    } else if (motion_.speeds.back().iterations <= few) {
      step *= 1.6;
    }
  }
}

PeriodicMotion PeriodicSearch::run() {
  bool found = try_speed(study_.speed, std::nullopt);
  if (!found && study_.slower_first && !cancelled_) {
    const std::string direct = failure_;
    if (find_slower()) speed_up();
    found = motion_.speed == study_.speed;
    if (!found && orbits_.empty() && !cancelled_) failure_ = direct;
  }
  if (found) {
    motion_.termination.status = Status::converged;
  } else {
    motion_.termination = {Status::stopped, failure_};
    if (motion_.speed != 0.0)
      motion_.termination.reason += fmt::format("; up to speed {:.6g} it was found", motion_.speed);
    else
      motion_.termination.reason += ": more damping, modes or a lower speed may help";
  }
  return std::move(motion_);
}

}  // namespace

PeriodicMotion find_periodic_motion(const Model& model, const PeriodicMotionStudy& study,
                                    const ModelingSettings& settings,
                                    const std::function<bool()>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  PeriodicMotion motion;
  motion.termination = {Status::stopped, refusal_of(model, study)};
  if (motion.termination.reason.empty())
    motion = PeriodicSearch(model, study, settings, keep_going).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  motion.seconds = took.count();
  return motion;
}

}  // namespace flexura

#include "flexura/studies/turn_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/solvers/radau.hpp"

namespace flexura {
namespace {

using Integrator = Radau<MotionSystem, Moment, MotionFactor>;

/// Differences of turns are divided by `difference`: what Newton's method leaves must be small
/// beside it.
constexpr double most_left = 1e-10;
constexpr double difference = 1e-5;
/// How far a state may be from the one that steps were made for.
constexpr double near = 1e-3;

double orbit_newton_tolerance(double tolerance) { return std::min(1e-3 * tolerance, most_left); }

std::vector<Eigen::Index> rotations_of(const MotionSystem& system) {
  std::vector<Eigen::Index> places;
  const Numbering& numbering = system.numbering();
  for (const auto& body : numbering.bodies)
    if (body.rotation >= 0) places.push_back(body.rotation);
  for (const auto& member : numbering.members)
    for (const int section : {PortUnknown::base_section, PortUnknown::action_section})
      if (member.unknowns[static_cast<std::size_t>(section)] >= 0)
        places.push_back(member.unknowns[static_cast<std::size_t>(section)]);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

TurnMap::TurnMap(MotionSystem& system, const Moment& about, TurnSettings settings)
    : system_(system),
      settings_(std::move(settings)),
      free_state_(system, about, settings_.duration / (2.0 * std::numbers::pi)),
      rotations_(rotations_of(system)),
      multipliers_(about.multipliers) {}

/// By tolerance, through outputs and breaks; notes the steps.
bool TurnMap::march(Moment& moment) {
  const double duration = settings_.duration;
  const double interval = duration / settings_.outputs;
  const std::size_t most_steps = 5000 + 20 * static_cast<std::size_t>(settings_.outputs);
  std::vector<Step> goals;
  for (int k = 1; k <= settings_.outputs; ++k)
    goals.push_back({0.0, k == settings_.outputs ? duration : interval * k, false, true});
  for (const double at : settings_.breaks) goals.push_back({0.0, at, true, false});
  std::sort(goals.begin(), goals.end(), [](const Step& a, const Step& b) { return a.end < b.end; });
  Integrator integrator(system_,
                        {orbit_newton_tolerance(settings_.tolerance), settings_.tolerance});
  const double first = steps_.empty() ? 0.01 * interval : steps_.front().length;
  steps_.clear();
  TimeMarch<Integrator> march(integrator, {0.0, settings_.tolerance, first, 1e-12 * duration});
  const auto note = [&](double h) {
    steps_.push_back({h, moment.time, false, false});
    return steps_.size() < most_steps;
  };
  bool through = true;
  for (const Step& goal : goals) {
    if (goal.end - moment.time > 1e-12 * duration) {
      through = march.advance(moment, goal.end, note);
      if (!through) break;
    }
    moment.time = goal.end;
    if (steps_.empty()) continue;  // a break right at the start
    Step& last = steps_.back();
    last.end = goal.end;
    last.is_output = last.is_output || goal.is_output;
    last.breaks = last.breaks || goal.breaks;
    if (goal.breaks) march.restart(false);
  }
  counts_.steps += march.counts().steps;
  counts_.rejected += march.counts().rejected;
  counts_.iterations += march.counts().iterations;
  return through;
}

/// In the steps that were noted.
bool TurnMap::repeat(Moment& moment, std::vector<Moment>* moments) {
  Integrator integrator(system_, {orbit_newton_tolerance(settings_.tolerance), 0.0});
  MotionFactor<double> factor;
  for (const Step& step : steps_) {
    const StepReport report = integrator.step(moment, step.length);
    counts_.iterations += report.iterations;
    if (report.outcome != StepOutcome::accepted) return false;
    ++counts_.steps;
    moment.time = step.end;
    if (moments && step.is_output) {
      moments->push_back(moment);
      if (!project_rates(system_, moments->back(), step.length, factor)) return false;
    }
    if (step.breaks) integrator.restart(false);
  }
  return true;
}

/// The free state at the end, with windings taken off.
bool TurnMap::close_turn(const Moment& start, Moment& end, Eigen::VectorXd& x) {
  MotionFactor<double> factor;
  if (!project_rates(system_, end, steps_.back().length, factor)) return false;
  for (const Eigen::Index i : rotations_) {
    const double windings = std::round((end.q[i] - start.q[i]) / (2.0 * std::numbers::pi));
    end.q[i] -= 2.0 * std::numbers::pi * windings;
  }
  x = free_state_.reduce(end);
  return x.allFinite();
}

bool TurnMap::turn(const Eigen::VectorXd& x, Eigen::VectorXd& end) {
  Moment start = system_.drawn_moment();
  start.multipliers = multipliers_;
  failed_at_ = 0.0;
  if (!free_state_.restore(x, start)) return false;
  Moment moment = start;
  const bool keeps_steps = !steps_.empty() && (x - stepped_for_).norm() < near;
  bool through = keeps_steps && repeat(moment, nullptr);
  if (!through) {
    moment = start;
    through = march(moment);
    stepped_for_ = x;
    if (!through) steps_.clear();
  }
  failed_at_ = moment.time;
  if (!through || !close_turn(start, moment, end)) return false;
  multipliers_ = moment.multipliers;
  at_ = x;
  end_ = end;
  return true;
}

bool TurnMap::flow(const Eigen::VectorXd& direction, Eigen::VectorXd& image) {
  Moment start = system_.drawn_moment();
  start.multipliers = multipliers_;
  if (!free_state_.restore(at_ + difference * direction, start)) return false;
  Moment moment = start;
  if (!repeat(moment, nullptr) || !close_turn(start, moment, image)) return false;
  image = (image - end_) / difference;
  return true;
}

bool TurnMap::record(std::vector<Moment>& moments) {
  Moment start = system_.drawn_moment();
  start.multipliers = multipliers_;
  if (!free_state_.restore(at_, start)) return false;
  moments = {start};
  Moment moment = start;
  if (!repeat(moment, &moments)) return false;
  // a step's end knows accelerations and forces, the start of a turn does not
  moments.front().a = moments.back().a;
  moments.front().multipliers = moments.back().multipliers;
  return true;
}

}  // namespace flexura

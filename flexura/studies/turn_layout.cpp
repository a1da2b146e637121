#include "flexura/studies/turn_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/modelings/make_motion.hpp"
#include "flexura/studies/prescribed.hpp"

namespace flexura {
namespace {

double period_of(double speed) { return 2.0 * std::numbers::pi / std::abs(speed); }

/// The same course in another time.
TimeHistory paced(const TimeHistory& history, double pace) {
  if (pace == 1.0 || is_constant(history)) return history;
  return FunctionHistory{
      [history, pace](double time) { return evaluate_history(history, pace * time).value; }};
}

/// Sampled where nothing better is known; of the largest value met.
bool repeats(const TimeHistory& history, double period, double until) {
  constexpr int samples = 257;
  double largest = 0.0, apart = 0.0;
  for (int k = 0; k <= samples; ++k) {
    const double time = period * k / samples;
    if (k > 0 && time + period > until * (1.0 + 1e-12)) break;
    const double now = evaluate_history(history, time).value;
    const double later = evaluate_history(history, std::min(time + period, until)).value;
    largest = std::max({largest, std::abs(now), std::abs(later)});
    apart = std::max(apart, std::abs(later - now));
  }
  return apart <= 1e-9 * largest;
}

struct BreakOfPeriod {
  double period;

  std::string operator()(const StepHistory& step) const {
    if (step.at <= 0.0 || step.at >= period) return {};
    return "is there for the rest of time once it has come";
  }
  std::string operator()(const RampHistory& ramp) const {
    if (ramp.end <= 0.0 || ramp.start >= period) return {};
    return "does not come back to where it began";
  }
  std::string operator()(const HalfSineHistory& pulse) const {
    if (pulse.start >= 0.0 && pulse.start + pulse.duration <= period * (1.0 + 1e-12)) return {};
    return "is a pulse that does not lie within a turn";
  }
  std::string operator()(const HarmonicHistory& harmonic) const {
    const double waves = harmonic.angular_frequency * period / (2.0 * std::numbers::pi);
    if (std::abs(waves - std::round(waves)) <= 1e-9 * std::max(1.0, std::abs(waves))) return {};
    return fmt::format("has {:.6g} waves in a turn", waves);
  }
  std::string operator()(const LinearHistory&) const { return "grows with time"; }
  std::string operator()(const TableHistory& table) const {
    const TimeHistory history = table;
    if (table.times().empty() || table.times().back() < period * (1.0 - 1e-12))
      return "is not known for a whole turn";
    if (repeats(history, period, table.times().back())) return {};
    return "does not repeat itself after a turn";
  }
  std::string operator()(const FunctionHistory& function) const {
    if (repeats(function, period, INFINITY)) return {};
    return "does not repeat itself after a turn";
  }
};

std::string refusal_of_histories(const Model& model, const PeriodicMotionStudy& study) {
  const double period = period_of(study.speed);
  for (std::size_t i = 0; i < study.loads.size(); ++i)
    if (const std::string why = break_of_period(study.loads[i].history, period); !why.empty())
      return fmt::format("the history of load {} {}: no motion repeats itself under it", i + 1,
                         why);
  for (std::size_t i = 0; i < model.drivers.size(); ++i) {
    const Driver& driver = model.drivers[i];
    if (i == study.driver || driver.amount == 0.0) continue;
    if (const std::string why = break_of_period(driver.history, period); !why.empty())
      return fmt::format("what driver {} imposes {}: no motion repeats itself under it",
                         driver.name, why);
  }
  return {};
}

}  // namespace

std::string break_of_period(const TimeHistory& history, double period) {
  return std::visit(BreakOfPeriod{period}, history);
}

std::string refusal_of(const Model& model, const PeriodicMotionStudy& study) {
  if (study.driver >= model.drivers.size() || model.drivers[study.driver].direction)
    return "a periodic motion wants a driver that turns a body";
  if (!(std::abs(study.speed) > 0.0) || !std::isfinite(study.speed))
    return "a periodic motion wants a speed that is not zero";
  if (study.outputs < 1 || !(study.tolerance > 0.0) || !(study.miss > 0.0))
    return "outputs and tolerances have to be positive";
  if (study.damping.modal != 0.0)
    return "modal damping belongs to a state, and a turning mechanism leaves it: take Rayleigh's";
  return refusal_of_histories(model, study);
}

TurnLayout::TurnLayout(const Model& model, const PeriodicMotionStudy& study,
                       const ModelingSettings& settings)
    : model_(model),
      driver_(study.driver),
      speed_(study.speed),
      loaded_(make_motion_layout(model, {study.loads, study.fields, study.damping}, settings,
                                 study.inertia)) {
  model_.drivers[driver_].history = LinearHistory{};
}

MotionLayout TurnLayout::at(double speed) const {
  const double pace = speed / speed_;
  Model model = model_;
  for (std::size_t i = 0; i < model.drivers.size(); ++i)
    if (i != driver_) model.drivers[i].history = paced(model.drivers[i].history, pace);
  model.drivers[driver_].amount = speed;
  MotionLayout layout = loaded_;
  for (TimeHistory& history : layout.loads) history = paced(history, pace);
  add_prescribed(layout, model, with_drivers(model, {}));
  return layout;
}

std::vector<double> TurnLayout::breaks(double speed) const {
  const double period = period_of(speed_);
  std::vector<double> times;
  const auto add = [&](const TimeHistory& history) {
    const auto own = history_breaks(history, 0.0, period);
    if (own.size() > most_breaks) return;
    for (const double at : own) times.push_back(at * speed_ / speed);
  };
  for (const TimeHistory& history : loaded_.loads) add(history);
  for (std::size_t i = 0; i < model_.drivers.size(); ++i)
    if (i != driver_) add(model_.drivers[i].history);
  return times;
}

}  // namespace flexura

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// Each history for itself.
struct HistoryRules {
  const KeyPath path;
  Mistakes& mistakes;

  void operator()(const StepHistory& step) const {
    mistakes.require_finite(path / "step", step.at);
  }
  void operator()(const RampHistory& ramp) const {
    mistakes.require_finite(path / "ramp" / 0, ramp.start);
    mistakes.require_finite(path / "ramp" / 1, ramp.end);
    if (ramp.end <= ramp.start)
      mistakes.add(path / "ramp" / 1, fmt::format("a ramp must end after it starts: {} is no later "
                                                  "than {}",
                                                  ramp.end, ramp.start));
  }
  void operator()(const HalfSineHistory& pulse) const {
    mistakes.require_finite(path / "half_sine" / "start", pulse.start);
    mistakes.require_positive(path / "half_sine" / "duration", pulse.duration);
  }
  void operator()(const HarmonicHistory& harmonic) const {
    mistakes.require_positive(path / "harmonic" / "frequency",
                              harmonic.angular_frequency / (2.0 * std::numbers::pi));
    mistakes.require_finite(path / "harmonic" / "phase", harmonic.phase);
  }
  void operator()(const LinearHistory&) const {}
  void operator()(const TableHistory& table) const {
    const auto& times = table.times();
    const KeyPath rows = path / "table";
    if (times.size() != table.values().size() || times.size() < 2) {
      mistakes.add(rows, fmt::format("a table needs two rows or more, has {}", times.size()));
      return;
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      mistakes.require_finite(rows / i, Vec2{times[i], table.values()[i]});
      if (i > 0 && times[i] <= times[i - 1]) {
        mistakes.add(rows / i, fmt::format("times must ascend: {} does not come after {}", times[i],
                                           times[i - 1]));
        return;
      }
    }
  }
  void operator()(const FunctionHistory& history) const {
    if (!history.function) mistakes.add(path, "there is no function");
  }
};

}  // namespace

void check_history(const TimeHistory& history, const KeyPath& path, Mistakes& mistakes) {
  std::visit(HistoryRules{path, mistakes}, history);
}

void check_history_during(const TimeHistory& history, double duration, const std::string& study,
                          const KeyPath& path, Mistakes& mistakes) {
  if (const auto* table = std::get_if<TableHistory>(&history); table && table->times().size() > 1) {
    const double first = table->times().front();
    const double last = table->times().back();
    if (first > 0.0)
      mistakes.add(path,
                   fmt::format("the table begins at time {}, after {} does at 0", first, study));
    if (last < duration)
      mistakes.add(path, fmt::format("the table ends at time {}, before {} does at {}", last, study,
                                     duration));
  }
  const auto* other = std::get_if<FunctionHistory>(&history);
  if (!other || !other->function) return;
  constexpr int samples = 64;  // enough to meet a range that was forgotten
  for (int i = 0; i <= samples; ++i) {
    const double time = duration * i / samples;
    const double value = other->function(time);
    if (std::isfinite(value)) continue;
    mistakes.add(path, fmt::format("at time {} of {} this is {}", time, study,
                                   std::isnan(value) ? "not a number" : "infinite"));
    return;
  }
}

}  // namespace flexura

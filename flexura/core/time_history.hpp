#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace flexura {

/// A function of time with its first two derivatives; where these jump, those from then on.
struct HistoryValue {
  double value = 0.0;
  double rate = 0.0;
  double second = 0.0;
};

/// Zero before `at`, one from then on.
struct StepHistory {
  double at = 0.0;
};

/// From zero at `start` to one at `end`; `smooth`: with the quintic whose first two derivatives
/// vanish at both.
struct RampHistory {
  double start = 0.0;
  double end = 0.0;
  bool smooth = false;
};

/// sin(pi (t - start)/duration) while it is positive the first time, else zero.
struct HalfSineHistory {
  double start = 0.0;
  double duration = 0.0;
};

/// sin(angular_frequency t + phase).
struct HarmonicHistory {
  double angular_frequency = 0.0;
  double phase = 0.0;
};

/// t itself, in time units: what moves at constant speed.
struct LinearHistory {};

/// Values at ascending times, joined by straight lines or, `smooth`, by the natural cubic spline
/// through them. Nothing is known outside.
class TableHistory {
 public:
  TableHistory() = default;
  TableHistory(std::vector<double> times, std::vector<double> values, bool smooth);

  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& values() const { return values_; }
  bool smooth() const { return smooth_; }
  HistoryValue at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<double> values_;
  std::vector<double> seconds_;  // derivatives of the spline, where there is one
  bool smooth_ = false;
};

/// Any other function; its derivatives are taken by differences.
struct FunctionHistory {
  std::function<double(double)> function;
};

/// How something comes and goes in time: a factor on a load, or on an imposed displacement.
using TimeHistory = std::variant<StepHistory, RampHistory, HalfSineHistory, HarmonicHistory,
                                 LinearHistory, TableHistory, FunctionHistory>;

/// One from time 0 on.
bool is_constant(const TimeHistory& history);

HistoryValue evaluate_history(const TimeHistory& history, double time);

/// Of one history: more of them are no jumps or kinks, but samples.
inline constexpr std::size_t most_breaks = 200;

/// Times within (from, to) at which the history or its first derivative jumps, ascending: time
/// steps should end there.
std::vector<double> history_breaks(const TimeHistory& history, double from, double to);

/// In words, for readers: "from time 0.5 on". Nothing of what is there from the start.
std::string describe_history(const TimeHistory& history);

/// Up to which time the history is known; infinite but for tables.
double history_end(const TimeHistory& history);

}  // namespace flexura

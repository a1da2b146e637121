#include "flexura/core/time_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexura {
namespace {

/// Second derivatives at the times of the natural cubic spline (zero at both ends): the usual
/// tridiagonal system, solved without pivoting as it is diagonally dominant.
std::vector<double> spline_seconds(const std::vector<double>& t, const std::vector<double>& v) {
  const std::size_t n = t.size();
  std::vector<double> seconds(n, 0.0), diagonal(n, 1.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1];
    const double after = t[i + 1] - t[i];
    const double share = i > 1 ? before / diagonal[i - 1] : 0.0;
    diagonal[i] = 2.0 * (before + after) - share * (i > 1 ? before : 0.0);
    seconds[i] = 6.0 * ((v[i + 1] - v[i]) / after - (v[i] - v[i - 1]) / before) -
                 share * (i > 1 ? seconds[i - 1] : 0.0);
  }
  for (std::size_t i = n - 1; i-- > 1;)
    seconds[i] = (seconds[i] - (t[i + 1] - t[i]) * seconds[i + 1]) / diagonal[i];
  return seconds;
}

struct Evaluate {
  double t;

  HistoryValue operator()(const StepHistory& step) const {
    return {t >= step.at ? 1.0 : 0.0, 0.0, 0.0};
  }
  HistoryValue operator()(const RampHistory& ramp) const {
    if (t < ramp.start) return {};
    if (t >= ramp.end) return {1.0, 0.0, 0.0};
    const double h = ramp.end - ramp.start;
    const double x = (t - ramp.start) / h;
    if (!ramp.smooth) return {x, 1.0 / h, 0.0};
    return {x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), 30.0 * x * x * (1.0 - x) * (1.0 - x) / h,
            60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / (h * h)};
  }
  HistoryValue operator()(const HalfSineHistory& pulse) const {
    if (t < pulse.start || t >= pulse.start + pulse.duration) return {};
    const double w = M_PI / pulse.duration;
    const double angle = w * (t - pulse.start);
    return {std::sin(angle), w * std::cos(angle), -w * w * std::sin(angle)};
  }
  HistoryValue operator()(const HarmonicHistory& harmonic) const {
    const double w = harmonic.angular_frequency;
    const double angle = w * t + harmonic.phase;
    return {std::sin(angle), w * std::cos(angle), -w * w * std::sin(angle)};
  }
  HistoryValue operator()(const LinearHistory&) const { return {t, 1.0, 0.0}; }
  HistoryValue operator()(const TableHistory& table) const { return table.at(t); }
  HistoryValue operator()(const FunctionHistory& history) const {
    // central differences of fourth order; steps that balance their error with rounding
    const double scale = std::max(std::abs(t), 1e-3);
    const double h = 1e-3 * scale;
    const double k = 4e-3 * scale;
    const auto& f = history.function;
    const double value = f(t);
    return {value, (8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h),
            (16.0 * (f(t + k) + f(t - k)) - (f(t + 2.0 * k) + f(t - 2.0 * k)) - 30.0 * value) /
                (12.0 * k * k)};
  }
};

struct Describe {
  std::string operator()(const StepHistory& step) const {
    return step.at <= 0.0 ? std::string() : fmt::format("from time {:.6g} on", step.at);
  }
  std::string operator()(const RampHistory& ramp) const {
    return fmt::format("rising{} from time {:.6g} to {:.6g}", ramp.smooth ? " smoothly" : "",
                       ramp.start, ramp.end);
  }
  std::string operator()(const HalfSineHistory& pulse) const {
    return fmt::format("half a sine of duration {:.6g} from time {:.6g} on", pulse.duration,
                       pulse.start);
  }
  std::string operator()(const HarmonicHistory& harmonic) const {
    return fmt::format("as a sine of frequency {:.6g}", harmonic.angular_frequency / (2.0 * M_PI));
  }
  std::string operator()(const LinearHistory&) const { return "growing with time"; }
  std::string operator()(const TableHistory& table) const {
    return fmt::format("by a table of {} times", table.times().size());
  }
  std::string operator()(const FunctionHistory&) const { return "as a function of time"; }
};

struct Breaks {
  std::vector<double> operator()(const StepHistory& step) const { return {step.at}; }
  std::vector<double> operator()(const RampHistory& ramp) const { return {ramp.start, ramp.end}; }
  std::vector<double> operator()(const HalfSineHistory& pulse) const {
    return {pulse.start, pulse.start + pulse.duration};
  }
  std::vector<double> operator()(const HarmonicHistory&) const { return {}; }
  std::vector<double> operator()(const LinearHistory&) const { return {}; }
  std::vector<double> operator()(const TableHistory& table) const {
    return table.smooth() ? std::vector<double>{} : table.times();
  }
  std::vector<double> operator()(const FunctionHistory&) const { return {}; }
};

}  // namespace

/// Tables that are none have no spline: whoever checks the model says so.
TableHistory::TableHistory(std::vector<double> times, std::vector<double> values, bool smooth)
    : times_(std::move(times)), values_(std::move(values)), smooth_(smooth) {
  if (smooth && times_.size() > 1 && times_.size() == values_.size())
    seconds_ = spline_seconds(times_, values_);
}

HistoryValue TableHistory::at(double time) const {
  const auto& t = times_;
  if (t.empty()) return {};
  if (t.size() == 1) return {values_.front(), 0.0, 0.0};
  const auto above = std::upper_bound(t.begin() + 1, t.end() - 1, time);
  const auto k = static_cast<std::size_t>(above - t.begin()) - 1;
  const double h = t[k + 1] - t[k];
  const double x = std::clamp(time, t.front(), t.back()) - t[k];
  const double slope = (values_[k + 1] - values_[k]) / h;
  const auto& m = seconds_;
  if (m.empty()) return {values_[k] + x * slope, slope, 0.0};
  const double change = (m[k + 1] - m[k]) / h;
  const double start = slope - h * (2.0 * m[k] + m[k + 1]) / 6.0;
  return {values_[k] + x * (start + x * (0.5 * m[k] + x * change / 6.0)),
          start + x * (m[k] + 0.5 * x * change), m[k] + x * change};
}

std::string describe_history(const TimeHistory& history) { return std::visit(Describe{}, history); }

bool is_constant(const TimeHistory& history) {
  const auto* step = std::get_if<StepHistory>(&history);
  return step && step->at <= 0.0;
}

HistoryValue evaluate_history(const TimeHistory& history, double time) {
  return std::visit(Evaluate{time}, history);
}

std::vector<double> history_breaks(const TimeHistory& history, double from, double to) {
  std::vector<double> breaks = std::visit(Breaks{}, history);
  std::erase_if(breaks, [&](double t) { return t <= from || t >= to; });
  return breaks;
}

double history_end(const TimeHistory& history) {
  const auto* table = std::get_if<TableHistory>(&history);
  return table && !table->times().empty() ? table->times().back()
                                          : std::numeric_limits<double>::infinity();
}

}  // namespace flexura

#include "flexura/results/safety.hpp"

#include <algorithm>

namespace flexura {
namespace {

using Strengths = std::vector<std::optional<double>>;

/// A state, and where on the way it is: load factor or time.
struct Stop {
  double at = 0.0;
  const PathState* state = nullptr;
};
using Way = std::vector<Stop>;

/// Lagrange's polynomial through up to four states around an interval of the way.
class Interpolation {
 public:
  /// Between stops end - 1 and end.
  Interpolation(const Way& way, std::size_t end)
      : way_(way), first_(end >= 2 ? end - 2 : 0), end_(end) {
    const std::size_t last = std::min(end + 1, way.size() - 1);
    for (std::size_t i = first_; i <= last; ++i) times_.push_back(way[i].at);
    // A load that turns back is no measure of the way: the states are counted then.
    const bool grows = std::ranges::is_sorted(times_, std::ranges::less_equal{});
    const bool falls = std::ranges::is_sorted(times_, std::ranges::greater_equal{});
    if (grows || falls) return;
    for (std::size_t i = 0; i < times_.size(); ++i) times_[i] = static_cast<double>(i);
  }

  double begin_time() const { return times_[end_ - 1 - first_]; }
  double end_time() const { return times_[end_ - first_]; }

  template <class Value>
  auto at(double time, Value value) const {
    decltype(value(way_[0])) sum{};
    for (std::size_t i = 0; i < times_.size(); ++i)
      sum = sum + weight(i, time) * value(way_[first_ + i]);
    return sum;
  }

 private:
  double weight(std::size_t i, double time) const {
    double weight = 1.0;
    for (std::size_t k = 0; k < times_.size(); ++k)
      if (k != i) weight *= (time - times_[k]) / (times_[i] - times_[k]);
    return weight;
  }

  const Way& way_;
  std::size_t first_;
  std::size_t end_;
  std::vector<double> times_;
};

bool reaches(const PathState& state, std::size_t flexure, double strength) {
  return state.peak_stresses[flexure] >= strength;
}

/// When the stress of a flexure, below its strength at the interval's start, comes up to it; as a
/// share of the interval.
double share_until(const Interpolation& way, std::size_t flexure, double strength) {
  const double begin = way.begin_time();
  const double step = way.end_time() - begin;
  double below = 0.0;
  double above = 1.0;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (below + above);
    const double stress = way.at(begin + middle * step, [&](const Stop& stop) {
      return stop.state->peak_stresses[flexure];
    });
    (stress < strength ? below : above) = middle;
  }
  return above;
}

StrengthReached reached_at_start(std::size_t flexure, const Stop& start) {
  return {flexure, start.at, std::vector<Vec2>(start.state->points.size())};
}

std::optional<StrengthReached> find_reached(const Strengths& strengths, const Way& way) {
  const auto each_strength = [&](auto&& use) {
    for (std::size_t f = 0; f < strengths.size(); ++f)
      if (strengths[f]) use(f, *strengths[f]);
  };
  for (std::size_t i = 0; i < way.size(); ++i) {
    std::optional<std::size_t> flexure;
    double share = 1.0;
    each_strength([&](std::size_t f, double strength) {
      if (!reaches(*way[i].state, f, strength)) return;
      const double until = i == 0 ? 0.0 : share_until({way, i}, f, strength);
      if (flexure && until >= share) return;
      flexure = f;
      share = until;
    });
    if (!flexure) continue;
    if (i == 0) return reached_at_start(*flexure, way[0]);
    const Interpolation between(way, i);
    const double time = between.begin_time() + share * (between.end_time() - between.begin_time());
    StrengthReached reached{
        *flexure, between.at(time, [](const Stop& stop) { return stop.at; }), {}};
    for (std::size_t p = 0; p < way[0].state->points.size(); ++p) {
      reached.displacements.push_back(between.at(
          time, [&](const Stop& stop) { return stop.state->points[p] - way[0].state->points[p]; }));
    }
    return reached;
  }
  return {};
}

std::optional<Safety> safety_along(const Way& way, const Strengths& strengths) {
  const bool stated =
      std::ranges::any_of(strengths, [](const auto& strength) { return strength.has_value(); });
  if (!stated || way.empty()) return {};
  Safety safety;
  const PathState& last = *way.back().state;
  for (std::size_t f = 0; f < strengths.size(); ++f) {
    if (!strengths[f] || !(last.peak_stresses[f] > 0.0)) continue;
    const double factor = *strengths[f] / last.peak_stresses[f];
    if (safety.factor && factor >= *safety.factor) continue;
    safety.factor = factor;
    safety.flexure = f;
  }
  safety.reached = find_reached(strengths, way);
  return safety;
}

}  // namespace

std::optional<Safety> find_safety(const PathResult& path, const ModelingPath& modeling) {
  Way way;
  for (const PathState& state : modeling.states) way.push_back({state.load_factor, &state});
  return safety_along(way, path.strengths);
}

std::optional<Safety> find_safety(const MotionResult& motion, const ModelingMotion& modeling) {
  Way way;
  for (const MotionState& moment : modeling.states)
    // A modeling that knows no stresses has nothing to set against the strengths.
    if (!moment.state.peak_stresses.empty()) way.push_back({moment.time, &moment.state});
  return safety_along(way, motion.strengths);
}

std::optional<StressPeak> find_largest_stress(const ModelingMotion& modeling) {
  std::optional<StressPeak> peak;
  for (const MotionState& moment : modeling.states) {
    const std::vector<double>& stresses = moment.state.peak_stresses;
    for (std::size_t f = 0; f < stresses.size(); ++f)
      if (!peak || stresses[f] > peak->stress) peak = StressPeak{stresses[f], moment.time, f};
  }
  return peak;
}

}  // namespace flexura

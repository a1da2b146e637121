#include "flexura/results/safety.hpp"

#include <algorithm>

namespace flexura {
namespace {

/// Lagrange's polynomial through up to four states around an interval of the path.
class Interpolation {
 public:
  /// Between states end - 1 and end.
  Interpolation(const std::vector<PathState>& states, std::size_t end)
      : states_(states), first_(end >= 2 ? end - 2 : 0), end_(end) {
    const std::size_t last = std::min(end + 1, states.size() - 1);
    for (std::size_t i = first_; i <= last; ++i) times_.push_back(states[i].load_factor);
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
    decltype(value(states_[0])) sum{};
    for (std::size_t i = 0; i < times_.size(); ++i)
      sum = sum + weight(i, time) * value(states_[first_ + i]);
    return sum;
  }

 private:
  double weight(std::size_t i, double time) const {
    double weight = 1.0;
    for (std::size_t k = 0; k < times_.size(); ++k)
      if (k != i) weight *= (time - times_[k]) / (times_[i] - times_[k]);
    return weight;
  }

  const std::vector<PathState>& states_;
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
    const double stress =
        way.at(begin + middle * step, [&](const PathState& s) { return s.peak_stresses[flexure]; });
    (stress < strength ? below : above) = middle;
  }
  return above;
}

StrengthReached reached_at_start(std::size_t flexure, const PathState& start) {
  return {flexure, start.load_factor, std::vector<Vec2>(start.points.size())};
}

std::optional<StrengthReached> find_reached(const PathResult& path, const ModelingPath& modeling) {
  const std::vector<PathState>& states = modeling.states;
  const auto strengths = [&](auto&& use) {
    for (std::size_t f = 0; f < path.strengths.size(); ++f)
      if (path.strengths[f]) use(f, *path.strengths[f]);
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    std::optional<std::size_t> flexure;
    double share = 1.0;
    strengths([&](std::size_t f, double strength) {
      if (!reaches(states[i], f, strength)) return;
      const double until = i == 0 ? 0.0 : share_until({states, i}, f, strength);
      if (flexure && until >= share) return;
      flexure = f;
      share = until;
    });
    if (!flexure) continue;
    if (i == 0) return reached_at_start(*flexure, states[0]);
    const Interpolation way(states, i);
    const double time = way.begin_time() + share * (way.end_time() - way.begin_time());
    StrengthReached reached{
        *flexure, way.at(time, [](const PathState& s) { return s.load_factor; }), {}};
    for (std::size_t p = 0; p < path.points.size(); ++p) {
      reached.displacements.push_back(
          way.at(time, [&](const PathState& s) { return s.points[p] - states[0].points[p]; }));
    }
    return reached;
  }
  return {};
}

}  // namespace

std::optional<Safety> find_safety(const PathResult& path, const ModelingPath& modeling) {
  const bool stated = std::ranges::any_of(
      path.strengths, [](const auto& strength) { return strength.has_value(); });
  if (!stated || modeling.states.empty()) return {};
  Safety safety;
  const PathState& last = modeling.states.back();
  for (std::size_t f = 0; f < path.strengths.size(); ++f) {
    if (!path.strengths[f] || !(last.peak_stresses[f] > 0.0)) continue;
    const double factor = *path.strengths[f] / last.peak_stresses[f];
    if (safety.factor && factor >= *safety.factor) continue;
    safety.factor = factor;
    safety.flexure = f;
  }
  safety.reached = find_reached(path, modeling);
  return safety;
}

}  // namespace flexura

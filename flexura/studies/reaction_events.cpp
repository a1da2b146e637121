#include "flexura/studies/reaction_events.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flexura/solvers/hermite_predictor.hpp"
#include "flexura/solvers/newton.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/prescribed.hpp"

namespace flexura {
namespace {

/// The row of the one component that drives the mechanism.
std::optional<std::size_t> driving_component(const SystemLayout& layout) {
  std::optional<std::size_t> driving;
  for (std::size_t i = 0; i < layout.prescribed.size(); ++i) {
    if (layout.prescribed[i].value == 0.0) continue;
    if (driving) return {};
    driving = i;
  }
  return driving;
}

/// A point of the path between two output states, with the driving reaction and its slope.
struct DrivenState {
  CurvePoint at;
  double reaction = 0.0;
  double slope = 0.0;  // by the load factor
  int unstable = 0;
};

class ReactionSearch {
 public:
  ReactionSearch(System& system, std::size_t row)
      : system_(system), reaction_(system.reaction_index(row)) {}

  bool evaluate(double load_factor, std::vector<double> z, DrivenState& state) {
    system_.set_load_factor(load_factor);
    if (newton_.solve(system_, z).outcome != NewtonOutcome::converged || !system_.linearize(z))
      return false;
    state.at = {load_factor, std::move(z), {}};
    system_.load_direction(state.at.slope);
    state.reaction = state.at.value[reaction_];
    state.slope = state.at.slope[reaction_];
    state.unstable = system_.unstable_directions();
    return true;
  }

  /// The place between two states where `of` a state changes sign, by the Illinois method.
  template <class Of>
  std::optional<DrivenState> locate(DrivenState low, DrivenState high, Of of) {
    double at_low = of(low);
    double at_high = of(high);
    DrivenState best = std::abs(at_low) < std::abs(at_high) ? low : high;
    for (int k = 0; k < 60; ++k) {
      const double a = low.at.parameter;
      const double b = high.at.parameter;
      if (b - a < 1e-10 || of(best) == 0.0) return best;
      double middle = a + (b - a) * at_low / (at_low - at_high);
      if (k % 4 == 3) middle = 0.5 * (a + b);
      std::vector<double> z;
      extrapolate_hermite({low.at, high.at}, middle, z);
      DrivenState state;
      if (!evaluate(middle, std::move(z), state)) return best;
      const double value = of(state);
      if (std::abs(middle - best.at.parameter) < 1e-11) return state;
      best = state;
      const bool below = (value < 0.0) == (of(low) < 0.0);
      (below ? at_low : at_high) = value;
      (below ? at_high : at_low) *= 0.5;
      (below ? low : high) = std::move(state);
    }
    return best;
  }

 private:
  System& system_;
  std::size_t reaction_;
  Newton newton_{{1e-12, 30, 6}};
};

}  // namespace

std::vector<ReactionEvent> find_reaction_events(const Model& model, const PathStudy& study,
                                                const TracedPath& traced) {
  std::vector<ReactionEvent> events;
  if (!study.loads.empty() || traced.systems.empty()) return events;
  const auto row = driving_component(traced.systems.front()->layout());
  if (!row) return events;
  const double value = traced.systems.front()->layout().prescribed[*row].value;

  const auto record = [&](System& system, const DrivenState& state, ReactionEvent::Kind kind) {
    ReactionEvent event{kind, state.at.parameter, state.reaction, true, {}};
    if (kind == ReactionEvent::Kind::zero) event.reaction = 0.0;
    // let go, the driven displacement is one more direction to fall into
    event.stable = state.unstable == 0 && state.slope * value > 0.0;
    event.state = make_path_state(model, system, state.at.value, state.at.parameter);
    event.state.unstable_directions = state.unstable;
    event.state.reactions = reactions_in(system, study.prescribe, state.at.value);
    events.push_back(std::move(event));
  };

  for (std::size_t k = 0; k + 1 < traced.states.size(); ++k) {
    const TracedState& from = traced.states[k];
    const TracedState& to = traced.states[k + 1];
    if (to.load_factor <= from.load_factor) continue;  // snapping back
    System& system = *traced.systems[to.system];
    std::vector<double> z = from.z;
    for (std::size_t s = from.system; s < to.system; ++s)
      z = traced.systems[s]->prolong(z, *traced.systems[s + 1]);
    ReactionSearch search(system, *row);
    DrivenState low, high;
    if (!search.evaluate(from.load_factor, z, low) || !search.evaluate(to.load_factor, to.z, high))
      continue;
    const bool starts_at_zero = k == 0 && !system.needs_assembly();
    if (starts_at_zero) record(system, low, ReactionEvent::Kind::zero);
    const auto reaction_of = [](const DrivenState& state) { return state.reaction; };
    const auto slope_of = [](const DrivenState& state) { return state.slope; };
    std::optional<DrivenState> halt, zero;
    if (low.slope * high.slope < 0.0) halt = search.locate(low, high, slope_of);
    if (!starts_at_zero && low.reaction * high.reaction < 0.0)
      zero = search.locate(low, high, reaction_of);
    const bool zero_first = halt && zero && zero->at.parameter < halt->at.parameter;
    if (zero && zero_first) record(system, *zero, ReactionEvent::Kind::zero);
    if (halt) record(system, *halt, ReactionEvent::Kind::halt);
    if (zero && !zero_first) record(system, *zero, ReactionEvent::Kind::zero);
  }
  return events;
}

}  // namespace flexura

#include "flexura/studies/path_study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/studies/arc_tracer.hpp"
#include "flexura/studies/displacement_norm.hpp"
#include "flexura/studies/field_record.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/path_tracer.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/reaction_difference.hpp"
#include "flexura/studies/reaction_events.hpp"
#include "flexura/studies/stage_record.hpp"

namespace flexura {
namespace {

/// Of the flexures as drawn.
double mean_length(const PathState& start) {
  double sum = 0.0;
  for (const auto& axis : start.axes)
    for (std::size_t i = 1; i < axis.size(); ++i) sum += norm(axis[i] - axis[i - 1]);
  return start.axes.empty() ? 0.0 : sum / static_cast<double>(start.axes.size());
}

/// Largest displacement of every point over the path.
std::vector<double> largest_displacements(const std::vector<PathState>& states) {
  LargestDisplacements largest(states.front());
  for (const PathState& state : states) largest.add(state);
  return largest.values();
}

/// Absent where any state but the first has no estimate.
std::optional<double> relative_error(const TracedPath& traced,
                                     const std::vector<PathState>& states) {
  const std::vector<double> size = largest_displacements(states);
  const double noise = displacement_rounding(states.front());
  if (traced.states.size() < 2) return {};
  double worst = 0.0;
  for (const TracedState& state : traced.states) {
    if (state.errors.empty()) return {};
    worst = std::max(worst, state.reaction_error);
    for (std::size_t p = 0; p < state.errors.size(); ++p)
      if (state.errors[p] > noise) worst = std::max(worst, state.errors[p] / size[p]);
  }
  return worst;
}

/// Where a path followed by arc length turns back, and where it passes without load.
std::vector<ReactionEvent> load_events(const Model& model, const TracedPath& traced) {
  std::vector<ReactionEvent> events;
  const auto add = [&](ReactionEvent::Kind kind, const auto& at) {
    ReactionEvent event{kind, at.load_factor, 0.0, at.unstable_directions == 0,
                        make_path_state(model, *traced.systems[at.system], at.z, at.load_factor)};
    event.state.unstable_directions = at.unstable_directions;
    events.push_back(std::move(event));
  };
  if (!traced.states.empty()) add(ReactionEvent::Kind::zero, traced.states.front());
  for (const TracedEvent& event : traced.events) {
    if (event.kind == "limit point") add(ReactionEvent::Kind::halt, event);
    if (event.kind == "zero load") add(ReactionEvent::Kind::zero, event);
  }
  return events;
}

}  // namespace

ModelingPath run_path(const Model& model, const PathStudy& study, const ModelingSettings& settings,
                      const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  const TracedPath traced =
      study.arc_length ? trace_by_arc_length(model, study, settings, keep_going)
                       : trace_path(model, study.loads, settings,
                                    {study.steps, study.estimate || chooses_modes(settings),
                                     keep_going, study.prescribe, study.fields});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;

  ModelingPath path;
  path.label = settings.label;
  path.modeling = modeling_name(settings);
  path.termination = traced.termination;
  path.steps = traced.steps;
  path.iterations = traced.iterations;
  path.seconds = took.count();
  path.unknowns = static_cast<int>(traced.systems.back()->modeled_size());
  for (const TracedState& s : traced.states) {
    System& system = *traced.systems[s.system];
    system.set_load_factor(s.load_factor);
    path.states.push_back(make_path_state(model, system, s.z, s.load_factor));
    path.states.back().unstable_directions = s.unstable_directions;
    path.states.back().reactions = reactions_in(system, study.prescribe, s.z);
    if (system.linearize(s.z)) path.states.back().strain_energy = system.strain_energy();
  }
  for (const TracedEvent& event : traced.events) {
    if (event.kind == "zero load") continue;
    path.events.push_back(
        {event.kind, event.load_factor,
         make_path_state(model, *traced.systems[event.system], event.z, event.load_factor)});
    path.events.back().state.unstable_directions = event.unstable_directions;
    path.events.back().state.reactions =
        reactions_in(*traced.systems[event.system], study.prescribe, event.z);
  }
  if (!traced.states.empty()) {
    const TracedState& last = traced.states.back();
    path.members = make_members(model, *traced.systems[last.system], last.z);
    path.error_estimate = relative_error(traced, path.states);
  }
  add_fields(model, study, traced, path);
  add_stage_records(model, study, traced, path);
  path.reaction_events = study.arc_length && study.prescribe.empty()
                             ? load_events(model, traced)
                             : find_reaction_events(model, study, traced);
  return path;
}

/// By arc length every modeling takes steps of its own: landmarks that both pass are compared,
/// those of the same kind in their order, and the end, unless it lies somewhere behind a landmark.
std::optional<double> landmark_difference(const ModelingPath& path, const ModelingPath& reference,
                                          const std::vector<double>& size) {
  std::optional<double> worst;
  const auto compare = [&](const PathState& a, const PathState& b) {
    const std::vector<Vec2> here = points_of(a);
    const std::vector<Vec2> there = points_of(b);
    for (std::size_t p = 0; p < here.size(); ++p)
      worst = std::max(worst.value_or(0.0), norm(here[p] - there[p]) / size[p]);
  };
  for (const char* kind : {"limit point", "bifurcation"}) {
    std::size_t next = 0;
    for (const PathEvent& event : path.events) {
      if (event.kind != kind) continue;
      while (next < reference.events.size() && reference.events[next].kind != kind) ++next;
      if (next == reference.events.size()) break;
      compare(event.state, reference.events[next++].state);
    }
  }
  const PathState& here = path.states.back();
  const PathState& there = reference.states.back();
  if (path.termination.converged() && reference.termination.converged() &&
      std::abs(here.load_factor - there.load_factor) <= 1e-9)
    compare(here, there);
  return worst;
}

void compare_with_reference(PathResult& result) {
  const ModelingPath& reference = result.modelings[result.reference];
  if (reference.states.empty()) return;
  const std::vector<double> size = largest_displacements(reference.states);
  const double noise = displacement_rounding(reference.states.front());
  const double length = mean_length(reference.states.front());
  for (std::size_t m = 0; m < result.modelings.size(); ++m) {
    ModelingPath& path = result.modelings[m];
    const std::size_t states = std::min(path.states.size(), reference.states.size());
    if (m == result.reference || states < 2) continue;  // the start alone says nothing
    if (result.by_arc_length) {
      path.difference = landmark_difference(path, reference, size);
      continue;
    }
    double worst = reaction_difference(path, reference, length);
    for (std::size_t k = 0; k < states; ++k)
      worst = std::max(worst, relative_distance(path.states[k], reference.states[k], size, noise));
    path.difference = worst;
  }
}

}  // namespace flexura

#include "robustness/verdict.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexura/model/validation.hpp"
#include "flexura/solvers/continuation.hpp"
#include "flexura/solvers/load_stepping.hpp"
#include "flexura/studies/path_tracer.hpp"
#include "flexura/studies/run_studies.hpp"
#include "robustness/comparison.hpp"

namespace flexura::robustness {
namespace {

/// What is left to correct in a state; infinite where it cannot be linearized.
double remaining_step(System& system, double load_factor, const std::vector<double>& z) {
  system.set_load_factor(load_factor);
  std::vector<double> step;
  return system.linearize(z) ? system.newton_step(step) : INFINITY;
}

void fail(Verdict& verdict, const char* category, std::string reason) {
  verdict.category = category;
  verdict.reason = std::move(reason);
}

void judge_state(const TracedPath& path, Verdict::End end, Verdict& verdict) {
  verdict.end = end;
  const TracedState& last = path.states.back();
  verdict.load_factor = last.load_factor;
  verdict.unstable = last.unstable_directions > 0;
  const double left = remaining_step(*path.systems[last.system], last.load_factor, last.z);
  if (!(left < 1e-6)) return fail(verdict, "no equilibrium", fmt::format("{:.2g} is left", left));
  verdict.correct = true;
}

/// The last state before an event, in unknowns of the event's system.
std::vector<double> state_before(const TracedPath& path, const TracedEvent& event) {
  std::vector<double> z = path.states.back().z;
  for (std::size_t k = path.states.back().system; k < event.system; ++k)
    z = path.systems[k]->prolong(z, *path.systems[k + 1]);
  return z;
}

/// Follows the path by arc length from before a limit point to beyond it. Empty if the load factor
/// turns back where it was said to and the path goes on; else what happens instead.
std::string pass_limit_point(const TracedPath& path, const TracedEvent& event, double tolerance,
                             double longest_step) {
  System& system = *path.systems[event.system];
  Continuation<System> arc(
      system, {algebraic_tolerance(tolerance), longest_step, 1e-11, 10.0 * longest_step});
  const double start = path.states.back().load_factor;
  std::vector<double> z = state_before(path, event);
  system.set_load_factor(start);
  if (Newton newton({1e-11, 30, 6});
      newton.solve(system, z).outcome != NewtonOutcome::converged || !arc.start(start, z))
    return "no start before it";
  bool found = false;
  for (int k = 0, beyond = 0; k < 20000 && beyond < 2; ++k) {
    const double before = arc.state().load_factor;
    if (!arc.advance())
      return fmt::format("arc length stops at load factor {:.8g}", arc.state().load_factor);
    if (found && arc.state().load_factor >= before) return "the load factor does not turn back";
    beyond += found ? 1 : 0;
    for (const LocatedFeature& feature : arc.features()) {
      if (feature.feature != PathFeature::limit_point || found) continue;
      const double at = feature.state.load_factor;
      if (std::abs(at - event.load_factor) > 1e-6 * std::abs(event.load_factor))
        return fmt::format("by arc length it is at {:.10g}", at);
      found = true;
    }
  }
  return found ? std::string() : "none is found";
}

/// A claim is true where a continuation from the last state before passes the same point. Loops of
/// a path may be smaller than any step chosen beforehand, so steps get shorter until it does.
void judge_limit_point(const TracedPath& path, const TracedEvent& event, double tolerance,
                       Verdict& verdict) {
  verdict.end = Verdict::End::limit_point;
  verdict.load_factor = event.load_factor;
  verdict.unstable = path.states.back().unstable_directions > 0;
  std::string found;
  for (const double longest_step : {2e-2, 2e-3, 2e-4, 2e-5}) {
    found = pass_limit_point(path, event, tolerance, longest_step);
    verdict.correct = found.empty();
    if (verdict.correct) return;
  }
  fail(verdict, "limit point not confirmed",
       fmt::format("claimed at {:.10g}: {}", event.load_factor, found));
}

/// The path says that flexures wind up, and they do.
bool is_wound_up(const TracedPath& path) {
  if (path.termination.reason.find("winds up") == std::string::npos) return false;
  const TracedState& last = path.states.back();
  return path.systems[last.system]->largest_turn(last.z) > wound_up_turn;
}

const TracedEvent* limit_point_of(const TracedPath& path) {
  const auto at = std::find_if(path.events.begin(), path.events.end(),
                               [](const auto& event) { return event.kind == "limit point"; });
  return at == path.events.end() ? nullptr : &*at;
}

}  // namespace

Verdict judge(const RandomMechanism& mechanism, const JudgeOptions& options) {
  Verdict verdict;
  const Diagnostics mistakes = validate_model(mechanism.model);
  if (!mistakes.empty()) {
    fail(verdict, "invalid model", mistakes.front().message);
    return verdict;
  }
  const auto& study = std::get<PathStudy>(mechanism.model.studies.front().kind);
  const ModelingSettings& exact = study.modelings.front();
  const auto start = std::chrono::steady_clock::now();
  const TracedPath path = trace_path(mechanism.model, study.loads, exact, {study.steps});
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const TracedEvent* limit = limit_point_of(path);
  if (path.termination.converged()) {
    judge_state(path, Verdict::End::reached, verdict);
  } else if (limit != nullptr) {
    judge_limit_point(path, *limit, exact.tolerance, verdict);
  } else if (is_wound_up(path)) {
    judge_state(path, Verdict::End::wound_up, verdict);
  } else {
    if (!path.states.empty()) verdict.load_factor = path.states.back().load_factor;
    const bool singular = path.states.empty();
    fail(verdict, singular ? "singular start" : "lost", path.termination.reason);
  }
  if (options.compare && verdict.correct && verdict.end != Verdict::End::wound_up)
    compare_with_elements(mechanism, path, verdict);
  return verdict;
}

bool is_independent_of_threads(const RandomMechanism& mechanism) {
  Model model = mechanism.model;
  auto& study = std::get<PathStudy>(model.studies.front().kind);
  for (const int modes : {8, 12}) {
    ModelingSettings other = study.modelings.front();
    other.kind = ExactSettings{modes};
    other.label = fmt::format("modes_{}", modes);
    study.modelings.push_back(other);
  }
  const auto run = [&model](int threads) { return run_studies(model, {{}, {}, threads, {}}); };
  const Result one = run(1);
  const Result two = run(2);
  const auto& a = std::get<PathResult>(one.studies.front().content).modelings;
  const auto& b = std::get<PathResult>(two.studies.front().content).modelings;
  for (std::size_t m = 0; m < a.size(); ++m) {
    if (a[m].states.size() != b[m].states.size() || a[m].iterations != b[m].iterations ||
        a[m].termination.reason != b[m].termination.reason)
      return false;
    for (std::size_t k = 0; k < a[m].states.size(); ++k)
      if (a[m].states[k].bodies != b[m].states[k].bodies ||
          a[m].states[k].strain_energy != b[m].states[k].strain_energy)
        return false;
  }
  return true;
}

}  // namespace flexura::robustness

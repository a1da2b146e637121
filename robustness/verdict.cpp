#include "robustness/verdict.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexura/model/validation.hpp"
#include "flexura/solvers/continuation.hpp"
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

void judge_full_load(const TracedPath& path, Verdict& verdict) {
  verdict.end = Verdict::End::reached;
  const TracedState& last = path.states.back();
  verdict.load_factor = last.load_factor;
  verdict.unstable = last.unstable_directions > 0;
  const double left = remaining_step(*path.systems[last.system], last.load_factor, last.z);
  if (!(left < 1e-6)) return fail(verdict, "no equilibrium", fmt::format("{:.2g} is left", left));
  verdict.correct = true;
}

/// A claim is true where a continuation with short steps, from the last state before, finds the
/// load factor to turn back at the same place, and the path to go on beyond.
void judge_limit_point(const TracedPath& path, const TracedEvent& event, double tolerance,
                       Verdict& verdict) {
  verdict.end = Verdict::End::limit_point;
  verdict.load_factor = event.load_factor;
  const TracedState& last = path.states.back();
  verdict.unstable = last.unstable_directions > 0;
  System& system = *path.systems[event.system];
  Continuation<System> arc(system, {algebraic_tolerance(tolerance), 0.02, 1e-9});
  if (last.system != event.system || !arc.start(last.load_factor, last.z))
    return fail(verdict, "limit point not confirmed", "no start before it");
  bool found = false;
  int beyond = 0;
  for (int k = 0; k < 4000 && beyond < 5; ++k) {
    const double before = arc.state().load_factor;
    if (!arc.advance())
      return fail(verdict, found ? "limit point not passed" : "limit point not confirmed",
                  fmt::format("arc length stops at load factor {:.8g}, the limit point is said to "
                              "be at {:.8g}",
                              arc.state().load_factor, event.load_factor));
    if (found) {
      if (arc.state().load_factor >= before) break;
      ++beyond;
    }
    for (const LocatedFeature& feature : arc.features()) {
      if (feature.feature != PathFeature::limit_point || found) continue;
      const double apart = std::abs(feature.state.load_factor - event.load_factor);
      if (apart > 1e-6 * std::abs(event.load_factor))
        return fail(verdict, "limit point elsewhere",
                    fmt::format("{:.10g} by arc length, {:.10g} claimed", feature.state.load_factor,
                                event.load_factor));
      found = true;
    }
  }
  if (beyond < 2)
    return fail(verdict, "limit point not passed",
                fmt::format("the load factor does not turn back at {:.8g}", event.load_factor));
  verdict.correct = true;
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
    judge_full_load(path, verdict);
  } else if (limit != nullptr) {
    judge_limit_point(path, *limit, exact.tolerance, verdict);
  } else {
    if (!path.states.empty()) verdict.load_factor = path.states.back().load_factor;
    const bool singular = path.states.empty();
    fail(verdict, singular ? "singular start" : "lost", path.termination.reason);
  }
  if (options.compare && verdict.correct) compare_with_elements(mechanism, path, verdict);
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

// The compliant four-bar for 5 s under a step of 0.28 N, in one run: 16 two-node elements a link
// against `exact` and high-order elements of at least the same accuracy. Errors are those of the
// coupler's middle across, at 50 times, relative to its largest displacement. Two are told apart,
// as opposite signs would cancel by luck: that of the discretisation (against a converged one, both
// integrated tightly) and that of the time steps (against the same discretisation integrated
// tightly). Their sum may be a tenth more than what the two-node mesh is off by itself; of all
// integrators and step sizes that keep to this, each modeling takes the cheapest.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "flexura/studies/transient_study.hpp"
#include "tests/support/mechanism.hpp"

namespace {

using namespace flexura;
using Method = TransientStudy::Method;

const Model model = [] {
  testing::Mechanism frame = testing::portal_frame();
  frame.density(913.0);
  return frame.model();
}();

struct Integration {
  Method method = Method::radau;
  double step = 0.0;  ///< fixed; 0: by tolerance
  double tolerance = 1e-5;

  std::string name() const {
    if (method == Method::radau) return fmt::format("radau at {:.0e}", tolerance);
    return fmt::format("generalized-alpha, steps of {:.2e} s", step);
  }
};

ModelingSettings make_settings(ModelingSettings::Kind kind) {
  ModelingSettings settings;
  settings.kind = std::move(kind);
  return settings;
}

ModelingMotion run(const ModelingSettings& settings, const Integration& integration) {
  TransientStudy study;
  study.loads = {Load{1, {}, {0.28, 0.0}}};  // on body "left"
  study.duration = 5.0;
  study.outputs = 50;
  study.estimate = false;
  study.method = integration.method;
  if (integration.step > 0.0) study.step = integration.step;
  study.tolerance = integration.tolerance;
  return run_transient(model, study, settings, [](double) { return true; });
}

std::vector<double> course(const ModelingMotion& motion) {
  std::vector<double> x;
  for (const MotionState& state : motion.states) x.push_back(state.state.mids[1].position.x - 0.2);
  return x;
}

double difference(const std::vector<double>& found, const std::vector<double>& truth) {
  if (found.size() != truth.size()) return INFINITY;  // it did not reach the end
  double apart = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    apart = std::max(apart, std::abs(found[k] - truth[k]));
    largest = std::max(largest, std::abs(truth[k]));
  }
  return apart / largest;
}

constexpr Integration tight{Method::radau, 0.0, 1e-6};

struct Case {
  std::string name;
  ModelingSettings settings;
  Integration integration;
  double mesh_error = 0.0;
  double time_error = 0.0;
  int steps = 0;
  double error() const { return mesh_error + time_error; }
};

struct Candidate {
  std::string name;
  ModelingSettings settings;
  std::vector<double> own;  // integrated tightly
  double mesh_error = 0.0;
};

Candidate make_candidate(const std::string& name, ModelingSettings::Kind kind,
                         const std::vector<double>& truth) {
  Candidate made{name, make_settings(std::move(kind)), {}, 0.0};
  made.own = course(run(made.settings, tight));
  made.mesh_error = difference(made.own, truth);
  return made;
}

/// For each integrator the largest steps whose error, with that of the discretisation, is at most
/// the bound.
std::vector<Case> within(double bound, const Candidate& candidate) {
  std::vector<Case> cases;
  const auto keep_first = [&](const std::vector<Integration>& integrations) {
    for (const Integration& integration : integrations) {
      const ModelingMotion motion = run(candidate.settings, integration);
      Case c{candidate.name + ", " + integration.name(),
             candidate.settings,
             integration,
             candidate.mesh_error,
             difference(course(motion), candidate.own),
             motion.steps};
      if (c.error() > bound) continue;
      cases.push_back(std::move(c));
      return;
    }
  };
  std::vector<Integration> by_tolerance, by_step;
  for (const double tolerance : {1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5})
    by_tolerance.push_back({Method::radau, 0.0, tolerance});
  for (double step = 1e-2; step > 5e-4; step /= std::sqrt(2.0))
    by_step.push_back({Method::generalized_alpha, step, 0.0});
  keep_first(by_tolerance);
  keep_first(by_step);
  return cases;
}

class Times : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name == "median")
        milliseconds[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }
  std::map<std::string, double> milliseconds;
};

void add(const Case& c) {
  benchmark::RegisterBenchmark(c.name.c_str(),
                               [c](benchmark::State& state) {
                                 for (auto _ : state)
                                   benchmark::DoNotOptimize(run(c.settings, c.integration));
                               })
      ->Unit(benchmark::kMillisecond)
      ->MinTime(0.2)
      ->Repetitions(5)
      ->ReportAggregatesOnly(true);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const auto truth = course(run(make_settings(ExactSettings{8}), tight));
  const Candidate two_node = make_candidate("16 two-node elements", BeamSettings{16, 1, {}}, truth);
  const double bound = 1.1 * two_node.mesh_error;

  std::vector<Case> base = within(bound, two_node);
  std::vector<Case> others;
  const auto try_out = [&](const Candidate& candidate) {
    if (candidate.mesh_error > bound) return;
    for (Case& c : within(bound, candidate)) others.push_back(std::move(c));
  };
  for (const int modes : {2, 3, 4})
    try_out(make_candidate(fmt::format("exact, {} modes", modes), ExactSettings{modes}, truth));
  for (const int order : {3, 4, 5})
    try_out(make_candidate(fmt::format("one element of order {}", order),
                           BeamSettings{1, order, {}}, truth));
  for (const Case& c : base) add(c);
  for (const Case& c : others) add(c);

  Times times;
  benchmark::RunSpecifiedBenchmarks(&times);
  const auto time_of = [&times](const Case& c) { return times.milliseconds[c.name]; };
  const auto cheapest =
      std::min_element(base.begin(), base.end(),
                       [&](const Case& a, const Case& b) { return time_of(a) < time_of(b); });
  if (cheapest == base.end()) return 1;
  fmt::print("\nmedian CPU time of 5 s of motion, one thread; times cheaper than the first line\n");
  const auto print = [&](const Case& c) {
    fmt::print("{:<62} {:>8.2f} ms {:>6} steps {:>8.0f} steps/s  errors {:.3f} + {:.3f} {:>6.1f}\n",
               c.name, time_of(c), c.steps, 1e3 * c.steps / time_of(c), c.mesh_error, c.time_error,
               time_of(*cheapest) / time_of(c));
  };
  print(*cheapest);
  for (const Case& c : base)
    if (&c != &*cheapest) print(c);
  for (const Case& c : others) print(c);
  return 0;
}

// A 20-step path of the arc chain under LC1 by every modeling, timed in one run, with the ratios
// that compare equal work at equal error. Errors are those of the point E over the whole path,
// relative to its largest displacement, against the exact modeling with twice the modes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "arc_chain.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace {

using namespace flexura;

const Model model = bench::arc_chain();
const std::vector<Load> loads = bench::arc_chain_load();

ModelingSettings make_settings(ModelingSettings::Kind kind, double tolerance = 1e-8) {
  ModelingSettings settings;
  settings.kind = std::move(kind);
  settings.tolerance = tolerance;
  return settings;
}

std::vector<Vec2> path_of_e(const TracedPath& path) {
  std::vector<Vec2> points;
  for (const TracedState& state : path.states)
    points.push_back(path.systems[state.system]->moved_point(3, {19.093, 15.750}, state.z));
  return points;
}

double error_of(const TracedPath& path) {
  static const std::vector<Vec2> truth =
      path_of_e(trace_path(model, loads, make_settings(ExactSettings{16}, 1e-12), {}));
  const std::vector<Vec2> here = path_of_e(path);
  double worst = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    worst = std::max(worst, norm(here[k] - truth[k]));
    size = std::max(size, norm(truth[k] - truth.front()));
  }
  return worst / size;
}

struct Case {
  std::string name;
  ModelingSettings settings;
  bool estimate = false;
  double error = 0.0;
};

Case make_case(std::string name, const ModelingSettings& settings, bool estimate) {
  Case c{std::move(name), settings, estimate, 0.0};
  c.error = error_of(trace_path(model, loads, settings, {20, estimate, {}}));
  return c;
}

/// Displacement elements whose error does not exceed the given one: for every order, the smallest
/// mesh that does it.
std::vector<Case> beams_of_error(double error) {
  std::vector<Case> cases;
  for (int order = 3; order <= 8; ++order)
    for (int elements = 1; elements <= 32; ++elements) {
      Case c = make_case(fmt::format("beam/order:{}/elements:{}", order, elements),
                         make_settings(BeamSettings{elements, order, {}}), false);
      if (c.error > error) continue;
      cases.push_back(std::move(c));
      break;
    }
  return cases;
}

/// Two-node elements, by doubling and then trimming the mesh.
Case two_node_beam(double error) {
  const auto at = [](int elements) {
    return make_case(fmt::format("beam/order:1/elements:{}", elements),
                     make_settings(BeamSettings{elements, 1, {}}), false);
  };
  int elements = 64;
  while (at(elements).error > error) elements *= 2;
  while (at(elements - elements / 16).error <= error) elements -= elements / 16;
  return at(elements);
}

class Times : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name == "median")
        microseconds[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }
  std::map<std::string, double> microseconds;
};

void add(const Case& c) {
  benchmark::RegisterBenchmark(
      c.name.c_str(),
      [c](benchmark::State& state) {
        for (auto _ : state)
          benchmark::DoNotOptimize(trace_path(model, loads, c.settings, {20, c.estimate, {}}));
        state.counters["error"] = c.error;
      })
      ->Unit(benchmark::kMicrosecond)
      ->MinTime(0.1)
      ->Repetitions(5)
      ->ReportAggregatesOnly(true);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const Case exact = make_case("exact/with_estimate", make_settings(ExactSettings{}), true);
  const std::vector<Case> beams = beams_of_error(exact.error);
  const Case two_node = two_node_beam(1e-6);
  add(exact);
  const Case bare = make_case("exact/without_estimate", make_settings(ExactSettings{}), false);
  add(bare);
  const Case scmbm = make_case("scmbm", make_settings(ScmbmSettings{}), false);
  add(scmbm);
  add(make_case("prbm", make_settings(PrbmSettings{}), false));
  add(make_case("linear", make_settings(LinearSettings{}), false));
  for (const Case& beam : beams) add(beam);
  add(two_node);

  Times times;
  benchmark::RunSpecifiedBenchmarks(&times);
  const auto time_of = [&times](const Case& c) { return times.microseconds[c.name]; };
  const Case* best = nullptr;
  for (const Case& beam : beams)
    if (best == nullptr || time_of(beam) < time_of(*best)) best = &beam;

  fmt::print(
      "\nmedian CPU time of a 20-step path, one thread; times exact with, without estimate\n");
  const auto print = [&](const std::string& name, const Case& c) {
    fmt::print("{:<58} {:>9.1f} us  error {:.1e} {:>8.1f} {:>8.1f}\n", name, time_of(c), c.error,
               time_of(c) / time_of(exact), time_of(c) / time_of(bare));
  };
  print("exact at 1e-8, with its error estimate", exact);
  print("exact at 1e-8, without", bare);
  print("scmbm", scmbm);
  if (best != nullptr) print("best high-order beams of that error: " + best->name.substr(5), *best);
  print("two-node beams at 1e-6: " + two_node.name.substr(13), two_node);
  return 0;
}

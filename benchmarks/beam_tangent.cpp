// Residual, tangent and elimination of one geometrically exact flexure (TwoPort::linearize), by
// automatic differentiation and by derivatives worked out by hand (tests/support/hand_derived.cpp,
// which the tests hold equal to 1e-12), timed in one run. The table's last column is what automatic
// differentiation costs.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "arc_chain.hpp"
#include "flexura/modelings/beam.hpp"
#include "flexura/modelings/exact.hpp"
#include "tests/support/hand_derived.hpp"

namespace {

using namespace flexura;
using namespace flexura::testing;

const Model model = bench::arc_chain();
const FlexureProperties flexure = flexure_properties(model, model.flexures[0], true, true);

template <class Port>
void time_linearize(benchmark::State& state, const Port& port) {
  std::vector<double> y(port.internal_size()), scratch(port.scratch_size());
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = 0.1 * std::sin(1.7 * static_cast<double>(i) + 0.3);
  const Eigen::Vector3d load(1e-3, -2e-3, 5e-3);
  for (auto _ : state) benchmark::DoNotOptimize(port.linearize(load, y.data(), scratch.data()));
}

/// Runs of the two are mixed at random, so that a busy machine slows down both.
template <class Port>
void add(const std::string& name, const Port& port) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [&port](benchmark::State& state) { time_linearize(state, port); })
      ->MinTime(0.02)
      ->Repetitions(15);
}

/// The quickest repetition of every benchmark: what disturbs a run makes it slower, never quicker.
class Quickest : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const auto [at, is_new] =
          nanoseconds.try_emplace(run.run_name.function_name, run.GetAdjustedCPUTime());
      if (!is_new) at->second = std::min(at->second, run.GetAdjustedCPUTime());
    }
  }
  std::map<std::string, double> nanoseconds;
};

struct Pair {
  std::string name;
  std::shared_ptr<const TwoPort> by_ad;
};

}  // namespace

int main(int argc, char** argv) {
  char mixed[] = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, mixed);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());

  std::vector<Pair> pairs;
  std::vector<HandDerivedExact> exacts;
  std::vector<HandDerivedBeam> beams;
  for (const int modes : {6, 9, 16}) {
    pairs.push_back({fmt::format("exact, {} modes", modes),
                     make_exact_port(flexure, ExactSettings{modes}, 1e-8)});
    exacts.emplace_back(flexure, modes);
  }
  for (const auto& [elements, order] : {std::pair{64, 1}, {16, 2}, {8, 4}, {2, 8}}) {
    pairs.push_back({fmt::format("beam, {} elements of order {}", elements, order),
                     make_beam_port(flexure, BeamSettings{elements, order, {}})});
    beams.emplace_back(flexure, elements, order);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    add(pairs[k].name + "/ad", *pairs[k].by_ad);
    if (k < exacts.size())
      add(pairs[k].name + "/hand", exacts[k]);
    else
      add(pairs[k].name + "/hand", beams[k - exacts.size()]);
  }
  Quickest quickest;
  benchmark::RunSpecifiedBenchmarks(&quickest);

  fmt::print("{:<30} {:>12} {:>12} {:>8}\n", "residual and tangent", "AD", "by hand", "ratio");
  for (const Pair& pair : pairs) {
    const double ad = quickest.nanoseconds[pair.name + "/ad"];
    const double hand = quickest.nanoseconds[pair.name + "/hand"];
    fmt::print("{:<30} {:>9.0f} ns {:>9.0f} ns {:>8.2f}\n", pair.name, ad, hand, ad / hand);
  }
  return 0;
}

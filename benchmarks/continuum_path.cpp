// What full-flexible truth costs: the 20-step path of the arc chain under LC1 by the second
// source's kind of mesh (four-node elements, 20 across) and by meshes that the tolerance chooses,
// timed in one run by the clock on the wall, two threads. Errors are those of the point E over the
// path, relative to its largest displacement, against a converged plane-stress solution.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "arc_chain.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace {

using namespace flexura;

const Model model = bench::arc_chain();
const std::vector<Load> loads = bench::arc_chain_load();
constexpr int steps = 20;

struct Case {
  std::string name;
  ContinuumSettings mesh;
  double tolerance = 1e-8;
  bool estimate = false;
  int repetitions = 20;
};

struct Run {
  std::vector<Vec2> path_of_e;
  double seconds = 0.0;
  std::size_t unknowns = 0;
  double factorizations = 0.0;  // per load step
};

Run run(const Case& c) {
  ModelingSettings settings;
  settings.kind = c.mesh;
  settings.tolerance = c.tolerance;
  std::vector<double> seconds;
  Run result;
  for (int i = 0; i < c.repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const TracedPath path = trace_path(model, loads, settings, {steps, c.estimate, {}});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    seconds.push_back(took.count());
    if (i > 0) continue;
    for (const TracedState& state : path.states)
      result.path_of_e.push_back(
          path.systems[state.system]->moved_point(3, {19.093, 15.750}, state.z));
    result.unknowns = path.systems.back()->modeled_size();
    result.factorizations = static_cast<double>(path.iterations) / steps;
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  result.seconds = seconds[seconds.size() / 2];
  return result;
}

double error_of(const Run& here, const Run& truth) {
  if (here.path_of_e.size() != truth.path_of_e.size()) return INFINITY;
  double worst = 0.0, size = 0.0;
  for (std::size_t k = 0; k < truth.path_of_e.size(); ++k) {
    worst = std::max(worst, norm(here.path_of_e[k] - truth.path_of_e[k]));
    size = std::max(size, norm(truth.path_of_e[k] - truth.path_of_e.front()));
  }
  return worst / size;
}

ContinuumSettings mesh(int order, int order_across, int across, int elements) {
  ContinuumSettings settings;
  settings.order = order;
  settings.order_across = order_across;
  settings.across = across;
  settings.elements = elements;
  return settings;
}

}  // namespace

int main() {
  const Run truth = run({"converged", mesh(8, 6, 1, 60), 1e-8, false, 1});
  const Case large{"four-node elements, 20 across", mesh(1, 1, 20, 2233), 1e-8, false, 1};
  const Case chosen[] = {{"tolerance 1e-3", {}, 1e-3, false},
                         {"tolerance 1e-3, with estimates", {}, 1e-3, true},
                         {"tolerance 1e-4", {}, 1e-4, false},
                         {"tolerance 1e-4, with estimates", {}, 1e-4, true}};
  fmt::print("{:<32} {:>9} {:>10} {:>9} {:>9} {:>7}\n", "20 load steps", "unknowns", "seconds",
             "factor./step", "error", "ratio");
  const Run full = run(large);
  const auto print = [&](const std::string& name, const Run& r) {
    fmt::print("{:<32} {:>9} {:>10.4f} {:>12.2f} {:>9.1e} {:>7.0f}\n", name, r.unknowns, r.seconds,
               r.factorizations, error_of(r, truth), full.seconds / r.seconds);
  };
  print(large.name, full);
  for (const Case& c : chosen) print(c.name, run(c));
  return 0;
}

// Turns and CPU seconds that the periodic motion of the Turcic-Midha four-bar takes by shooting,
// beside those of a transient that waits until it is within 1e-6 of it (as radians of bending), to
// judge by its last change and by how slowly such changes die out.
// `stiffness` is Rayleigh's damping in seconds, `largest` the largest Floquet multiplier,
// `multiplier` the linearised turns for the six largest. Prints a table, in two minutes:
//   build/release/benchmarks/periodic_orbit
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "flexura/studies/periodic_motion.hpp"
#include "flexura/studies/turn_layout.hpp"
#include "flexura/studies/turn_map.hpp"
#include "tests/support/linkage.hpp"
#include "tests/support/modelings.hpp"

namespace {

using namespace flexura;

constexpr double close_enough = 1e-6;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Turns from where the search set off, the drawn mechanism moving as if rigid, until all that are
/// still to come change the state by less than `close_enough`, a geometric series of ratio |largest
/// multiplier|. (The orbit of other steps would not do for a goal: with little damping, the errors
/// of steps move it by more than that.)
struct Waiting {
  int turns = 0;
  double seconds = 0.0;
};
Waiting wait(const Model& model, const PeriodicMotionStudy& study, const ModelingSettings& settings,
             double largest) {
  constexpr int most_turns = 5000;
  const double start = cpu_seconds();
  const double period = 2.0 * std::numbers::pi / std::abs(study.speed);
  MotionSystem system(TurnLayout(model, study, settings).at(study.speed));
  TurnMap map(system, system.drawn_moment(), {period, study.outputs, study.tolerance, {}});
  Moment moment = system.drawn_moment();
  MotionFactor<double> factor;
  project_rates(system, moment, period, factor);
  Eigen::VectorXd x = map.free_state().reduce(moment);
  Waiting waiting;
  double change = INFINITY;
  while (change > close_enough * (1.0 - largest) && waiting.turns < most_turns) {
    Eigen::VectorXd end;
    ++waiting.turns;
    if (!map.turn(x, end)) break;
    change = (end - x).norm();
    x = end;
  }
  waiting.seconds = cpu_seconds() - start;
  return waiting;
}

}  // namespace

int main() {
  struct Case {
    double rpm, stiffness;
  };
  const Model model = testing::turcic_midha_four_bar();
  const ModelingSettings settings = testing::exact_modes(4);
  fmt::print("{:>5} {:>9} {:>12} {:>6} {:>12} {:>10} {:>8} {:>8} {:>10} {:>8} {:>8}\n", "rpm",
             "stiffness", "largest", "turns", "linearised", "multiplier", "seconds", "steps",
             "s per turn", "waiting", "seconds");
  for (const Case& c : {Case{60.0, 1e-4}, Case{300.0, 3e-4}, Case{300.0, 1e-4}, Case{300.0, 1e-5},
                        Case{300.0, 3e-6}, Case{340.0, 1e-5}, Case{600.0, 1e-4}}) {
    PeriodicMotionStudy study;
    study.speed = c.rpm * 2.0 * std::numbers::pi / 60.0;
    study.damping.stiffness = c.stiffness;
    const double start = cpu_seconds();
    const PeriodicMotion orbit = find_periodic_motion(model, study, settings);
    const double seconds = cpu_seconds() - start;
    if (!orbit.termination.converged()) {
      fmt::print("{:>5} {:>9.0e} {}\n", c.rpm, c.stiffness, orbit.termination.reason);
      continue;
    }
    const double largest = std::abs(orbit.multipliers.front());
    const int all = orbit.turns + orbit.flows + orbit.multiplier_flows;
    fmt::print("{:>5} {:>9.0e} {:>12.6f} {:>6} {:>12} {:>10} {:>8.2f} {:>8} {:>10.3f}", c.rpm,
               c.stiffness, largest, orbit.turns, orbit.flows, orbit.multiplier_flows, seconds,
               orbit.steps_per_turn, seconds / all);
    if (largest < 1.0) {
      const Waiting waiting = wait(model, study, settings, largest);
      fmt::print(" {:>8} {:>8.2f}\n", waiting.turns, waiting.seconds);
    } else {
      fmt::print(" {:>8}\n", "never");
    }
    std::fflush(stdout);
  }
  return 0;
}

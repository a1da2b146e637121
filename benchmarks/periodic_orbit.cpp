// Turns and seconds that the periodic motion of the Turcic-Midha four-bar takes by shooting, beside
// those of a transient that waits for it. Prints a table:
//   build/release/benchmarks/periodic_orbit
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "flexura/studies/periodic_motion.hpp"
#include "flexura/studies/turn_layout.hpp"
#include "flexura/studies/turn_map.hpp"
#include "tests/support/linkage.hpp"
#include "tests/support/modelings.hpp"

namespace {

using namespace flexura;
using Clock = std::chrono::steady_clock;

constexpr double close_enough = 1e-6;  // in mean flexure lengths

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Turns from the drawn mechanism, moving as if rigid, until one changes the state by no more than
/// waiting for the orbit could still change it by `close_enough`.
struct Waiting {
  int turns = 0;
  double seconds = 0.0;
};
Waiting wait(const Model& model, const PeriodicMotionStudy& study, const ModelingSettings& settings,
             const PeriodicMotion& orbit) {
  constexpr int most_turns = 5000;
  const auto start = Clock::now();
  const double period = 2.0 * std::numbers::pi / std::abs(study.speed);
  MotionSystem system(TurnLayout(model, study, settings).at(study.speed));
  TurnMap map(system, system.drawn_moment(), {period, study.outputs, study.tolerance, {}});
  Moment moment = system.drawn_moment();
  MotionFactor<double> factor;
  project_rates(system, moment, period, factor);
  Eigen::VectorXd x = map.free_state().reduce(moment);
  const Eigen::VectorXd goal = map.free_state().reduce(orbit.moments.front());
  Waiting waiting;
  while ((x - goal).norm() > close_enough && waiting.turns < most_turns) {
    Eigen::VectorXd end;
    ++waiting.turns;
    if (!map.turn(x, end)) break;
    x = end;
  }
  waiting.seconds = seconds_since(start);
  return waiting;
}

}  // namespace

int main() {
  const Model model = testing::turcic_midha_four_bar();
  const ModelingSettings settings = testing::exact_modes(4);
  fmt::print("{:>6} {:>10} {:>9} {:>6} {:>6} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9}\n", "rpm",
             "stiffness", "status", "turns", "flows", "mult.", "steps", "seconds", "largest",
             "waiting", "seconds");
  for (const double rpm : {60.0, 300.0, 340.0, 600.0})
    for (const double stiffness : {3e-4, 1e-4, 1e-5, 1e-6}) {
      PeriodicMotionStudy study;
      study.speed = rpm * 2.0 * std::numbers::pi / 60.0;
      study.damping.stiffness = stiffness;
      const PeriodicMotion orbit = find_periodic_motion(model, study, settings);
      fmt::print("{:>6} {:>10.0e} {:>9} {:>6} {:>6} {:>7} {:>7} {:>9.3f}", rpm, stiffness,
                 orbit.termination.converged() ? "found" : "stopped", orbit.turns, orbit.flows,
                 orbit.multiplier_flows, orbit.steps_per_turn, orbit.seconds);
      if (!orbit.termination.converged()) {
        fmt::print("  {}\n", orbit.termination.reason);
        continue;
      }
      const Waiting waiting = wait(model, study, settings, orbit);
      fmt::print(" {:>9.6f} {:>9} {:>9.3f}\n", std::abs(orbit.multipliers.front()), waiting.turns,
                 waiting.seconds);
    }
  return 0;
}

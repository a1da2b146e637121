// The four-bar of Turcic and Midha by three beam elements a link, at 300 rpm, both without what can
// be kept from one solution to the next:
// - OneTurn: rigid motion, matrices and one turn of integration by Radau's rule of six stages in
// 180
//   steps, which gives strains to 1e-8;
// - PeriodicSolution: the same, and the periodic motion with its multipliers of Floquet;
// - Sweep: 200 speeds from 60 to 600 rpm with their multipliers, on all processors.
//   build/release/benchmarks/linkage
#include <benchmark/benchmark.h>

#include <numbers>

#include "flexura/studies/linkage_methods.hpp"
#include "tests/support/linkage.hpp"

namespace {

using namespace flexura;

constexpr double rpm = std::numbers::pi / 30.0;

const Model model = testing::turcic_midha_four_bar().model();

LinkageStudy make_study() {
  LinkageStudy study;
  study.modeling.kind = BeamSettings{3, 1, BeamSettings::Theory::linear};
  study.modeling.shear = false;
  study.geometric_stiffness = LinkageStudy::GeometricStiffness::none;
  study.damping.modal = 0.02;
  return study;
}

void one_turn(benchmark::State& state) {
  const LinkageStudy study = make_study();
  for (auto _ : state) {
    LinkageTurn turn(model, study, false);
    const std::vector<double> ends = turn.interval_ends(1);
    turn.visit(LinkageTurn::stage_angles(ends, periodic_stages));
    const double speed = 300.0 * rpm;
    const PeriodicOscillation oscillation(ends, periodic_stages, [&](double angle) {
      const Eigen::MatrixXd stiffness = turn.stiffness(angle, speed);
      return turn.oscillation(angle, speed, stiffness, stiffness);
    });
    benchmark::DoNotOptimize(oscillation.states(Eigen::VectorXd::Zero(2 * turn.system().size())));
  }
}

void periodic_solution(benchmark::State& state) {
  const LinkageStudy study = make_study();
  for (auto _ : state) {
    LinkageTurn turn(model, study, false);
    turn.visit(turn.positions());
    benchmark::DoNotOptimize(solve_periodic(turn, study, 300.0 * rpm));
  }
}

void sweep(benchmark::State& state) {
  LinkageStudy study = make_study();
  study.speeds = SpeedRange{60.0 * rpm, 600.0 * rpm, 200};
  for (auto _ : state) benchmark::DoNotOptimize(sweep_speeds(model, study, {}));
}

BENCHMARK(one_turn)->Name("OneTurn")->Unit(benchmark::kMillisecond);
BENCHMARK(periodic_solution)->Name("PeriodicSolution")->Unit(benchmark::kMillisecond);
BENCHMARK(sweep)->Name("Sweep")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

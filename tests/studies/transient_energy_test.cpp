// The balance of energy where loads come and go, drivers turn joints and dampers take: what is
// gained is what was done less what was lost.
#include <cmath>

#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

using Method = TransientStudy::Method;

/// A crank turns a rod that pushes a slider against a leaf and a damper; a spring braces the rod.
Mechanism driven_linkage() {
  Mechanism machine;
  machine.material(5e7, 0.4).density(1000.0).section(RectangleSection{0.01, 0.02});
  machine.fixed("ground").centre({0.0, -0.2});
  machine.body("crank").centre({0.0, 0.0});
  machine.body("rod").mass(0.2, 0.002).centre({0.23, 0.03});
  machine.body("slider").mass(0.5).centre({0.4, 0.0});
  machine.body("tip").mass(0.1, 1e-4).centre({0.4, 0.4});
  machine.pin("crank", "rod", {0.06, 0.06}).pin("rod", "slider", {0.4, 0.0});
  machine.slide("ground", "slider", {1.0, 0.0});
  machine.flexure("slider", "tip", LineAxis{{0.4, 0.0}, {0.4, 0.4}});
  machine.spring("ground", "tip", 3.0, 0.8).spring("ground", "rod", 5.0, 0.3);
  machine.turn("crank", 6.0, RampHistory{0.0, 1.0, true});
  return machine;
}

TransientStudy driven(const Mechanism& machine) {
  TransientStudy study = transient(1.5, 30, 1e-9);
  study.fields.gravity = {0.0, -9.81};
  study.loads = {machine.load("tip", {0.3, 0.0}), machine.follower("tip", {0.0, 0.2}, 0.01)};
  study.loads[0].history = HalfSineHistory{0.2, 0.4};
  study.loads[1].history = HarmonicHistory{20.0, 0.0};
  return study;
}

struct Case {
  const char* name;
  Method method;
  double step;  // 0: by tolerance
  double left;  // of the balance, as a share of the largest energy
};

class DrivenBalance : public ::testing::TestWithParam<Case> {};

/// By dampers, Rayleigh's damping and modal damping in turn.
TEST_P(DrivenBalance, Closes) {
  const Mechanism machine = driven_linkage();
  for (const DampingSettings& damping :
       {DampingSettings{}, DampingSettings{0.0, 0.5, 0.01}, DampingSettings{0.1, 0.0, 0.0}}) {
    TransientStudy study = driven(machine);
    study.method = GetParam().method;
    if (GetParam().step > 0.0) study.step = GetParam().step;
    study.damping = damping;
    const ModelingMotion motion = move(machine, study, in_theory(exact_modes(3), "i"));
    const EnergyBalance& end = motion.states.back().energy;
    const std::string what = damping.modal > 0.0 ? "modal" : damping.mass > 0.0 ? "rayleigh" : "";
    note_measured("balance" + what, motion.energy_error);
    note_measured("dissipated" + what, end.dissipated);
    note_measured("work" + what, end.work);
    EXPECT_LT(motion.energy_error, GetParam().left) << what;
    // no sum that is empty: each is far more than what is left open
    EXPECT_GT(end.dissipated, 0.1 * std::abs(end.work));
    EXPECT_GT(std::abs(end.work), 0.05);
    for (const MotionState& state : motion.states) EXPECT_LT(state.energy.drift, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, DrivenBalance,
    ::testing::Values(Case{"radau", Method::radau, 0.0, 1e-6},
                      Case{"energy_momentum", Method::energy_momentum, 2e-3, 1e-7},
                      Case{"generalized_alpha", Method::generalized_alpha, 1e-3, 1e-3}),
    [](const auto& tested) { return tested.param.name; });

/// A hub is set turning, and stopped, at once; the blows' work is the gain of kinetic energy.
TEST(DrivenBalanceOverBlows, Closes) {
  Mechanism arm;
  arm.material(5e7, 0.4).density(1000.0).section(RectangleSection{0.01, 0.02});
  arm.fixed("ground").centre({0.0, -0.2}).body("hub").centre({0.0, 0.0});
  arm.body("tip").mass(0.1, 1e-4).flexure("hub", "tip", LineAxis{{0.0, 0.0}, {0.4, 0.0}});
  for (const auto& [name, method, step, left] :
       {Case{"radau", Method::radau, 0.0, 1e-6},
        Case{"alpha", Method::generalized_alpha, 5e-4, 3e-3}})
    for (const double start : {0.0, 0.2}) {
      Mechanism driven = arm;
      driven.turn("hub", 0.5, RampHistory{start, 0.6, false});
      TransientStudy study = transient(1.0, 20, 1e-9);
      study.method = method;
      if (step > 0.0) study.step = step;
      const ModelingMotion motion = move(driven, study, in_theory(exact_modes(3), "i"));
      EXPECT_LT(motion.energy_error, left) << name << ' ' << start;
      EXPECT_GT(motion.states[10].energy.kinetic, 1e-3) << name << ' ' << start;
    }
}

/// With half the step a quarter is left open.
TEST(DrivenBalanceOrder, OfGeneralizedAlphaIsTwo) {
  const Mechanism machine = driven_linkage();
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    TransientStudy study = in_steps(driven(machine), Method::generalized_alpha, 1e-3 / (1 << k));
    study.spectral_radius = 0.8;
    errors[k] = move(machine, study, in_theory(exact_modes(3), "i")).energy_error;
  }
  note_measured("ratio", errors[0] / errors[1]);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.4);
}

}  // namespace
}  // namespace flexura::testing

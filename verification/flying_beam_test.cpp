// The flying spaghetti of Simo and Vu-Quoc (Comput. Meth. Appl. Mech. Eng. 66 (1988) 125), in the
// plane: a free beam of length 10, inclined by atan(4/3), under a force 8 and a moment 80 at its
// lower end for 2.5 s. No position is known from outside; momenta and energy are known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double force = 8.0;
constexpr double moment = 80.0;
constexpr double let_go = 2.5;

/// EA = GA_s = 1e4, EI = 100, mass 1 and rotary inertia 10 per length.
Mechanism spaghetti() {
  GeneralSection section;
  section.area = 1.0;
  section.second_moment = 0.01;
  section.shear_area = 2.0;
  section.rotary_second_moment = 10.0;
  Mechanism beam;
  beam.material(1e4, 0.0).density(1.0).section(section);
  beam.body("lower").free().body("upper");
  beam.flexure("lower", "upper", LineAxis{{6.0, 0.0}, {0.0, 8.0}});
  return beam;
}

/// Until 2.5 s: what acts then is taken back.
TransientStudy thrown(const Mechanism& beam, double duration, int outputs) {
  TransientStudy study = transient(duration, outputs, 1e-6);
  study.loads = {beam.load("lower", {force, 0.0}, moment),
                 beam.load("lower", {-force, 0.0}, -moment)};
  study.loads[1].history = StepHistory{let_go};
  return study;
}

class Spaghetti : public ::testing::TestWithParam<ModelingSettings> {};

/// By energy and momentum, in steps of 0.05 s: momenta and energy to what Newton's method leaves.
/// (The angular impulse of what acts at the end to the square of its rotation in a step: it is the
/// work of a moment that the method has exact.)
TEST_P(Spaghetti, KeepsMomentaAndEnergy) {
  constexpr double step = 0.05;
  const Mechanism noodle = spaghetti();
  const TransientStudy study =
      in_steps(thrown(noodle, 10.0, 200), TransientStudy::Method::energy_momentum, step);
  const ModelingMotion motion = move(noodle, study, GetParam());
  ASSERT_EQ(motion.states.size(), 201u);
  double angular_impulse = 0.0;
  double worst_impulse = 0.0, worst_linear = 0.0, worst_angular = 0.0, worst_energy = 0.0;
  const EnergyBalance& free = motion.states[50].energy;  // at 2.5 s
  for (std::size_t k = 1; k < motion.states.size(); ++k) {
    const EnergyBalance& now = motion.states[k].energy;
    const double acted = std::min(motion.states[k].time, let_go);
    worst_linear = std::max(worst_linear, norm(now.momentum - Vec2{force * acted, 0.0}));
    if (k <= 50) {
      // the force acts at the middle of the step, at the mean of both places
      const double y = 0.5 * (pose_at(noodle, motion.states[k - 1], "lower").position.y +
                              pose_at(noodle, motion.states[k], "lower").position.y);
      angular_impulse += step * (moment - y * force);
      worst_impulse = std::max(worst_impulse, std::abs(now.angular_momentum - angular_impulse));
      continue;
    }
    worst_angular = std::max(worst_angular, std::abs(now.angular_momentum - free.angular_momentum));
    worst_energy =
        std::max(worst_energy, std::abs(now.kinetic + now.strain - free.kinetic - free.strain));
  }
  note_measured("linear", worst_linear / (force * let_go));
  note_measured("impulse", worst_impulse / std::abs(free.angular_momentum));
  note_measured("angular", worst_angular / std::abs(free.angular_momentum));
  note_measured("energy", worst_energy / (free.kinetic + free.strain));
  EXPECT_LT(worst_linear, 1e-9 * force * let_go);
  EXPECT_LT(worst_impulse, 3e-3 * std::abs(free.angular_momentum));
  EXPECT_LT(worst_angular, 1e-9 * std::abs(free.angular_momentum));
  EXPECT_LT(worst_energy, 1e-9 * (free.kinetic + free.strain));
}

INSTANTIATE_TEST_SUITE_P(Verification, Spaghetti, ::testing::Values(exact_modes(6), beam(6, 2)),
                         [](const auto& test) { return test.param.label; });

/// Radau's method knows nothing of momenta: what they lose over 2700 steps is a measure of its
/// tolerance, here 1e-8 of the length a step.
TEST(SpaghettiByRadau, KeepsMomentaToItsTolerance) {
  const Mechanism noodle = spaghetti();
  TransientStudy study = thrown(noodle, 5.0, 50);
  study.tolerance = 1e-8;
  const ModelingMotion motion = move(noodle, study, exact_modes(6));
  const EnergyBalance& last = motion.states.back().energy;
  const EnergyBalance& free = motion.states[25].energy;
  note_measured("linear", norm(last.momentum - Vec2{20.0, 0.0}));
  note_measured("angular", std::abs(last.angular_momentum - free.angular_momentum));
  note_measured("energy", motion.energy_error);
  EXPECT_LT(norm(last.momentum - Vec2{20.0, 0.0}), 3e-5);
  EXPECT_NEAR(last.angular_momentum, free.angular_momentum, 2e-4);
  EXPECT_LT(motion.energy_error, 1e-6);
}

/// A load that comes and goes smoothly within 1.5 s: modes and elements, which share no
/// interpolation, meet. The beam turns by three radians along its length, which takes many modes.
TEST(SpaghettiByRadau, ModelingsAgree) {
  const Mechanism noodle = spaghetti();
  TransientStudy study = thrown(noodle, 1.5, 15);
  study.tolerance = 1e-7;
  study.loads[0].history = RampHistory{0.0, 0.7, true};
  study.loads[1].history = RampHistory{0.7, 1.5, true};
  const ModelingMotion modal = move(noodle, study, exact_modes(16));
  const ModelingMotion elements = move(noodle, study, beam(8, 5));
  double apart = 0.0;
  for (std::size_t k = 0; k < modal.states.size(); ++k)
    for (const char* end : {"lower", "upper"})
      apart = std::max(apart, norm(pose_at(noodle, modal.states[k], end).position -
                                   pose_at(noodle, elements.states[k], end).position));
  note_measured("apart", apart);
  EXPECT_LT(apart, 1e-4);
}

}  // namespace
}  // namespace flexura::testing

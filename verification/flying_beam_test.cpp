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
  EXPECT_LT(worst_impulse, 1e-9 * std::abs(free.angular_momentum));
  EXPECT_LT(worst_angular, 1e-9 * std::abs(free.angular_momentum));
  EXPECT_LT(worst_energy, 1e-9 * (free.kinetic + free.strain));
}

INSTANTIATE_TEST_SUITE_P(Verification, Spaghetti, ::testing::Values(exact_modes(6), beam(6, 2)),
                         [](const auto& test) { return test.param.label; });

/// Radau's method knows nothing of momenta: they, and the centre of mass, are then a measure of its
/// errors. The centre moves as a mass point under the force: by F T^2 (t/T - 1/2)/m after T.
TEST(SpaghettiByRadau, MovesItsCentreOfMassAsAPoint) {
  const Mechanism noodle = spaghetti();
  TransientStudy study = thrown(noodle, 5.0, 50);
  study.tolerance = 1e-8;
  const ModelingMotion motion = move(noodle, study, exact_modes(8));
  const EnergyBalance& last = motion.states.back().energy;
  const EnergyBalance& free = motion.states[25].energy;
  note_measured("linear", norm(last.momentum - Vec2{20.0, 0.0}));
  note_measured("angular", std::abs(last.angular_momentum - free.angular_momentum));
  note_measured("energy", motion.energy_error);
  EXPECT_LT(norm(last.momentum - Vec2{20.0, 0.0}), 1e-7);
  EXPECT_NEAR(last.angular_momentum, free.angular_momentum, 1e-6);
  EXPECT_LT(motion.energy_error, 1e-7);
}

/// The two modelings and the two methods, each from a theory and a program of its own, meet.
TEST(SpaghettiByRadau, ModelingsAndMethodsAgree) {
  const Mechanism noodle = spaghetti();
  TransientStudy study = thrown(noodle, 5.0, 20);
  study.tolerance = 1e-7;
  const auto ends = [&](const TransientStudy& by, const ModelingSettings& settings) {
    const ModelingMotion motion = move(noodle, by, settings);
    return std::pair{pose_at(noodle, motion.states.back(), "lower"),
                     pose_at(noodle, motion.states.back(), "upper")};
  };
  const auto off = [](const auto& a, const auto& b) {
    return std::max(norm(a.first.position - b.first.position),
                    norm(a.second.position - b.second.position));
  };
  const auto modal = ends(study, exact_modes(8));
  const auto elements = ends(study, beam(8, 4));
  note_measured("elements", off(elements, modal));
  EXPECT_LT(off(elements, modal), 1e-5);
  const auto stepped = [&](double step) {
    return off(ends(in_steps(study, TransientStudy::Method::energy_momentum, step), exact_modes(8)),
               modal);
  };
  const double coarse = stepped(0.025), fine = stepped(0.0125);
  note_measured("energy_momentum", fine);
  note_measured("ratio", coarse / fine);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

}  // namespace
}  // namespace flexura::testing

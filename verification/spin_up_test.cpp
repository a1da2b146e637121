// The spin-up manoeuvre of Simo and Vu-Quoc (J. Appl. Mech. 53 (1986) 855): a beam turned about one
// end from rest to 6 rad/s, against an independent solution (case5_spinup_tip.csv, right to 2e-8;
// tests/data/reference/dynamics/README.md) and the closed form of its steady extension.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/reference.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 10.0;
constexpr double last_speed = 6.0;

double hub_angle(double t) {
  if (t >= 15.0) return last_speed * t - 45.0;
  const double w = 2.0 * pi / 15.0;
  return 0.4 * (0.5 * t * t + (std::cos(w * t) - 1.0) / (w * w));
}

/// EA = 2.8e7, GA_s = 1e7, EI = 1.4e4, mass 1.2 and rotary inertia 6e-4 per length.
Mechanism spun_beam() {
  GeneralSection section;
  section.area = 1.0;
  section.second_moment = 5e-4;
  section.shear_area = 1.0;
  Mechanism beam;
  beam.material(2.8e7, 0.4).density(1.2).section(section);
  beam.body("hub").body("tip").flexure("hub", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}});
  beam.turn("hub", 1.0, FunctionHistory{hub_angle});
  return beam;
}

/// Of the tip, seen from the hub.
struct Tip {
  double axial = 0.0;
  double transverse = 0.0;
  double rotation = 0.0;
};

Tip tip_at(const Mechanism& rod, const MotionState& state) {
  const Pose tip = pose_at(rod, state, "tip");
  const double psi = hub_angle(state.time);
  return {std::cos(psi) * tip.position.x + std::sin(psi) * tip.position.y - length,
          std::cos(psi) * tip.position.y - std::sin(psi) * tip.position.x, tip.rotation - psi};
}

/// Largest differences from the reference over its 200 times, every 0.1 s.
Tip errors(const TransientStudy& study, const ModelingSettings& settings) {
  const ReferenceTable table("dynamics/case5_spinup_tip.csv");
  const Mechanism rod = spun_beam();
  const ModelingMotion motion = move(rod, study, settings);
  Tip worst;
  if (motion.states.size() != table.size() + 1) {
    ADD_FAILURE() << "states: " << motion.states.size();
    return worst;
  }
  for (std::size_t row = 0; row < table.size(); ++row) {
    const Tip tip = tip_at(rod, motion.states[row + 1]);
    const auto off = [&](double found, const char* column) {
      return std::abs(found - table.number(row, column));
    };
    worst.axial = std::max(worst.axial, off(tip.axial, "u1_axial"));
    worst.transverse = std::max(worst.transverse, off(tip.transverse, "u2_transverse"));
    worst.rotation = std::max(worst.rotation, off(tip.rotation, "alpha_rel_rotation"));
  }
  note_measured("axial", worst.axial);
  note_measured("transverse", worst.transverse);
  note_measured("rotation", worst.rotation);
  return worst;
}

/// Within the reference's own 2e-8, but for what the tolerance of steps leaves of the deflection.
TEST(SpinUp, ExactIsTheReference) {
  const Tip off = errors(transient(20.0, 200, 1e-8), exact_modes(8));
  EXPECT_LT(off.axial, 2e-8);
  EXPECT_LT(off.transverse, 1e-7);
  EXPECT_LT(off.rotation, 6e-8);
}

TEST(SpinUp, ExactWithFewModesAndLooseSteps) {
  const Tip off = errors(transient(20.0, 200, 1e-6), exact_modes(6));
  EXPECT_LT(off.axial, 2e-7);
  EXPECT_LT(off.transverse, 1e-6);
  EXPECT_LT(off.rotation, 5e-7);
}

TEST(SpinUp, BeamElementsAreTheReference) {
  const Tip off = errors(transient(20.0, 200, 1e-7), beam(8, 3));
  EXPECT_LT(off.axial, 1e-7);
  EXPECT_LT(off.transverse, 1e-6);
  EXPECT_LT(off.rotation, 5e-7);
}

/// Half the step, a quarter of the error.
TEST(SpinUp, GeneralizedAlphaIsOfSecondOrder) {
  const auto by_step = [](double step) {
    return errors(
        in_steps(transient(20.0, 200, 1e-5), TransientStudy::Method::generalized_alpha, step),
        exact_modes(6));
  };
  const Tip coarse = by_step(0.02);
  const Tip fine = by_step(0.01);
  note_measured("ratio", coarse.transverse / fine.transverse);
  EXPECT_LT(fine.transverse, 1e-4);
  EXPECT_NEAR(coarse.transverse / fine.transverse, 4.0, 0.1);
  EXPECT_NEAR(coarse.axial / fine.axial, 4.0, 0.1);
}

/// Extremes over time of a value at output times, by the parabola through the three around.
template <class Value>
std::pair<double, double> lowest(const ModelingMotion& motion, const Value& value) {
  std::size_t k = 1;
  for (std::size_t j = 1; j + 1 < motion.states.size(); ++j)
    if (value(motion.states[j]) < value(motion.states[k])) k = j;
  const double h = motion.states[k].time - motion.states[k - 1].time;
  const double a = value(motion.states[k - 1]);
  const double b = value(motion.states[k]);
  const double c = value(motion.states[k + 1]);
  const double shift = 0.5 * (a - c) / (a - 2.0 * b + c);
  return {motion.states[k].time + shift * h, b - 0.25 * (a - c) * shift};
}

/// Peaks of the reference, and when they come. Outputs every 0.01 s: the parabola's error is 1e-7
/// of the time and less of the value.
TEST(SpinUp, LargestDeflections) {
  const Mechanism rod = spun_beam();
  const ModelingMotion motion = move(rod, transient(7.0, 700, 1e-6), exact_modes(8));
  const auto reference = read_reference_json("dynamics/case5_spinup.json")["E"];
  const auto check = [&](const char* key, auto value) {
    const auto [time, peak] = lowest(motion, value);
    note_measured(std::string(key) + "_time", std::abs(time - number_of(reference[key][0])));
    note_measured(key, std::abs(peak - number_of(reference[key][1])));
    EXPECT_NEAR(time, number_of(reference[key][0]), 1e-4) << key;
    EXPECT_NEAR(peak, number_of(reference[key][1]), 1e-7) << key;
  };
  check("u2_peak", [&](const MotionState& s) { return tip_at(rod, s).transverse; });
  check("u1_peak", [&](const MotionState& s) { return tip_at(rod, s).axial; });
  check("alpha_peak", [&](const MotionState& s) { return tip_at(rod, s).rotation; });
}

/// Turning steadily, a rod stretches by N = EA u' under its own centrifugal force:
/// u'' + k^2 (x + u) = 0, k^2 = rho w^2 / E, so that u(L) = tan(kL)/k - L. A damping that acts on
/// strains alone takes the swinging out and leaves that.
TEST(SpinUp, SteadyExtension) {
  const Mechanism rod = spun_beam();
  TransientStudy study = transient(40.0, 40, 1e-7);
  study.damping.stiffness = 0.1;
  const double k = last_speed * std::sqrt(1.2 / 2.8e7);
  const double truth = std::tan(k * length) / k - length;
  for (const auto& settings : {exact_modes(6), beam(4, 3)}) {
    const ModelingMotion motion = move(rod, study, settings);
    const Tip tip = tip_at(rod, motion.states.back());
    note_measured(settings.label + "_axial", std::abs(tip.axial - truth));
    note_measured(settings.label + "_transverse", std::abs(tip.transverse));
    EXPECT_NEAR(tip.axial, truth, 2e-9) << settings.label;
    EXPECT_NEAR(tip.transverse, 0.0, 2e-9) << settings.label;
  }
}

}  // namespace
}  // namespace flexura::testing

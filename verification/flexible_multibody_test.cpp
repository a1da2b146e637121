// Flexible bodies in large motion: the spin-up manoeuvre (Simo and
// Vu-Quoc, J. Appl. Mech. 53, 1986), a swinging and a driven flexible link.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/studies/transient_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"
#include "tests/support/reference.hpp"

namespace flexura::testing {
namespace {

using Method = TransientStudy::Method;

ModelingMotion move(const Model& model, const TransientStudy& study,
                    const ModelingSettings& settings) {
  ModelingMotion motion = run_transient(model, study, settings, [](double) { return true; });
  EXPECT_TRUE(motion.termination.converged()) << settings.label << motion.termination.reason;
  return motion;
}

TransientStudy study_of(double duration, int outputs, double tolerance) {
  TransientStudy study;
  study.duration = duration;
  study.outputs = outputs;
  study.tolerance = tolerance;
  study.estimate = false;
  return study;
}

/// Largest differences of two motions at a body, by that of its displacements.
double apart(const ModelingMotion& a, const ModelingMotion& b, std::size_t body) {
  EXPECT_EQ(a.states.size(), b.states.size());
  double gap = 0.0, size = 0.0;
  for (std::size_t k = 0; k < std::min(a.states.size(), b.states.size()); ++k) {
    const Vec2 here = a.states[k].state.bodies[body].position;
    gap = std::max(gap, norm(here - b.states[k].state.bodies[body].position));
    size = std::max(size, norm(here - a.states[0].state.bodies[body].position));
  }
  return gap / size;
}

// --- spin-up ---

double hub_angle(double t) {
  const double c = 15.0 / (2.0 * std::numbers::pi);
  return t <= 15.0 ? 0.4 * (0.5 * t * t + c * c * (std::cos(t / c) - 1.0)) : 6.0 * t - 45.0;
}

Mechanism spinning_beam() {
  GeneralSection section;
  section.area = 1.0;
  section.second_moment = 5e-4;
  section.shear_area = 1.0;
  Mechanism beam;
  beam.material(2.8e7, 0.4).density(1.2).section(section).fixed("ground");
  beam.body("hub").centre({0.0, 0.0}).body("tip");
  beam.flexure("hub", "tip", LineAxis{{0.0, 0.0}, {10.0, 0.0}});
  beam.turn("hub", 1.0, FunctionHistory{hub_angle});
  return beam;
}

struct SpinUp {
  double u1 = 0.0, u2 = 0.0, alpha = 0.0;  ///< largest errors
  double extension = 0.0;                  ///< at the end
};

SpinUp spin_up(const ModelingSettings& settings, const TransientStudy& study) {
  const ReferenceTable table("dynamics/case5_spinup_tip.csv");
  const ModelingMotion motion = move(spinning_beam(), study, settings);
  SpinUp found;
  for (std::size_t row = 0; row < std::min<std::size_t>(table.size(), 200); ++row) {
    const MotionState& state = motion.states.at(row + 1);
    EXPECT_NEAR(state.time, table.number(row, "t"), 1e-9);
    const double psi = hub_angle(state.time);
    const Vec2 tip = rotate(-psi, state.state.bodies[1].position);
    found.u1 = std::max(found.u1, std::abs(tip.x - 10.0 - table.number(row, "u1_axial")));
    found.u2 = std::max(found.u2, std::abs(tip.y - table.number(row, "u2_transverse")));
    found.alpha = std::max(found.alpha, std::abs(state.state.bodies[1].rotation - psi -
                                                 table.number(row, "alpha_rel_rotation")));
    found.extension = tip.x - 10.0;
  }
  note_measured("u1_" + settings.label, found.u1);
  note_measured("u2_" + settings.label, found.u2);
  note_measured("alpha_" + settings.label, found.alpha);
  return found;
}

/// The reference is good to 2e-8, of a largest displacement of 0.57.
TEST(SpinUpManoeuvre, ExactMatchesTheReference) {
  const SpinUp found = spin_up(exact_modes(8), study_of(20.0, 200, 1e-8));
  EXPECT_LT(found.u1, 2e-8);
  EXPECT_LT(found.u2, 2e-7);
  EXPECT_LT(found.alpha, 1e-7);
}

TEST(SpinUpManoeuvre, CubicElementsMatchTheReference) {
  const SpinUp found = spin_up(beam(6, 3), study_of(20.0, 200, 1e-6));
  EXPECT_LT(found.u1, 1e-5);
  EXPECT_LT(found.u2, 1e-4);
  EXPECT_LT(found.alpha, 1e-5);
}

/// Of second order: a step of 0.01 leaves 5e-5 (a hundredth of a percent of the deflection).
TEST(SpinUpManoeuvre, GeneralizedAlphaMatchesToItsOrder) {
  TransientStudy study = study_of(20.0, 200, 0.0);
  study.method = Method::generalized_alpha;
  study.step = 0.02;
  const double coarse = spin_up(exact_modes(6), study).u2;
  study.step = 0.01;
  const double fine = spin_up(exact_modes(6), study).u2;
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

// --- swinging and driven links ---

/// A rubber rod of 1 m on a pin, let go as it lies: that is a step of load, whose highest
/// frequencies no discretisation carries, and on these the modelings differ.
TEST(SwingingPendulum, ModelingsAgreeAndEnergyIsKept) {
  Mechanism rod;
  rod.material(5e6, 0.5).density(1100.0).section(CircleSection{0.02});
  rod.fixed("ground").body("pivot").body("tip");
  rod.flexure("pivot", "tip", LineAxis{{0.0, 0.0}, {1.0, 0.0}}).pin("ground", "pivot", {0.0, 0.0});
  TransientStudy study = study_of(0.6, 30, 1e-6);
  study.fields.gravity = {0.0, -9.81};
  const ModelingMotion a = move(rod, study, exact_modes(8));
  const ModelingMotion b = move(rod, study, beam(3, 5));
  note_measured("apart", apart(a, b, 1));
  note_measured("energy", a.energy_error);
  EXPECT_LT(apart(a, b, 1), 5e-4);
  EXPECT_LT(a.energy_error, 1e-5);
  for (const MotionState& state : a.states) EXPECT_LT(state.energy.drift, 1e-8);
  study.method = Method::energy_momentum;
  study.step = 2e-3;
  EXPECT_LT(move(rod, study, exact_modes(6)).energy_error, 1e-9);
}

/// Crank 0.15 m, connecting rod 0.3 m; the slider's place is that of the rigid mechanism up to what
/// the rod bends, and that falls with its stiffness.
double slider_off_rigid(double modulus, const ModelingSettings& settings,
                        ModelingMotion* motion = nullptr) {
  constexpr double crank = 0.15, rod = 0.3, speed = 20.0;
  Mechanism machine;
  machine.material(modulus, 0.3).density(7870.0).section(CircleSection{0.006});
  machine.fixed("ground").body("crank").centre({0.0, 0.0});
  machine.body("pin").body("slider").mass(0.05).centre({crank + rod, 0.0});
  machine.flexure("pin", "slider", LineAxis{{crank, 0.0}, {crank + rod, 0.0}}).pin_action();
  machine.pin("crank", "pin", {crank, 0.0}).slide("ground", "slider", {1.0, 0.0});
  machine.turn("crank", speed, LinearHistory{});
  const ModelingMotion run = move(machine, study_of(0.4, 80, 1e-7), settings);
  double off = 0.0;
  for (const MotionState& state : run.states) {
    const double angle = speed * state.time;
    const double rigid =
        crank * std::cos(angle) + std::sqrt(rod * rod - std::pow(crank * std::sin(angle), 2));
    const Vec2 at = state.state.bodies[2].position;
    EXPECT_NEAR(at.y, 0.0, 1e-9);
    off = std::max(off, std::abs(at.x - rigid));
  }
  if (motion != nullptr) *motion = run;
  return off;
}

/// The crank turns at full speed from the start.
TEST(FlexibleSliderCrank, ModelingsAgree) {
  ModelingMotion a, b;
  slider_off_rigid(2e9, exact_modes(8), &a);
  slider_off_rigid(2e9, beam(4, 4), &b);
  note_measured("apart", apart(a, b, 2));
  EXPECT_LT(apart(a, b, 2), 5e-5);
}

TEST(FlexibleSliderCrank, TendsToTheRigidMechanism) {
  const double soft = slider_off_rigid(2e10, exact_modes(6));
  const double stiff = slider_off_rigid(2e12, exact_modes(6));
  note_measured("soft", soft);
  note_measured("stiff", stiff);
  EXPECT_GT(soft, 30.0 * stiff);
  EXPECT_LT(stiff, 2e-6);
}

}  // namespace
}  // namespace flexura::testing

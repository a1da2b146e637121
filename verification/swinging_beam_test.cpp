// A flexible rod that swings about a pin under its own weight.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "flexura/studies/modes_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double g = 9.81;

/// Rubber, 1 m long, pinned to the ground at the origin, hanging. 5 mm thick it swings once in 1.6
/// s and bends once in 0.4 s.
Mechanism hanging_rod(double thickness) {
  Mechanism pendulum;
  pendulum.material(5e8, 0.4).density(1000.0).section(RectangleSection{thickness, 0.02});
  pendulum.fixed("ground").body("end");
  pendulum.flexure("ground", "end", LineAxis{{0.0, 0.0}, {0.0, -1.0}}).pin_base();
  return pendulum;
}

TransientStudy under_gravity(TransientStudy study) {
  study.fields.gravity = {0.0, -g};
  return study;
}

/// A push of 2 N at its end that comes and goes smoothly throws it up, bent. The two modelings
/// share no interpolation, and meet at what the tolerance of steps leaves. (A rod without axial
/// strain: the step by which gravity stretches another runs through it as a wave with a kink, which
/// no modeling resolves to better than 1e-5.)
TEST(SwingingBeam, ModelingsAgreeAndKeepTheEnergy) {
  const Mechanism pendulum = hanging_rod(0.005);
  TransientStudy study = under_gravity(transient(1.5, 30, 1e-9));
  study.loads = {pendulum.load("end", {2.0, 0.0}), pendulum.load("end", {-2.0, 0.0})};
  study.loads[0].history = RampHistory{0.0, 0.3, true};
  study.loads[1].history = RampHistory{0.3, 0.6, true};
  const ModelingMotion modal = move(pendulum, study, in_theory(exact_modes(14), "i"));
  const ModelingMotion elements = move(pendulum, study, in_theory(beam(8, 5), "i"));
  ASSERT_EQ(modal.states.size(), elements.states.size());
  double apart = 0.0, bent = 0.0, swung = 0.0;
  for (std::size_t k = 0; k < modal.states.size(); ++k) {
    const Pose a = pose_at(pendulum, modal.states[k], "end");
    const Pose b = pose_at(pendulum, elements.states[k], "end");
    apart = std::max(apart, norm(a.position - b.position));
    const Vec2 middle = modal.states[k].state.mids[0].position;
    bent = std::max(bent, norm(middle - 0.5 * a.position));
    swung = std::max(swung, a.position.x);
  }
  note_measured("apart", apart);
  note_measured("bent", bent);
  note_measured("swung", swung);
  note_measured("energy_exact", modal.energy_error);
  note_measured("energy_beam", elements.energy_error);
  EXPECT_GT(bent, 0.05);
  EXPECT_GT(swung, 0.5);
  EXPECT_LT(apart, 1e-7);
  EXPECT_LT(modal.energy_error, 1e-8);
  EXPECT_LT(elements.energy_error, 1e-8);
}

/// Drawn aside by a sudden force of 1 N that stays.
TEST(SwingingBeam, EnergyStaysByEnergyMomentum) {
  const Mechanism pendulum = hanging_rod(0.02);
  TransientStudy study = in_steps(under_gravity(transient(4.0, 100, 1e-6)),
                                  TransientStudy::Method::energy_momentum, 0.005);
  study.loads = {pendulum.load("end", {1.0, 0.0})};
  for (const auto& settings : {exact_modes(6), beam(4, 2)}) {
    const ModelingMotion motion = move(pendulum, study, settings);
    note_measured(settings.label, motion.energy_error);
    EXPECT_LT(motion.energy_error, 1e-9) << settings.label;
  }
}

/// Let go from a small static deflection, a clamped rod that hangs moves as a sum of cosines of its
/// natural frequencies about the hanging state. Fitted with those of study `modes`, nothing of the
/// motion is left but the higher modes' share and the tolerance.
TEST(SwingingBeam, SmallMotionIsMadeOfItsModes) {
  constexpr double small = 1e-5;  // m at the end, about
  Mechanism pendulum;
  pendulum.material(5e7, 0.4).density(1000.0).section(RectangleSection{0.005, 0.02});
  pendulum.fixed("ground").body("end");
  pendulum.flexure("ground", "end", LineAxis{{0.0, 0.0}, {0.0, -1.0}});
  PathStudy aside;
  aside.fields.gravity = {0.0, -g};
  aside.loads = {pendulum.load("end", {0.5 * g * 0.1 * small, 0.0})};
  aside.steps = 2;
  PathStudy hanging = aside;
  hanging.loads.clear();
  Model model = pendulum;
  model.studies.push_back({"aside", aside, {}});
  model.studies.push_back({"hanging", hanging, {}});
  ModesStudy modes;
  modes.about = StudyState{1, 1.0};
  modes.count = 20;
  const ModelingModes found = run_modes(model, modes, exact_modes(10), [](double) { return true; });
  ASSERT_TRUE(found.termination.converged()) << found.termination.reason;
  TransientStudy study = under_gravity(transient(4.0, 400, 1e-10));
  study.from = StudyState{0, 1.0};
  const ModelingMotion motion = move(model, study, exact_modes(10));
  ASSERT_EQ(motion.states.size(), 401u);
  const auto rows = static_cast<Eigen::Index>(motion.states.size());
  const auto count = static_cast<Eigen::Index>(found.modes.size());
  Eigen::MatrixXd cosines(rows, count);
  Eigen::VectorXd places(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const MotionState& state = motion.states[static_cast<std::size_t>(k)];
    places[k] = pose_at(pendulum, state, "end").position.x;
    for (Eigen::Index m = 0; m < count; ++m)
      cosines(k, m) = std::cos(found.modes[static_cast<std::size_t>(m)].value * state.time);
  }
  const Eigen::VectorXd shares = cosines.colPivHouseholderQr().solve(places);
  const double left =
      (cosines * shares - places).lpNorm<Eigen::Infinity>() / places.lpNorm<Eigen::Infinity>();
  note_measured("left", left);
  note_measured("second", std::abs(shares[1] / shares[0]));
  EXPECT_LT(left, 1e-5);
  EXPECT_GT(std::abs(shares[1] / shares[0]), 1e-3);
  // were the lowest frequency a thousandth off, a hundredth would be left
  cosines.col(0) = Eigen::VectorXd::NullaryExpr(rows, [&](Eigen::Index k) {
    return std::cos(1.001 * found.modes[0].value * motion.states[static_cast<std::size_t>(k)].time);
  });
  const Eigen::VectorXd off = cosines * cosines.colPivHouseholderQr().solve(places) - places;
  EXPECT_GT(off.lpNorm<Eigen::Infinity>() / places.lpNorm<Eigen::Infinity>(), 5e-3);
}

}  // namespace
}  // namespace flexura::testing

// A slider-crank whose connecting rod bends: modelings against each other, against the small
// vibrations of a pinned Euler-Bernoulli beam carried along by the rigid mechanism, and, as the rod
// turns stiff, against the rigid mechanism itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double crank = 0.1;
constexpr double rod = 0.4;
constexpr double thickness = 0.003;
constexpr double density = 7850.0;
constexpr double steel = 210e9;

/// From the outer dead centre.
Mechanism slider_crank(double youngs_modulus, double slider_mass, double turns,
                       const TimeHistory& history) {
  Mechanism machine;
  machine.material(youngs_modulus, 0.3).density(density);
  machine.section(RectangleSection{thickness, 0.02});
  machine.fixed("ground").body("crank").centre({0.0, 0.0});
  machine.body("slider").mass(slider_mass).centre({crank + rod, 0.0});
  machine.flexure("crank", "slider", LineAxis{{crank, 0.0}, {crank + rod, 0.0}});
  machine.pin_base().pin_action().slide("ground", "slider", {1.0, 0.0});
  machine.turn("crank", turns, history);
  return machine;
}

double slider_place(const Mechanism& machine, const MotionState& state) {
  return pose_at(machine, state, "slider").position.x;
}

double rigid_place(double angle) {
  const double drop = crank * std::sin(angle);
  return crank * std::cos(angle) + std::sqrt(rod * rod - drop * drop);
}

/// Bending of the rod at its middle, off the line between its pins.
double bending(double crank_angle, const Mechanism& machine, const MotionState& state) {
  const Vec2 pin{crank * std::cos(crank_angle), crank * std::sin(crank_angle)};
  const Vec2 chord = Vec2{slider_place(machine, state), 0.0} - pin;
  const Vec2 middle = state.state.mids[0].position - pin - 0.5 * chord;
  return (chord.x * middle.y - chord.y * middle.x) / norm(chord);
}

/// One turn in 0.12 s, smoothly from rest to rest: the rod's first mode, at 280 rad/s, is shaken at
/// up to a third of that. Both modelings to the tolerance of steps.
TEST(FlexibleSliderCrank, ModelingsAgree) {
  const TimeHistory turn = RampHistory{0.0, 0.12, true};
  const Mechanism machine = slider_crank(steel, 0.2, 2.0 * pi, turn);
  const TransientStudy study = transient(0.12, 50, 1e-7);
  const ModelingMotion modal = move(machine, study, exact_modes(10));
  const ModelingMotion elements = move(machine, study, beam(10, 3));
  double bent = 0.0, apart = 0.0, sliders = 0.0;
  for (std::size_t k = 0; k < modal.states.size(); ++k) {
    const double angle = 2.0 * pi * evaluate_history(turn, modal.states[k].time).value;
    const double middle = bending(angle, machine, modal.states[k]);
    bent = std::max(bent, std::abs(middle));
    apart = std::max(apart, std::abs(bending(angle, machine, elements.states[k]) - middle));
    sliders = std::max(sliders, std::abs(slider_place(machine, modal.states[k]) -
                                         slider_place(machine, elements.states[k])));
  }
  note_measured("bending", bent / rod);
  note_measured("apart", apart / rod);
  note_measured("sliders", sliders / rod);
  note_measured("energy", modal.energy_error);
  EXPECT_GT(bent, 0.01 * rod);
  EXPECT_LT(apart, 1e-7 * rod);
  EXPECT_LT(sliders, 1e-7 * rod);
  EXPECT_LT(modal.energy_error, 1e-6);
}

/// How the rigid rod moves: its angle p with sin p = -r sin a / l, the rate of that, and the
/// acceleration across it at the crank pin and per length from there.
struct RigidRod {
  double rate = 0.0;
  double across = 0.0;
  double turning = 0.0;
};
RigidRod rigid_rod(double turns, const TimeHistory& history, double time) {
  const HistoryValue h = evaluate_history(history, time);
  const double a = turns * h.value, u = turns * h.rate, b = turns * h.second;
  const double sine = -crank / rod * std::sin(a), cosine = std::sqrt(1.0 - sine * sine);
  const double rate = -crank / rod * std::cos(a) * u / cosine;
  const double turning =
      (rate * rate * sine - crank / rod * (std::cos(a) * b - std::sin(a) * u * u)) / cosine;
  const Vec2 pin =
      crank * Vec2{-b * std::sin(a) - u * u * std::cos(a), b * std::cos(a) - u * u * std::sin(a)};
  return {rate, -sine * pin.x + cosine * pin.y, turning};
}

/// Deflection at the middle, of modes q_k sin(k pi s/l), k = 1, 3, .. 11, of the pinned beam:
///   q_k'' + (w_k^2 - p'^2) q_k = -4/(k pi) (across + l/2 turning),
/// by the classical method of Runge and Kutta. Returns it after each of `outputs` intervals.
std::vector<double> small_vibrations(double turns, const TimeHistory& history, double duration,
                                     int outputs) {
  constexpr int between = 400;
  const double h = duration / (outputs * between);
  const double unit = std::sqrt(steel * thickness * thickness / 12.0 / density);
  using State = std::array<double, 12>;
  const auto rates = [&](const State& y, double time) {
    const RigidRod motion = rigid_rod(turns, history, time);
    State rate{};
    for (std::size_t m = 0; m < 6; ++m) {
      const double k = (2.0 * static_cast<double>(m) + 1.0) * pi;
      const double w = k * k / (rod * rod) * unit;
      rate[m] = y[m + 6];
      rate[m + 6] = -(w * w - motion.rate * motion.rate) * y[m] -
                    4.0 / k * (motion.across + 0.5 * rod * motion.turning);
    }
    return rate;
  };
  const auto ahead = [](State y, double by, const State& rate) {
    for (std::size_t n = 0; n < y.size(); ++n) y[n] += by * rate[n];
    return y;
  };
  State y{};
  std::vector<double> found{0.0};
  for (int n = 0; n < outputs * between; ++n) {
    const double t = h * n;
    const State r1 = rates(y, t), r2 = rates(ahead(y, 0.5 * h, r1), t + 0.5 * h),
                r3 = rates(ahead(y, 0.5 * h, r2), t + 0.5 * h), r4 = rates(ahead(y, h, r3), t + h);
    for (std::size_t m = 0; m < y.size(); ++m)
      y[m] += h / 6.0 * (r1[m] + 2.0 * r2[m] + 2.0 * r3[m] + r4[m]);
    if ((n + 1) % between == 0) found.push_back(y[0] - y[1] + y[2] - y[3] + y[4] - y[5]);
  }
  return found;
}

/// One turn, smoothly from rest to rest, with a slider that has no mass. The small-vibration theory
/// leaves out the axial force, of the order (speed/frequency)^2 of the force that buckles the rod:
/// at half the speed the difference is a quarter.
TEST(FlexibleSliderCrank, TendsToTheSmallVibrationsOfABeam) {
  constexpr int outputs = 100;
  const auto off = [&](double duration) {
    const TimeHistory turn = RampHistory{0.0, duration, true};
    const Mechanism machine = slider_crank(steel, 0.0, 2.0 * pi, turn);
    const ModelingMotion motion =
        move(machine, transient(duration, outputs, 1e-10), in_theory(exact_modes(8), "ii"));
    const auto truth = small_vibrations(2.0 * pi, turn, duration, outputs);
    double apart = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < motion.states.size(); ++k) {
      const double angle = 2.0 * pi * evaluate_history(turn, motion.states[k].time).value;
      apart = std::max(apart, std::abs(bending(angle, machine, motion.states[k]) - truth[k]));
      largest = std::max(largest, std::abs(truth[k]));
    }
    return apart / largest;
  };
  const double fast = off(1.0);
  const double slow = off(2.0);
  note_measured("fast", fast);
  note_measured("slow", slow);
  EXPECT_LT(slow, 5e-4);
  EXPECT_NEAR(fast / slow, 4.0, 0.3);
}

/// The slider of a rod a hundred times as stiff is a hundredth as far from that of a rigid one, and
/// what turns the crank does the rigid mechanism's work.
TEST(FlexibleSliderCrank, StiffRodTendsToTheRigidMechanism) {
  const TimeHistory turn = RampHistory{0.0, 0.5, true};
  const auto off = [&](double youngs_modulus) {
    const Mechanism machine = slider_crank(youngs_modulus, 0.5, 2.0 * pi, turn);
    const ModelingMotion motion = move(machine, transient(0.5, 50, 1e-9), exact_modes(6));
    double worst = 0.0;
    for (const MotionState& state : motion.states) {
      const double angle = 2.0 * pi * evaluate_history(turn, state.time).value;
      worst = std::max(worst, std::abs(slider_place(machine, state) - rigid_place(angle)));
    }
    return worst;
  };
  const double stiff = off(100.0 * steel);
  const double stiffer = off(1e4 * steel);
  note_measured("stiff", stiff / rod);
  note_measured("stiffer", stiffer / rod);
  note_measured("ratio", stiff / stiffer);
  EXPECT_LT(stiffer, 1e-9 * rod);
  EXPECT_NEAR(stiff / stiffer, 100.0, 5.0);
}

}  // namespace
}  // namespace flexura::testing

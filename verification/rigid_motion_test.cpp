// Mechanisms of rigid bodies, against closed forms and the textbook equations of motion.
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
constexpr double g = 9.81;

/// A pendulum of inertia I about its pin, mass m at a distance d, swings from rest at an angle a
/// from below with the period 4 sqrt(I/(m g d)) K(sin(a/2)), K the complete elliptic integral. A
/// quarter of it later it hangs, with all the height it fell as speed.
TEST(RigidMotion, PhysicalPendulumOfLargeAmplitude) {
  constexpr double mass = 2.0, inertia = 0.3, distance = 0.5, amplitude = 2.6;
  Mechanism pendulum;
  pendulum.fixed("ground").body("bar").mass(mass, inertia);
  pendulum.centre({distance * std::sin(amplitude), -distance * std::cos(amplitude)});
  pendulum.pin("ground", "bar", {0.0, 0.0});
  const double about_pin = inertia + mass * distance * distance;
  const double period = 4.0 * std::sqrt(about_pin / (mass * g * distance)) *
                        std::comp_ellint_1(std::sin(0.5 * amplitude));
  TransientStudy study = transient(period, 4, 1e-9);
  study.fields.gravity = {0.0, -g};
  const ModelingMotion motion = move(pendulum, study, exact());
  ASSERT_EQ(motion.states.size(), 5u);
  const std::array turned = {0.0, -amplitude, -2.0 * amplitude, -amplitude, 0.0};
  for (std::size_t k = 0; k < 5; ++k) {
    const double rotation = pose_at(pendulum, motion.states[k], "bar").rotation;
    note_measured("quarter_" + std::to_string(k), std::abs(rotation - turned[k]));
    EXPECT_NEAR(rotation, turned[k], 1e-7) << k;
  }
  const double fallen = mass * g * distance * (1.0 - std::cos(amplitude));
  EXPECT_NEAR(motion.states[1].energy.kinetic, fallen, 1e-7 * fallen);
  EXPECT_NEAR(motion.states[1].energy.work, fallen, 1e-7 * fallen);
}

/// Crank r, rod l, slider of mass m on the line of the crank's pivot; rod of mass n and central
/// inertia j, its centre at the middle. At a constant speed w of the crank all follows from its
/// angle; the torque is what changes the kinetic energy, dT/da.
struct SliderCrank {
  double r = 0.1, l = 0.3, m = 0.8, n = 0.5, j = 0.004, w = 20.0;

  double place(double a) const { return r * std::cos(a) + std::sqrt(l * l - drop(a) * drop(a)); }
  double drop(double a) const { return r * std::sin(a); }
  /// dx/da of the slider
  double speed(double a) const {
    return -r * std::sin(a) - drop(a) * r * std::cos(a) / std::sqrt(l * l - drop(a) * drop(a));
  }
  double kinetic(double a) const {
    // the rod's angle b: sin b = -r sin a / l
    const double turning = -r * std::cos(a) / std::sqrt(l * l - drop(a) * drop(a));
    const double along = 0.5 * (-r * std::sin(a) + speed(a));
    const double across = 0.5 * r * std::cos(a);
    return 0.5 * w * w *
           (m * speed(a) * speed(a) + n * (along * along + across * across) +
            j * turning * turning);
  }
  /// dT/da by the central difference of order 6.
  double torque(double a) const {
    constexpr double h = 1e-2;
    const auto difference = [&](int k) { return kinetic(a + k * h) - kinetic(a - k * h); };
    return (45.0 * difference(1) - 9.0 * difference(2) + difference(3)) / (60.0 * h);
  }
};

struct SliderCrankErrors {
  double place = 0.0, kinetic = 0.0, work = 0.0, torque = 0.0;
  static void add(double error, double& worst) { worst = std::max(worst, std::abs(error)); }
};

/// Joints and driver decide all places, so they are right to rounding, and velocities with them.
/// Forces between the bodies, of order 2 in the step in a method of collocation, are not.
TEST(RigidMotion, SliderCrankAtConstantSpeed) {
  const SliderCrank truth;
  const double start = 0.4;
  const Vec2 pin{truth.r * std::cos(start), truth.r * std::sin(start)};
  Mechanism machine;
  machine.fixed("ground").body("crank").centre({0.0, 0.0});
  machine.body("rod").mass(truth.n, truth.j).centre(0.5 * (pin + Vec2{truth.place(start), 0.0}));
  machine.body("slider").mass(truth.m).centre({truth.place(start), 0.0});
  machine.pin("crank", "rod", pin).pin("rod", "slider", {truth.place(start), 0.0});
  machine.slide("ground", "slider", {1.0, 0.0}).turn("crank", truth.w, LinearHistory{});
  const auto errors = [&](int outputs) {
    const ModelingMotion motion =
        move(machine, transient(2.0 * pi / truth.w, outputs, 1e-6), exact());
    SliderCrankErrors worst;
    for (std::size_t k = 1; k < motion.states.size(); ++k) {
      const MotionState& state = motion.states[k];
      const double a = start + truth.w * state.time;
      worst.add(pose_at(machine, state, "slider").position.x - truth.place(a), worst.place);
      worst.add(state.energy.kinetic - truth.kinetic(a), worst.kinetic);
      worst.add(state.energy.work - truth.kinetic(a) + truth.kinetic(start), worst.work);
      worst.add(state.state.reactions.at(0).moment - truth.torque(a), worst.torque);
    }
    return worst;
  };
  const double largest = truth.kinetic(0.5 * pi);
  const SliderCrankErrors coarse = errors(200);
  const SliderCrankErrors fine = errors(400);
  note_measured("place", fine.place);
  note_measured("kinetic", fine.kinetic / largest);
  note_measured("work", fine.work / largest);
  note_measured("torque", fine.torque / largest);
  note_measured("ratio", coarse.torque / fine.torque);
  EXPECT_LT(fine.place, 1e-12);
  EXPECT_LT(fine.kinetic, 1e-10 * largest);
  EXPECT_LT(fine.work, 5e-6 * largest);
  EXPECT_LT(fine.torque, 1e-3 * largest);
  EXPECT_GT(coarse.torque / fine.torque, 3.5);
}

/// A mass on a spring and a damper under a step F: with n^2 = k/m, z = c/(2 m n) and
/// d = n sqrt(1 - z^2) it is at F/k (1 - e^{-z n t} (cos d t + z n/d sin d t)).
TEST(RigidMotion, MassOnSpringAndDamper) {
  constexpr double mass = 3.0, stiffness = 48.0, damping = 6.0, force = 12.0;
  Mechanism oscillator;
  oscillator.fixed("ground").centre({0.0, 0.0}).body("cart").mass(mass).centre({1.0, 0.0});
  oscillator.slide("ground", "cart", {1.0, 0.0});
  oscillator.spring("ground", "cart", stiffness, damping);
  TransientStudy study = transient(5.0, 100, 1e-8);
  study.loads = {oscillator.load("cart", {force, 0.0})};
  const ModelingMotion motion = move(oscillator, study, exact());
  const double n = std::sqrt(stiffness / mass);
  const double z = damping / (2.0 * mass * n);
  const double d = n * std::sqrt(1.0 - z * z);
  double place = 0.0, dissipated = 0.0;
  for (const MotionState& state : motion.states) {
    const double t = state.time, decay = std::exp(-z * n * t);
    const double x =
        force / stiffness * (1.0 - decay * (std::cos(d * t) + z * n / d * std::sin(d * t)));
    const double v = force / (mass * d) * decay * std::sin(d * t);
    place = std::max(place, std::abs(pose_at(oscillator, state, "cart").position.x - 1.0 - x));
    const double lost = force * x - 0.5 * stiffness * x * x - 0.5 * mass * v * v;
    dissipated = std::max(dissipated, std::abs(state.energy.dissipated - lost));
  }
  note_measured("place", place / (force / stiffness));
  note_measured("dissipated", dissipated / (force * force / stiffness));
  EXPECT_LT(place, 1e-7 * force / stiffness);
  EXPECT_LT(dissipated, 1e-7 * force * force / stiffness);
}

/// Two uniform rods, the second on the end of the first, from the horizontal: angles a, b from
/// below obey
///   (I + m l^2) a'' + 1/2 m l^2 (b'' cos(a - b) + b'^2 sin(a - b)) + 3/2 m g l sin a = 0
///   I b'' + 1/2 m l^2 (a'' cos(a - b) - a'^2 sin(a - b)) + 1/2 m g l sin b = 0,  I = m l^2/3.
struct DoublePendulum {
  static constexpr double m = 1.0, l = 1.0;
  using State = std::array<double, 4>;

  static State rates(const State& y) {
    const auto [a, b, u, v] = y;
    const double i = m * l * l / 3.0, c = 0.5 * m * l * l * std::cos(a - b),
                 s = 0.5 * m * l * l * std::sin(a - b);
    const double p = -s * v * v - 1.5 * m * g * l * std::sin(a);
    const double q = s * u * u - 0.5 * m * g * l * std::sin(b);
    const double k = i + m * l * l, determinant = k * i - c * c;
    return {u, v, (i * p - c * q) / determinant, (k * q - c * p) / determinant};
  }
  /// By the classical method of Runge and Kutta, of order 4.
  static State after(State y, double time, int steps) {
    const double h = time / steps;
    const auto ahead = [](State from, double by, const State& rate) {
      for (std::size_t n = 0; n < 4; ++n) from[n] += by * rate[n];
      return from;
    };
    for (int k = 0; k < steps; ++k) {
      const State r1 = rates(y), r2 = rates(ahead(y, 0.5 * h, r1)),
                  r3 = rates(ahead(y, 0.5 * h, r2)), r4 = rates(ahead(y, h, r3));
      for (std::size_t n = 0; n < 4; ++n)
        y[n] += h / 6.0 * (r1[n] + 2.0 * r2[n] + 2.0 * r3[n] + r4[n]);
    }
    return y;
  }
};

Mechanism double_pendulum() {
  constexpr double inertia = 1.0 / 12.0;
  Mechanism rods;
  rods.fixed("ground").body("upper").mass(1.0, inertia).centre({0.5, 0.0});
  rods.body("lower").mass(1.0, inertia).centre({1.5, 0.0});
  rods.pin("ground", "upper", {0.0, 0.0}).pin("upper", "lower", {1.0, 0.0});
  return rods;
}

TEST(RigidMotion, DoublePendulumObeysItsEquations) {
  const Mechanism rods = double_pendulum();
  TransientStudy study = transient(3.0, 30, 1e-9);
  study.fields.gravity = {0.0, -g};
  const ModelingMotion motion = move(rods, study, exact());
  const DoublePendulum::State drawn{0.5 * pi, 0.5 * pi, 0.0, 0.0};
  double worst = 0.0;
  for (const MotionState& state : motion.states) {
    const auto truth = DoublePendulum::after(drawn, state.time, 4000);
    worst = std::max({worst, std::abs(pose_at(rods, state, "upper").rotation - truth[0] + 0.5 * pi),
                      std::abs(pose_at(rods, state, "lower").rotation - truth[1] + 0.5 * pi)});
  }
  note_measured("angles", worst);
  note_measured("energy", motion.energy_error);
  EXPECT_LT(worst, 1e-7);
  EXPECT_LT(motion.energy_error, 1e-8);
}

/// Over a minute of motion, which nothing predicts, energy stays.
TEST(RigidMotion, DoublePendulumKeepsItsEnergy) {
  const Mechanism rods = double_pendulum();
  TransientStudy study =
      in_steps(transient(60.0, 600, 1e-6), TransientStudy::Method::energy_momentum, 0.01);
  study.fields.gravity = {0.0, -g};
  const ModelingMotion motion = move(rods, study, exact());
  note_measured("energy", motion.energy_error);
  EXPECT_LT(motion.energy_error, 1e-9);
}

}  // namespace
}  // namespace flexura::testing

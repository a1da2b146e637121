// Damping against the closed form of a single vibration: from one maximum to the next the logarithm
// of the amplitude falls by 2 pi z / sqrt(1 - z^2), z the share of critical damping.
#include <cmath>
#include <numbers>

#include "flexura/studies/modes_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
using Method = TransientStudy::Method;

/// A cart on a rail and a spring.
constexpr double mass = 3.0, stiffness = 48.0;
Mechanism cart() {
  Mechanism oscillator;
  oscillator.fixed("ground").centre({0.0, 0.0}).body("mass").mass(mass).centre({1.0, 0.0});
  oscillator.slide("ground", "mass", {1.0, 0.0}).spring("ground", "mass", stiffness);
  return oscillator;
}

/// A weight on a leaf that a slide keeps from turning: linear, it moves in one way only.
Mechanism guided_leaf() {
  Mechanism leaf;
  leaf.material(5e7, 0.4).density(1000.0).section(RectangleSection{0.01, 0.02});
  leaf.fixed("ground").body("mass").mass(0.2, 0.0);
  leaf.flexure("ground", "mass", LineAxis{{0.0, 0.0}, {0.4, 0.0}});
  leaf.slide("ground", "mass", {0.0, 1.0});
  return leaf;
}

double angular_frequency(const Mechanism& mechanism) {
  ModesStudy study;
  study.count = 1;
  const ModelingModes modes = run_modes(mechanism, study, linear(), [](double) { return true; });
  EXPECT_EQ(modes.modes.size(), 1u);
  return modes.modes.at(0).value;
}

struct Decrement {
  double share = 0.0;  // of critical damping
  double energy_error = 0.0;
};

/// Pushed suddenly by a force that stays, at the end of every period the mass is farthest from
/// where it comes to rest.
Decrement decrement(const Mechanism& mechanism, const DampingSettings& damping, Method method,
                    Vec2 force, double rest, double share) {
  const double period = 2.0 * pi / (angular_frequency(mechanism) * std::sqrt(1.0 - share * share));
  TransientStudy study = transient(3.0 * period, 3, 1e-9);
  study.method = method;
  if (method != Method::radau) study.step = period / 2000.0;
  study.damping = damping;
  study.loads = {mechanism.load("mass", force)};
  const ModelingMotion motion = move(mechanism, study, linear());
  double sum = 0.0;
  for (std::size_t k = 1; k < motion.states.size(); ++k) {
    const auto off = [&](std::size_t at) {
      const Vec2 moved = pose_at(mechanism, motion.states[at], "mass").position -
                         pose_at(mechanism, motion.states[0], "mass").position;
      return dot(moved, (1.0 / norm(force)) * force) - rest;
    };
    sum += std::log(off(k - 1) / off(k)) / 3.0;
  }
  return {sum / std::sqrt(4.0 * pi * pi + sum * sum), motion.energy_error};
}

/// By every integrator; those of second order in steps of which a period takes 2000.
void expect_share(const Mechanism& mechanism, const DampingSettings& damping, Vec2 force,
                  double rest, double share) {
  for (const Method method : {Method::radau, Method::generalized_alpha, Method::energy_momentum}) {
    const Decrement found = decrement(mechanism, damping, method, force, rest, share);
    const std::string name = std::to_string(static_cast<int>(method));
    note_measured("share_" + name, std::abs(found.share / share - 1.0));
    note_measured("energy_" + name, found.energy_error);
    EXPECT_NEAR(found.share, share, (method == Method::radau ? 1e-6 : 1e-5) * share) << name;
    EXPECT_LT(found.energy_error, method == Method::generalized_alpha ? 1e-5 : 1e-6) << name;
  }
}

/// With the damping of a spring by Rayleigh's stiffness, as by a flexure's.
TEST(TransientDamping, OfAMassOnASpring) {
  const double w = std::sqrt(stiffness / mass), force = 6.0, rest = force / stiffness;
  expect_share(cart(), {.mass = 0.5}, {force, 0.0}, rest, 0.25 / w);
  expect_share(cart(), {.stiffness = 0.05}, {force, 0.0}, rest, 0.025 * w);
  expect_share(cart(), {.mass = 0.5, .stiffness = 0.05}, {force, 0.0}, rest, 0.25 / w + 0.025 * w);
  expect_share(cart(), {.modal = 0.08}, {force, 0.0}, rest, 0.08);
}

TEST(TransientDamping, OfAMassOnAFlexure) {
  const Mechanism leaf = guided_leaf();
  const double w = angular_frequency(leaf), force = 0.01;
  const double rest =
      final_pose(leaf, {leaf.load("mass", {0.0, force})}, linear(), leaf.index("mass")).position.y;
  expect_share(leaf, {.mass = 0.5}, {0.0, force}, rest, 0.25 / w);
  expect_share(leaf, {.stiffness = 0.02}, {0.0, force}, rest, 0.01 * w);
  expect_share(leaf, {.modal = 0.08}, {0.0, force}, rest, 0.08);
}

/// A body that flies, with a sprung mass on it: damping by stiffness takes none of the momenta, by
/// mass takes them as e^{-a t}.
TEST(TransientDamping, StiffnessBrakesNoFlight) {
  Mechanism pair;
  pair.body("a").mass(1.0, 0.1).centre({0.0, 0.0}).free();
  pair.body("b").mass(2.0, 0.2).centre({1.0, 0.0}).free();
  pair.spring("a", "b", 10.0);
  TransientStudy study = transient(2.0, 20, 1e-9);
  study.damping.stiffness = 0.1;
  study.loads = {pair.load("a", {0.0, 1.0}, 0.5)};
  study.loads[0].history = HalfSineHistory{0.0, 0.5};
  const auto momenta = [&](const TransientStudy& of, std::size_t k) {
    const EnergyBalance energy = move(pair, of, exact()).states.at(k).energy;
    return std::pair{energy.momentum.y, energy.angular_momentum};
  };
  for (const Method method : {Method::radau, Method::generalized_alpha, Method::energy_momentum}) {
    study.method = method;
    if (method != Method::radau) study.step = 1e-3;
    const auto early = momenta(study, 5), late = momenta(study, 20);
    note_measured("linear_" + std::to_string(static_cast<int>(method)), late.first - early.first);
    note_measured("angular_" + std::to_string(static_cast<int>(method)),
                  late.second - early.second);
    EXPECT_NEAR(late.first, early.first, 1e-9);
    EXPECT_NEAR(late.second, early.second, method == Method::generalized_alpha ? 1e-8 : 1e-11);
    EXPECT_GT(early.first, 0.1);
  }
  study.method = Method::radau;
  study.step.reset();
  study.damping = {.mass = 0.7};
  const auto early = momenta(study, 5), late = momenta(study, 20);
  EXPECT_NEAR(late.first, early.first * std::exp(-0.7 * 1.5), 1e-7);
  EXPECT_NEAR(late.second, early.second * std::exp(-0.7 * 1.5), 1e-6);
}

}  // namespace
}  // namespace flexura::testing

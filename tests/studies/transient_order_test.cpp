// The error of every time integrator falls with the power of the step that its order promises, on
// mechanisms that turn far.
#include <cmath>

#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double g = 9.81;
using Method = TransientStudy::Method;

/// Two rods on pins, from the horizontal.
Mechanism double_pendulum() {
  Mechanism rods;
  rods.fixed("ground").body("upper").mass(1.0, 1.0 / 12.0).centre({0.5, 0.0});
  rods.body("lower").mass(1.0, 1.0 / 12.0).centre({1.5, 0.0});
  rods.pin("ground", "upper", {0.0, 0.0}).pin("upper", "lower", {1.0, 0.0});
  return rods;
}

/// A rod on a pin carries a bob by a flexure, which a damper braces; it bends so slowly (0.5 s)
/// that steps resolve it.
Mechanism flexible_pendulum() {
  Mechanism pendulum;
  pendulum.material(2e8, 0.4).density(1000.0).section(RectangleSection{0.01, 0.02});
  pendulum.fixed("ground").centre({0.0, 0.5});
  pendulum.body("upper").mass(1.0, 1.0 / 12.0).centre({0.5, 0.0});
  pendulum.body("lower").mass(0.3, 0.01).centre({1.4, 0.0});
  pendulum.pin("ground", "upper", {0.0, 0.0});
  pendulum.flexure("upper", "lower", LineAxis{{1.0, 0.0}, {1.4, 0.0}});
  pendulum.spring("ground", "lower", 2.0, 0.3);
  return pendulum;
}

struct Swing {
  const char* name;
  Mechanism mechanism;
  ModelingSettings settings;
};

Swing rigid() { return {"rigid", double_pendulum(), exact()}; }
Swing flexible() { return {"flexible", flexible_pendulum(), in_theory(exact_modes(1), "i")}; }

TransientStudy falling(double tolerance) {
  TransientStudy study = transient(1.0, 5, tolerance);
  study.fields.gravity = {0.0, -g};
  return study;
}

/// The largest difference of two motions at the outputs, of places and rotations.
double apart(const ModelingMotion& a, const ModelingMotion& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < std::min(a.states.size(), b.states.size()); ++k)
    for (std::size_t body = 0; body < a.states[k].state.bodies.size(); ++body) {
      const Pose& p = a.states[k].state.bodies[body];
      const Pose& q = b.states[k].state.bodies[body];
      worst = std::max({worst, norm(p.position - q.position), std::abs(p.rotation - q.rotation)});
    }
  return worst;
}

/// By three steps, each a fraction of the one before, what powers of the step the errors go with.
struct Orders {
  double coarse = 0.0;
  double fine = 0.0;
  double error = 0.0;  // of the finest
};

struct Steps {
  double first = 0.0;
  double ratio = 2.0;  // of one step to the next
};

Orders observed(const Swing& swing, Method method, const Steps& steps, double radius = 0.8) {
  const ModelingMotion truth = move(swing.mechanism, falling(1e-12), swing.settings);
  double errors[3];
  for (int k = 0; k < 3; ++k) {
    TransientStudy study = in_steps(falling(1e-6), method, steps.first / std::pow(steps.ratio, k));
    study.spectral_radius = radius;
    const ModelingMotion motion = move(swing.mechanism, study, swing.settings);
    EXPECT_EQ(motion.rejected, 0);
    errors[k] = apart(motion, truth);
  }
  const Orders orders{std::log(errors[0] / errors[1]) / std::log(steps.ratio),
                      std::log(errors[1] / errors[2]) / std::log(steps.ratio), errors[2]};
  note_measured(std::string(swing.name) + "_coarse", orders.coarse);
  note_measured(std::string(swing.name) + "_fine", orders.fine);
  note_measured(std::string(swing.name) + "_error", orders.error);
  return orders;
}

void expect_order(const Orders& found, double order, double margin) {
  EXPECT_NEAR(found.coarse, order, 2.0 * margin);
  EXPECT_NEAR(found.fine, order, margin);
}

/// Half the step twice would end where Newton's method leaves more than the step does.
TEST(TransientOrder, RadauIsOfFifthOrder) {
  expect_order(observed(rigid(), Method::radau, {0.025, 1.5}), 5.0, 0.2);
  expect_order(observed(flexible(), Method::radau, {0.025, 1.5}), 5.0, 0.2);
}

TEST(TransientOrder, EnergyMomentumIsOfSecondOrder) {
  expect_order(observed(rigid(), Method::energy_momentum, {0.01}), 2.0, 0.05);
  expect_order(observed(flexible(), Method::energy_momentum, {0.01}), 2.0, 0.05);
}

class GeneralizedAlphaOrder : public ::testing::TestWithParam<double> {};

TEST_P(GeneralizedAlphaOrder, IsTwo) {
  expect_order(observed(rigid(), Method::generalized_alpha, {0.01}, GetParam()), 2.0, 0.05);
  expect_order(observed(flexible(), Method::generalized_alpha, {0.01}, GetParam()), 2.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(SpectralRadii, GeneralizedAlphaOrder,
                         ::testing::Values(0.0, 0.5, 0.8, 1.0), [](const auto& tested) {
                           return "percent_" +
                                  std::to_string(static_cast<int>(100.0 * tested.param));
                         });

}  // namespace
}  // namespace flexura::testing

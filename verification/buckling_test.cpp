// Buckling against closed forms: Euler's columns (no axial or shear strain) pi^2 EI/(beta L)^2 for
// the four supports, the column with axial and shear strain along its loaded path (Haringx:
// P (1 + P/GA - P/EA) = P_E), and the sway of a portal frame, whose legs turn by
// tan(kL) = -(k L) EI_l L_c/(6 EI_c L_l) at the corners. Rounding and the modes' convergence leave
// 1e-8, the modeling's tolerance; elements converge by the order they have.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/studies/buckling_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

ModelingModes buckle(const Mechanism& mechanism, std::vector<Load> loads, ModelingSettings settings,
                     bool linearised, int count) {
  BucklingStudy study;
  study.loads = std::move(loads);
  study.linearised = linearised;
  study.count = count;
  return run_buckling(mechanism, study, settings, {});
}

Mechanism column(const Stiffness& stiffness) { return cantilever(stiffness); }

class BucklingColumn : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BucklingColumn, ::testing::Bool());

TEST_P(BucklingColumn, EulerLoads) {
  const Mechanism model = column({1.0, 1.0, 1.0});
  const auto modes =
      buckle(model, {model.load("tip", {-1.0, 0.0})}, in_theory(exact(), "i"), GetParam(), 3);
  ASSERT_TRUE(modes.termination.converged()) << modes.termination.reason;
  ASSERT_EQ(modes.modes.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    const double euler = std::pow((2 * k + 1) * M_PI / 2.0, 2);
    const double error = std::abs(modes.modes[static_cast<std::size_t>(k)].value / euler - 1.0);
    note_measured("euler_load_" + std::to_string(k + 1), error);
    EXPECT_LT(error, 1e-8);
  }
  // a quarter of a sine: displacement 1 at the tip, pi/2 its rotation's slope there
  EXPECT_NEAR(std::abs(modes.modes[0].shape.bodies[0].position.y), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(modes.modes[0].shape.bodies[0].rotation), M_PI / 2.0, 1e-7);
}

TEST(Buckling, ColumnWithAxialAndShearStrain) {
  const double axial = 400.0, shear = 150.0;
  const Mechanism model = column({axial, 1.0, shear});
  const auto modes = buckle(model, {model.load("tip", {-1.0, 0.0})}, exact(), false, 1);
  ASSERT_EQ(modes.modes.size(), 1U) << modes.termination.reason;
  // (1 - P/EA + P/GA) P = pi^2/4: the axis, shortened to 1 - P/EA, shears by P/GA of its turn
  const double euler = M_PI * M_PI / 4.0;
  const double c = 1.0 / shear - 1.0 / axial;
  const double load = (-1.0 + std::sqrt(1.0 + 4.0 * c * euler)) / (2.0 * c);
  const double error = std::abs(modes.modes[0].value / load - 1.0);
  note_measured("haringx_column", error);
  EXPECT_LT(error, 1e-8);
}

TEST(Buckling, ElementsConvergeByTwiceTheirOrder) {
  const Mechanism model = column({1e4, 1.0, 1e4});
  const std::vector<Load> loads{model.load("tip", {-1.0, 0.0})};
  const double truth = buckle(model, loads, exact(1e-12), true, 1).modes.at(0).value;
  for (const int order : {1, 2}) {
    const auto error = [&](int elements) {
      const auto modes = buckle(model, loads, beam(elements, order), true, 1);
      return std::abs(modes.modes.at(0).value / truth - 1.0);
    };
    const double observed = std::log2(error(4) / error(8));
    note_measured("buckling_order_" + std::to_string(order), observed);
    EXPECT_NEAR(observed, 2.0 * order, 0.1);
    EXPECT_NEAR(*buckle(model, loads, beam(8, order), true, 1).error_estimate / error(8), 1.0, 0.1);
  }
}

TEST(Buckling, PortalFrameSways) {
  Mechanism frame;
  with_stiffness(frame, {1.0, 1.0, 1.0});
  const double height = 1.0, width = 0.7;
  frame.fixed("ground").body("left").body("right");
  frame.flexure("ground", "left", LineAxis{{0, 0}, {0, height}});
  frame.flexure("left", "right", LineAxis{{0, height}, {width, height}});
  frame.flexure("ground", "right", LineAxis{{width, 0}, {width, height}});
  const std::vector<Load> loads{frame.load("left", {0, -1}), frame.load("right", {0, -1})};
  // antisymmetric sway: k cot(k h) = -6/width (legs and coupler of equal EI)
  double low = M_PI / 2.0, high = M_PI - 1e-9;
  for (int i = 0; i < 200; ++i) {
    const double k = 0.5 * (low + high);
    (k / std::tan(k * height) + 6.0 / width > 0.0 ? low : high) = k;
  }
  for (const bool linearised : {true, false}) {
    const auto modes = buckle(frame, loads, in_theory(exact(), "i"), linearised, 1);
    ASSERT_EQ(modes.modes.size(), 1U) << modes.termination.reason;
    const double error = std::abs(modes.modes[0].value / (low * low) - 1.0);
    note_measured(linearised ? "portal_buckling_linearised" : "portal_buckling", error);
    EXPECT_LT(error, 1e-8);
  }
}

TEST(Buckling, TwoEqualColumnsGiveTwoModes) {
  Mechanism pair;
  with_stiffness(pair, {1.0, 1.0, 1.0});
  pair.fixed("ground").body("a").body("b");
  pair.flexure("ground", "a", LineAxis{{0, 0}, {0, 1}});
  pair.flexure("ground", "b", LineAxis{{5, 0}, {5, 1}});
  const auto modes = buckle(pair, {pair.load("a", {0, -1}), pair.load("b", {0, -1})},
                            in_theory(exact(), "i"), false, 2);
  ASSERT_EQ(modes.modes.size(), 2U);
  EXPECT_NEAR(modes.modes[0].value, M_PI * M_PI / 4.0, 1e-7);
  EXPECT_NEAR(modes.modes[1].value, M_PI * M_PI / 4.0, 1e-7);
  // two different shapes
  const auto& first = modes.modes[0].shape.bodies;
  const auto& second = modes.modes[1].shape.bodies;
  const double turn =
      first[0].rotation * second[1].rotation - first[1].rotation * second[0].rotation;
  EXPECT_GT(std::abs(turn), 1e-3);
}

TEST(Buckling, ALoadThatOnlyPullsFindsNothingAndSaysSo) {
  const Mechanism model = column({1.0, 1.0, 1.0});
  const auto modes =
      buckle(model, {model.load("tip", {1.0, 0.0})}, in_theory(exact(), "i"), false, 1);
  EXPECT_TRUE(modes.modes.empty());
  EXPECT_NE(modes.termination.reason.find("reversed"), std::string::npos)
      << modes.termination.reason;
}

}  // namespace
}  // namespace flexura::testing

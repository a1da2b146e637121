// Beam elements of order p converge as h^(2p) at a flexure's ends, the exact flexure geometrically,
// and the errors that a path reports are theirs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

/// An arc of 200 degrees under force and moment at its end, which turn by a radian.
const Mechanism arc = single_flexure(ArcAxis{{0.0, 5.0}, 5.0, -1.5, 3.5});

Pose solve(const ModelingSettings& settings) {
  return final_pose(arc, {arc.load("stage", {4e-4, -9e-4}, 4e-3)}, settings, 1, 4);
}

const Pose& converged(const std::string& theory) {
  static const Pose all[] = {solve(in_theory(exact_modes(20), "i")),
                             solve(in_theory(exact_modes(20), "iii"))};
  return all[theory == "iii"];
}

struct BeamCase {
  int order;
  std::string theory;
  friend void PrintTo(const BeamCase& c, std::ostream* out) { *out << c.order << c.theory; }
};

class BeamConvergence : public ::testing::TestWithParam<BeamCase> {};

TEST_P(BeamConvergence, IsOfTwiceTheOrderAtTheEnds) {
  const auto [order, theory] = GetParam();
  int elements = order == 1 ? 16 : order == 2 ? 6 : 3;
  double before = 0.0;
  for (int level = 0; level < 3; ++level, elements *= 2) {
    const Pose pose = solve(in_theory(beam(elements, order), theory));
    const double error = distance(pose, converged(theory), 10.0);
    // beyond, rounding rules: the extensible strip is 10^6 times as stiff along as across
    if (error < 1e-11) break;
    if (before > 0.0) {
      const double rate = std::log2(before / error);
      note_measured("rate_" + std::to_string(elements), rate);
      EXPECT_NEAR(rate, 2.0 * order, 0.25 * order) << elements;
    }
    before = error;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, BeamConvergence,
                         ::testing::Values(BeamCase{1, "iii"}, BeamCase{2, "iii"},
                                           BeamCase{3, "iii"}, BeamCase{4, "iii"}, BeamCase{1, "i"},
                                           BeamCase{2, "i"}, BeamCase{3, "i"}),
                         [](const auto& test) {
                           return "order_" + std::to_string(test.param.order) + "_theory_" +
                                  test.param.theory;
                         });

/// The frames follow the elements, and what is left of rotation in them shrinks with the elements:
/// von Karman's strains tend to the exact beam's, by the second order.
TEST(VonKarmanConvergence, IsOfSecondOrderToTheExactBeam) {
  for (const std::string theory : {"ii", "iii"}) {
    double before = 0.0;
    for (int elements = 16; elements <= 128; elements *= 2) {
      const Pose pose = solve(in_theory(von_karman(elements), theory));
      const double error = distance(pose, converged(theory), 10.0);
      if (before > 0.0) {
        const double rate = std::log2(before / error);
        note_measured("rate_" + theory + "_" + std::to_string(elements), rate);
        EXPECT_NEAR(rate, 2.0, 0.15) << elements;
      }
      before = error;
    }
  }
}

/// A strip 10^4 times as long as thick bends as easily by few elements as by many: the axial
/// displacement gives way.
TEST(VonKarmanConvergence, DoesNotLock) {
  const double thin = 1e-3;
  Mechanism strip;
  strip.material(1e3, 0.3).section(RectangleSection{thin, 1.0});
  strip.fixed("ground").body("tip").flexure("ground", "tip", ArcAxis{{0.0, 5.0}, 5.0, -1.5, 2.0});
  const double load = 0.5 * 1e3 * thin * thin * thin / 12.0 / 100.0;
  const auto tip = [&](int elements) {
    return final_pose(strip, {strip.load("tip", {0.0, load})}, von_karman(elements), 1, 2);
  };
  const Pose fine = tip(64);
  EXPECT_LT(distance(tip(8), fine, 10.0), 5e-3);
  EXPECT_LT(distance(tip(32), fine, 10.0), 5e-4);
}

/// Straight elements are exact for the linear theory: one of them has the compliance matrix.
TEST(LinearBeam, OneElementHasTheComplianceMatrix) {
  const Mechanism frame = portal_frame();
  const Load load = frame.load("left", {0.28, -0.1}, 0.02);
  for (const std::string theory : {"ii", "iii"})
    for (const int elements : {1, 5}) {
      const Pose beam = final_pose(frame, {load}, in_theory(linear_beam(elements), theory), 2);
      const Pose matrix = final_pose(frame, {load}, in_theory(linear(), theory), 2);
      EXPECT_LT(distance(beam, matrix, 0.7), 1e-11) << theory << elements;
    }
}

/// Two more modes gain more and more digits: the error falls faster than geometrically.
TEST(ExactConvergence, IsSpectral) {
  double before = distance(solve(exact_modes(4)), converged("iii"), 10.0);
  double gain = 1.0;
  for (int modes = 6; modes <= 12; modes += 2) {
    const double error = distance(solve(exact_modes(modes)), converged("iii"), 10.0);
    if (error < 1e-13) break;
    EXPECT_GT(before / error, 8.0) << modes;
    gain *= before / error;
    before = error;
  }
  note_measured("gain_from_4_modes", gain);
  EXPECT_GT(gain, 1e6);
}

/// The number of modes that the tolerance chooses keeps it (down to 1e-11 of the flexure's length).
TEST(ExactConvergence, KeepsTheToleranceAskedFor) {
  const Load load = arc.load("stage", {4e-4, -9e-4}, 4e-3);
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-10}) {
    const TracedPath path = trace(arc, {load}, exact(tolerance), 10);
    const TracedPath truth = trace(arc, {load}, exact_modes(20), 10, false);
    double largest = 0.0, error = 0.0;
    for (std::size_t k = 0; k <= 10; ++k) {
      const Vec2 here = pose_in(truth, k, 1).position;
      largest = std::max(largest, norm(here - pose_in(truth, 0, 1).position));
      error = std::max(error, norm(pose_in(path, k, 1).position - here));
    }
    EXPECT_LT(error, tolerance * largest);
  }
}

/// The estimate of a mesh is within 20 % of its true error, at every order.
TEST(BeamEstimate, IsNearTheTrueError) {
  const Load load = arc.load("stage", {4e-4, -9e-4}, 4e-3);
  const Vec2 truth = converged("iii").position;
  for (const int order : {1, 2, 3, 4}) {
    const int elements = order == 1 ? 16 : 6;
    const TracedPath path = trace(arc, {load}, beam(elements, order), 4);
    ASSERT_EQ(path.states.back().errors.size(), 1U);
    const double error = norm(pose_in(path, 4, 1).position - truth);
    if (error < 1e-9) continue;
    note_measured("order_" + std::to_string(order), path.states.back().errors[0] / error);
    EXPECT_NEAR(path.states.back().errors[0], error, 0.2 * error) << order;
  }
}

}  // namespace
}  // namespace flexura::testing

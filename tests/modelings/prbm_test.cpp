// Pseudo-rigid-body chains: parameters as published, and the answers of chains that can be worked
// out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flexura/modelings/prbm.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

/// L = 1, EI = 1.
const Mechanism straight = cantilever({1e4, 1.0, 1e4});

FlexureProperties straight_properties() {
  return flexure_properties(straight, straight.model().flexures[0], true, true);
}

/// Howell, Compliant Mechanisms (2001): gamma and K_theta at n = 0 and n = 2 by the polynomials.
TEST(Howell, ParametersAreThoseOfThePolynomials) {
  EXPECT_DOUBLE_EQ(howell_parameters(0.0).radius, 0.852144);
  EXPECT_DOUBLE_EQ(howell_parameters(0.0).stiffness, 2.654855);
  EXPECT_NEAR(howell_parameters(2.0).radius, 0.841655 - 0.0067807 * 2 + 0.000438 * 4, 1e-15);
  EXPECT_NEAR(howell_parameters(2.0).stiffness,
              2.654855 - 0.0509896 * 2 + 0.0126749 * 4 - 0.00142039 * 8 + 0.0000584525 * 16, 1e-15);
  EXPECT_NEAR(howell_parameters(-2.0).stiffness,
              1.967647 + 2.616021 * 2 - 3.738166 * 4 + 2.649437 * 8 - 0.891906 * 16 + 0.113063 * 32,
              1e-14);
  EXPECT_NEAR(howell_parameters(-4.0).radius, 0.912364 - 0.0145928 * 4, 1e-15);
  EXPECT_NEAR(howell_parameters(-4.0).stiffness, 3.024112 - 0.121290 * 4 + 0.003169 * 16, 1e-14);
}

/// Outside of the fits' range their ends are used; across their seams they hardly jump.
TEST(Howell, FitsAreClampedAndNearlyContinuous) {
  EXPECT_EQ(howell_parameters(50.0).radius, howell_parameters(10.0).radius);
  EXPECT_EQ(howell_parameters(-50.0).stiffness, howell_parameters(-5.0).stiffness);
  for (const double seam : {-2.5, -1.8316, -1.0, 0.5}) {
    const HowellParameters below = howell_parameters(seam - 1e-9);
    const HowellParameters above = howell_parameters(seam + 1e-9);
    EXPECT_NEAR(below.radius, above.radius, 0.01) << seam;
    EXPECT_NEAR(below.stiffness, above.stiffness, 0.02) << seam;
  }
}

TEST(Howell, TheJointLeavesTheCharacteristicRadius) {
  const PseudoRigidChain chain =
      pseudo_rigid_chain(straight_properties(), PrbmSettings{PrbmHowell{0.0}}, {});
  ASSERT_EQ(chain.joints.size(), 1U);
  EXPECT_NEAR(chain.joints[0].x, 1.0 - 0.852144, 1e-15);
  EXPECT_NEAR(chain.stiffness[0], 0.852144 * 2.654855, 1e-15);
}

/// A transverse force F on the tip: gamma L F cos(T) = K T, tip at 1 - gamma (1 - cos T), gamma sin
/// T.
TEST(Howell, TipLoadedCantileverMatchesItsClosedForm) {
  const double gamma = 0.852144, k = gamma * 2.654855;
  const double turn = 0.6;
  const double force = k * turn / (gamma * std::cos(turn));
  const Pose tip =
      final_pose(straight, {straight.load("tip", {0.0, force})}, prbm({PrbmHowell{0.0}}), 1, 3);
  EXPECT_NEAR(tip.rotation, turn, 1e-11);
  EXPECT_NEAR(tip.position.x, 1.0 - gamma * (1.0 - std::cos(turn)), 1e-11);
  EXPECT_NEAR(tip.position.y, gamma * std::sin(turn), 1e-11);
}

/// Without a load ratio of its own the model follows the load: (-2 F, F) is n = 2.
TEST(Howell, FollowsTheLoadRatio) {
  const double n = 2.0;
  const HowellParameters p = howell_parameters(n);
  const Load load = straight.load("tip", {-n * 0.9, 0.9});
  const Pose followed = final_pose(straight, {load}, prbm({PrbmHowell{}}), 1, 5);
  const Pose given = final_pose(straight, {load}, prbm({PrbmHowell{n}}), 1, 5);
  EXPECT_LT(distance(followed, given, 1.0), 1e-8);
  // gamma L F (cos T + n sin T) = gamma K T
  const double turn = given.rotation;
  EXPECT_NEAR(0.9 * (std::cos(turn) + n * std::sin(turn)), p.stiffness * turn, 1e-10);
}

/// Under a moment alone the tip turns by M/(gamma K_theta), about 1.5164 EI/L (the literature's
/// value; so the end's turn, 1.5164 times that, is M L/EI).
TEST(Howell, EndMomentHasItsOwnParameters) {
  const Pose tip = final_pose(straight, {straight.load("tip", {}, 0.5)}, prbm({PrbmHowell{}}), 1);
  EXPECT_NEAR(tip.rotation, 0.5 / 1.5164, 1e-10);
  EXPECT_NEAR(tip.position.y, 0.7346 * std::sin(0.5 / 1.5164), 1e-10);
}

/// Su, J. Mech. Rob. 1(2) (2009) 021008: lengths 0.10, 0.35, 0.40, 0.15; k = 3.51, 2.99, 2.58.
TEST(Su, MomentTurnsEveryJointBySpringAndMoment) {
  const double moment = 0.8;
  const Pose tip = final_pose(straight, {straight.load("tip", {}, moment)}, prbm({PrbmSu{}}), 1);
  const double a = moment / 3.51, b = a + moment / 2.99, c = b + moment / 2.58;
  const Vec2 place = Vec2{0.10, 0.0} + 0.35 * unit(a) + 0.40 * unit(b) + 0.15 * unit(c);
  EXPECT_NEAR(tip.rotation, c, 1e-11);
  EXPECT_LT(norm(tip.position - place), 1e-11);
}

TEST(UserChains, SegmentsAndJointsAreTheSameChain) {
  // symmetric, so that the frame's origin, the elastic centre, is mid-length
  const PrbmSegments segments{{0.2, 0.3, 0.3, 0.2}, {3.0, 2.5, 3.0}};
  const PrbmJoints joints{{{-0.3, 0.0}, {0.0, 0.0}, {0.3, 0.0}}, {3.0, 2.5, 3.0}};
  const Load load = straight.load("tip", {-0.4, 1.1}, 0.3);
  EXPECT_LT(distance(final_pose(straight, {load}, prbm({segments}), 1, 3),
                     final_pose(straight, {load}, prbm({joints}), 1, 3), 1.0),
            1e-11);
}

/// Straight flexures have b = 0: collinear joints at L/2 -+ L sqrt(1/8), springs 3 EI/L.
TEST(EqualSprings, StraightFlexure) {
  const PseudoRigidChain chain = pseudo_rigid_chain(straight_properties(), PrbmSettings{}, {});
  ASSERT_EQ(chain.joints.size(), 3U);
  const double p = std::sqrt(1.5 / 12.0);
  EXPECT_LT(norm(chain.joints[0] - Vec2{0.5 - p, 0.0}), 1e-14);
  EXPECT_LT(norm(chain.joints[1] - Vec2{0.5, 0.0}), 1e-14);
  EXPECT_LT(norm(chain.joints[2] - Vec2{0.5 + p, 0.0}), 1e-14);
  for (const double k : chain.stiffness) EXPECT_NEAR(k, 3.0, 1e-14);
}

}  // namespace
}  // namespace flexura::testing

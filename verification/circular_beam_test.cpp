// Compliance of a circular beam against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/ellipse.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;

class CircularBeam : public ::testing::TestWithParam<double> {
 protected:
  /// Clamped at the origin, tangent +x, centre (0, r).
  FlexureProperties properties(bool axial, bool shear) const {
    Mechanism arc;
    with_stiffness(arc, {40.0, 1.7, 13.0}).fixed("ground").body("tip");
    arc.flexure("ground", "tip", ArcAxis{{0.0, radius}, radius, -0.5 * pi, GetParam()});
    return flexure_properties(arc, arc.model().flexures[0], axial, shear);
  }
  static constexpr double radius = 1.3;
};

/// Castigliano's theorem: the matrix of a tip load on an arc of angle phi, with bending, axial and
/// shear strain. 1e-13 of the diagonal: rounding.
Eigen::Matrix3d castigliano(double r, double phi, double ei, double ea, double ga) {
  const double s = std::sin(phi), c = std::cos(phi), s2 = std::sin(2.0 * phi);
  const double r2 = r * r / ei, r3 = r * r2;
  const double xx = r3 * (phi / 2 + s2 / 4 - 2 * s * c + c * c * phi);
  const double yy = r3 * (s * s * phi - 2 * s * (1 - c) + phi / 2 - s2 / 4);
  const double xy = -r3 * (s * s / 2 - s * c * phi + c * (1 - c));
  const double xm = -r2 * (s - c * phi);
  const double ym = r2 * (s * phi - (1 - c));
  const double p = phi / 2 + s2 / 4, q = phi / 2 - s2 / 4, h = s * s / 2;
  Eigen::Matrix3d m;
  m << xx + r / ea * p + r / ga * q, xy + r / ea * h - r / ga * h, xm,  //
      xy + r / ea * h - r / ga * h, yy + r / ea * q + r / ga * p, ym,   //
      xm, ym, r * phi / ei;
  return m;
}

TEST_P(CircularBeam, ComplianceMatchesCastigliano) {
  const FlexureProperties flexure = properties(true, true);
  const Vec2 end = flexure.axis.position(flexure.axis.length());
  const Eigen::Matrix3d found = compliance_matrix(flexure, end);
  const Eigen::Matrix3d truth = castigliano(radius, GetParam(), 1.7, 40.0, 13.0);
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      worst = std::max(worst,
                       std::abs(found(i, j) - truth(i, j)) / std::sqrt(truth(i, i) * truth(j, j)));
  note_measured("worst", worst);
  EXPECT_LT(worst, 1e-13);
}

/// Bending alone, g = phi/2: w = 2 r g/EI, centre at r sin g/g from the arc's, a^2 = r^2/2 (1 -
/// sin 2g/2g), b^2 = r^2 - OC^2 - a^2 (second source). b^2 of a shallow arc is a difference of
/// nearly equal numbers, hence its own scale r^2.
TEST_P(CircularBeam, EllipseMatchesItsClosedForm) {
  const FlexureProperties flexure = properties(false, false);
  const Vec2 end = flexure.axis.position(flexure.axis.length());
  const auto ellipse = make_ellipse(compliance_matrix(flexure, end), end);
  ASSERT_TRUE(ellipse);
  const double r = radius, g = 0.5 * GetParam();
  const double oc = r * std::sin(g) / g;
  const double a2 = 0.5 * r * r * (1.0 - std::sin(2.0 * g) / (2.0 * g));
  const double b2 = r * r - oc * oc - a2;
  const Vec2 towards_middle = unit(-0.5 * pi + g);
  const Vec2 centre = Vec2{0.0, r} + oc * towards_middle;
  EXPECT_NEAR(ellipse->weight, 2.0 * r * g / 1.7, 1e-14 * ellipse->weight);
  EXPECT_LT(norm(ellipse->centre - centre), 1e-14 * r);
  // which semi-axis is longer depends on the angle
  EXPECT_NEAR(std::pow(ellipse->major, 2), std::max(a2, b2), 1e-13 * r * r);
  EXPECT_NEAR(std::pow(ellipse->minor, 2), std::min(a2, b2), 1e-13 * r * r);
  const Vec2 across_symmetry = unit(g);
  const Vec2 longer = a2 > b2 ? across_symmetry : perp(across_symmetry);
  EXPECT_LT(std::abs(cross(unit(ellipse->orientation), longer)), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Verification, CircularBeam,
                         ::testing::Values(0.1, 0.5 * pi, 2.0, pi, 1.5 * pi, 5.5),
                         [](const auto& test) {
                           return std::to_string(std::lround(test.param * 180.0 / pi)) + "_degrees";
                         });

/// The cantilever everyone knows: L^3/3EI, L^2/2EI, L/EI, and L/EA, L/GA_s.
TEST(StraightBeam, ComplianceMatchesTheTextbook) {
  const Mechanism beam = cantilever({7.0, 3.0, 5.0}, 2.0);
  const Eigen::Matrix3d found =
      compliance_matrix(flexure_properties(beam, beam.model().flexures[0], true, true), {2.0, 0.0});
  Eigen::Matrix3d truth;
  truth << 2.0 / 7.0, 0.0, 0.0, 0.0, 8.0 / 9.0 + 2.0 / 5.0, 4.0 / 6.0, 0.0, 4.0 / 6.0, 2.0 / 3.0;
  EXPECT_LT((found - truth).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace flexura::testing

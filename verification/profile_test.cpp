// Sections that vary along a flexure against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "flexura/modelings/beam.hpp"
#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/exact.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double modulus = 70e3, width = 12.0;

FlexureProperties flexure_of(const Section& section, double length, bool axial = true,
                             bool shear = true) {
  Mechanism m;
  m.material(modulus, 0.33).section(section).fixed("ground").body("tip");
  m.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}});
  return flexure_properties(m, m.model().flexures[0], axial, shear);
}

FlexureProperties strip(double t, double length, const Profile& profile, bool axial = true,
                        bool shear = true) {
  return flexure_of(RectangleSection{t, width, profile}, length, axial, shear);
}

Eigen::Matrix3d flexibility(const TwoPort& port) {
  std::vector<double> internal(port.internal_size(), 0.0), scratch(port.scratch_size());
  return port.linearize(Eigen::Vector3d::Zero(), internal.data(), scratch.data()).flexibility;
}

/// theta/M and u/F of a right circular hinge, L = 2 R, beta = t/2R: the integrals of 12/(E b
/// t(x)^3) and 1/(E b t(x)) in closed form (Paros & Weisbord 1965, full form).
struct CircularHinge {
  double t, r;
  double beta() const { return t / (2.0 * r); }
  double q() const { return beta() * (2.0 + beta()); }
  double arc() const { return std::atan(std::sqrt((2.0 + beta()) / beta())); }
  double rotation() const {
    const double b = beta();
    return 3.0 / (2.0 * modulus * width * r * r * q()) *
           (1.0 / (1.0 + b) + (3.0 + 2.0 * b + b * b) / ((1.0 + b) * q()) +
            6.0 * (1.0 + b) / std::pow(q(), 1.5) * arc());
  }
  double extension() const {
    return (2.0 * (1.0 + beta()) / std::sqrt(q()) * arc() - 0.5 * pi) / (modulus * width);
  }
};

class CircularNotch : public ::testing::TestWithParam<double> {};

/// 1e-11: rounding of graded quadrature.
TEST_P(CircularNotch, LinearAndExactMatchTheClosedForm) {
  const CircularHinge hinge{2.0 * GetParam(), 2.0};
  const FlexureProperties flexure = strip(hinge.t, 2.0 * hinge.r, NotchProfile{hinge.r, hinge.r});
  const Eigen::Matrix3d linear = compliance_matrix(flexure, {2.0 * hinge.r, 0.0});
  const Eigen::Matrix3d exact = flexibility(*make_exact_port(flexure, {}, 1e-8));
  for (const Eigen::Matrix3d& c : {linear, exact}) {
    note_measured("rotation", std::abs(c(2, 2) / hinge.rotation() - 1.0));
    note_measured("extension", std::abs(c(0, 0) / hinge.extension() - 1.0));
    EXPECT_NEAR(c(2, 2) / hinge.rotation(), 1.0, 1e-11);
    EXPECT_NEAR(c(0, 0) / hinge.extension(), 1.0, 1e-11);
  }
  EXPECT_LT((linear - exact).norm(), 1e-10 * linear.norm());
}
INSTANTIATE_TEST_SUITE_P(ThinToThick, CircularNotch, ::testing::Values(0.01, 0.05, 0.3, 1.0));

/// The profile's slope is infinite at its ends, as that of a square root: elements with Gauss
/// points of a fixed number converge with order 3/2 there, whatever theirs is.
TEST(CircularNotchBeam, ConvergesToTheClosedForm) {
  const CircularHinge hinge{0.6, 2.0};
  const FlexureProperties flexure = strip(hinge.t, 2.0 * hinge.r, NotchProfile{2.0, 2.0});
  const auto error_of = [&](int elements) {
    const Eigen::Matrix3d c = flexibility(*make_beam_port(flexure, BeamSettings{elements, 3}));
    return std::abs(c(2, 2) / hinge.rotation() - 1.0);
  };
  const double coarse = error_of(100), fine = error_of(400);
  note_measured("100 elements", coarse);
  note_measured("400 elements", fine);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 1.5, 0.1);
  EXPECT_LT(fine, 5e-8);  // measured 2.3e-8
}

/// By the double-exponential (tanh-sinh) rule.
template <class Function>
double integrate(const Function& f, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), step = 1.0 / 128.0;
  double sum = 0.0;
  for (int k = -512; k <= 512; ++k) {
    const double u = 0.5 * pi * std::sinh(k * step);
    sum += f(middle + half * std::tanh(u)) * std::cosh(k * step) / std::pow(std::cosh(u), 2);
  }
  return 0.5 * pi * step * half * sum;
}

/// What the integrals of 1/t^3, x^2/t^3 and 1/t over a symmetric hinge make of the compliance of
/// its end, x from the middle.
Eigen::Matrix3d end_compliance(double rotation, double second, double extension, double length) {
  const double shear = extension * 2.0 * (1.0 + 0.33) * 6.0 / 5.0;
  Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
  c(0, 0) = extension;
  c(1, 1) = 0.25 * length * length * rotation + second + shear;
  c(1, 2) = c(2, 1) = 0.5 * length * rotation;
  c(2, 2) = rotation;
  return c;
}

/// 1e-12: both quadratures round to some 1e-14.
void expect_compliance(const FlexureProperties& flexure, const Eigen::Matrix3d& truth) {
  const Eigen::Matrix3d linear = compliance_matrix(flexure, {flexure.axis.length(), 0.0});
  const Eigen::Matrix3d exact = flexibility(*make_exact_port(flexure, {}, 1e-10));
  for (const Eigen::Matrix3d& c : {linear, exact})
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {1, 2}, {2, 2}}) {
      note_measured("c" + std::to_string(i) + std::to_string(j), c(i, j) / truth(i, j) - 1.0);
      EXPECT_NEAR(c(i, j) / truth(i, j), 1.0, 1e-12) << i << j;
    }
}

/// Integral of 12 x^2/(E b t^3) over both fillets, `inner` from the middle where they begin.
double second_of_fillets(const CircularHinge& hinge, double inner) {
  const auto at = [&](double angle) {
    const double x = inner + hinge.r * std::sin(angle);
    const double t = hinge.t + 2.0 * hinge.r * (1.0 - std::cos(angle));
    return 12.0 * x * x / (modulus * width * t * t * t) * hinge.r * std::cos(angle);
  };
  return 2.0 * integrate(at, 0.0, 0.5 * pi);
}

/// An ellipse is a circle of radius b drawn out along the axis by a/b: the integrals grow by a/b,
/// those of x^2 by its cube.
TEST(EllipticNotch, IsACircularOneDrawnOut) {
  for (const auto& [t, a, b] :
       {std::array{0.6, 3.0, 1.0}, {0.6, 1.0, 2.5}, {0.05, 4.0, 2.0}, {3.0, 2.0, 1.5}}) {
    const CircularHinge circle{t, b};
    const double by = a / b;
    expect_compliance(
        strip(t, 2.0 * a, NotchProfile{a, b}),
        end_compliance(by * circle.rotation(), by * by * by * second_of_fillets(circle, 0.0),
                       by * circle.extension(), 2.0 * a));
  }
}

/// The fillets of both ends make one circular notch between them, drawn apart by the straight part,
/// which adds its own.
TEST(FilletedHinge, IsACircularNotchAndAStraightPart) {
  for (const auto& [t, r, length] :
       {std::array{0.6, 2.0, 20.0}, {0.1, 3.0, 7.0}, {2.0, 0.5, 12.0}}) {
    const double straight = length - 2.0 * r, eb = modulus * width;
    const CircularHinge circle{t, r};
    const double rotation = circle.rotation() + 12.0 * straight / (eb * t * t * t);
    const double second =
        second_of_fillets(circle, 0.5 * straight) + std::pow(straight, 3) / (eb * t * t * t);
    const double extension = circle.extension() + straight / (eb * t);
    expect_compliance(strip(t, length, FilletProfile{r}),
                      end_compliance(rotation, second, extension, length));
  }
}

/// K = 2 E b t^2.5/(9 pi sqrt R) for small t/R; its error shrinks in proportion to t/R.
TEST(CircularNotch, TendsToTheSimpleFormula) {
  double last = 0.0;
  for (const double t : {0.04, 0.02, 0.01}) {
    const FlexureProperties flexure = strip(t, 4.0, NotchProfile{2.0, 2.0});
    const double c = compliance_matrix(flexure, {4.0, 0.0})(2, 2);
    const double simple = 9.0 * pi * std::sqrt(2.0) / (2.0 * modulus * width * std::pow(t, 2.5));
    const double error = std::abs(simple / c - 1.0);
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 2.0, 0.2);
    }
    last = error;
  }
  EXPECT_LT(last, 2e-3);
}

/// Integral of (L - s)^2 12/(E b t(s)^3) with t = t0 (1 - (1 - r) s/L): with k = 1 - r,
/// 12 L^3/(E b t0^3 k^3) [ ln(1/r) - 2 r (1/r - 1) + r^2/2 (1/r^2 - 1) ].
TEST(Taper, CantileverMatchesTheIntegral) {
  const double t0 = 2.0, r = 0.25, length = 30.0, k = 1.0 - r;
  const double truth =
      12.0 * std::pow(length, 3) / (modulus * width * std::pow(t0 * k, 3)) *
      (std::log(1.0 / r) - 2.0 * r * (1.0 / r - 1.0) + 0.5 * r * r * (1.0 / (r * r) - 1.0));
  const FlexureProperties bending = strip(t0, length, TaperProfile{r * t0}, false, false);
  const Eigen::Matrix3d linear = compliance_matrix(bending, {length, 0.0});
  const Eigen::Matrix3d exact = flexibility(*make_exact_port(bending, {}, 1e-8));
  const Eigen::Matrix3d beam = flexibility(*make_beam_port(bending, BeamSettings{64, 3}));
  EXPECT_NEAR(linear(1, 1) / truth, 1.0, 1e-12);
  EXPECT_NEAR(exact(1, 1) / truth, 1.0, 1e-12);
  EXPECT_NEAR(beam(1, 1) / truth, 1.0, 1e-9);
}

/// Width w = w0 (1 - k s/L), k = 1 - r: with EI0 = E w0 t^3/12 and EA0 = E w0 t,
///     u/F = L/(EA0 k) ln(1/r),    theta/M = L/(EI0 k) ln(1/r),
///     theta/F = L^2/(EI0 k^2) [1 - r - r ln(1/r)],
///     w/F = L^3/(EI0 k^3) [(1 - r^2)/2 - 2 r (1 - r) + r^2 ln(1/r)] + 12/5 (1 + nu) u/F.
struct WidthTaper {
  double t, r, length;
  Eigen::Matrix3d compliance() const {
    const double k = 1.0 - r, l = length, log = std::log(1.0 / r);
    const double ea = modulus * width * t, ei = ea * t * t / 12.0;
    Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
    c(0, 0) = l / (ea * k) * log;
    c(2, 2) = l / (ei * k) * log;
    c(1, 2) = c(2, 1) = l * l / (ei * k * k) * (k - r * log);
    c(1, 1) = l * l * l / (ei * k * k * k) * (0.5 * (1.0 - r * r) - 2.0 * r * k + r * r * log) +
              2.4 * (1.0 + 0.33) * c(0, 0);
    return c;
  }
};

class WidthTaperTest : public ::testing::TestWithParam<double> {};

/// 1e-12: both quadratures round to some 1e-14. Displacements of slender elements lose digits with
/// their number: few of high order.
TEST_P(WidthTaperTest, MatchesTheClosedForm) {
  const WidthTaper taper{0.5, GetParam(), 30.0};
  const FlexureProperties flexure = flexure_of(
      RectangleSection{taper.t, width, LeafProfile{}, TaperProfile{width * taper.r}}, taper.length);
  const Eigen::Matrix3d truth = taper.compliance();
  expect_compliance(flexure, truth);
  const Eigen::Matrix3d beam = flexibility(*make_beam_port(flexure, BeamSettings{4, 8}));
  note_measured("beam", std::abs(beam(1, 1) / truth(1, 1) - 1.0));
  EXPECT_NEAR(beam(1, 1) / truth(1, 1), 1.0, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Ratios, WidthTaperTest, ::testing::Values(0.1, 0.5, 3.0));

/// The triangle of constant strength bends to a circle, w/F = L^3/(2 EI0), half as much again as
/// the strip; ours ends 1e-12 of its width short of the point.
TEST(WidthTaper, TriangleBendsToACircle) {
  const double t = 0.5, length = 30.0, tip = 1e-12;
  const FlexureProperties flexure = flexure_of(
      RectangleSection{t, width, LeafProfile{}, TaperProfile{tip * width}}, length, false, false);
  const double stiffness = modulus * width * t * t * t / 12.0;
  const Eigen::Matrix3d linear = compliance_matrix(flexure, {length, 0.0});
  const Eigen::Matrix3d exact = flexibility(*make_exact_port(flexure, {}, 1e-8));
  for (const Eigen::Matrix3d& c : {linear, exact}) {
    EXPECT_NEAR(c(1, 1) * 2.0 * stiffness / std::pow(length, 3), 1.0, 1e-11);
    EXPECT_NEAR(c(1, 2) * stiffness / std::pow(length, 2), 1.0, 1e-10);
  }
}

/// Thickness and width at once: 1/A = 1/(t w) by partial fractions of two tapers, and a piecewise
/// width under a notch, which breaks where either does.
TEST(WidthTaper, JoinsAProfileOfTheThickness) {
  const double t0 = 0.8, rt = 0.25, rw = 0.5, length = 20.0;
  const double kt = 1.0 - rt, kw = 1.0 - rw;
  const FlexureProperties both = flexure_of(
      RectangleSection{t0, width, TaperProfile{rt * t0}, TaperProfile{rw * width}}, length);
  const double extension =
      length / (modulus * width * t0 * (kt - kw)) * (std::log(1.0 / rt) - std::log(1.0 / rw));
  EXPECT_NEAR(compliance_matrix(both, {length, 0.0})(0, 0) / extension, 1.0, 1e-12);
  EXPECT_NEAR(flexibility(*make_exact_port(both, {}, 1e-10))(0, 0) / extension, 1.0, 1e-12);

  const CircularHinge hinge{0.6, 2.0};
  const PiecewiseProfile waist{{{0.0, 1.0}, {0.5, 3.0}, {1.0, 1.0}}};
  const FlexureProperties notched =
      flexure_of(RectangleSection{hinge.t, width, NotchProfile{hinge.r, hinge.r}, waist}, 4.0);
  const auto rotation = [&](double x) {  // x from the middle
    const double t = hinge.t + 2.0 * hinge.r * (1.0 - std::sqrt(1.0 - std::pow(x / hinge.r, 2)));
    return 24.0 / (modulus * width * (3.0 - 2.0 * x / hinge.r) * t * t * t);
  };
  const double sum = integrate(rotation, 0.0, hinge.r);
  EXPECT_NEAR(compliance_matrix(notched, {4.0, 0.0})(2, 2) / sum, 1.0, 1e-11);
}

/// A profile that does not vary is no profile, for every flexure's matrix and large loads.
TEST(Profile, ConstantOnesAreNone) {
  const FlexureProperties plain = strip(1.0, 20.0, LeafProfile{});
  const FlexureProperties even =
      strip(1.0, 20.0, PiecewiseProfile{{{0.0, 1.0}, {0.3, 1.0}, {1.0, 1.0}}});
  ASSERT_FALSE(plain.varying);
  ASSERT_TRUE(even.varying);
  const Eigen::Matrix3d a = compliance_matrix(plain, {20.0, 0.0});
  EXPECT_LT((compliance_matrix(even, {20.0, 0.0}) - a).norm(), 1e-13 * a.norm());
  const auto port_a = make_exact_port(plain, ExactSettings{8}, 1e-8);
  const auto port_b = make_exact_port(even, ExactSettings{8}, 1e-8);
  std::vector<double> y(port_a->internal_size(), 0.1), scratch(port_a->scratch_size());
  const Eigen::Vector3d load(3.0, 200.0, 50.0);
  const TipResponse p = port_a->linearize(load, y.data(), scratch.data());
  const TipResponse q = port_b->linearize(load, y.data(), scratch.data());
  EXPECT_LT((p.tip - q.tip).norm(), 1e-11 * p.tip.norm());
  EXPECT_LT((p.flexibility - q.flexibility).norm(), 1e-11 * p.flexibility.norm());
}

}  // namespace
}  // namespace flexura::testing

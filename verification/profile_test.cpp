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

FlexureProperties strip(double t, double length, const Profile& profile, bool axial = true,
                        bool shear = true) {
  Mechanism m;
  m.material(modulus, 0.33)
      .section(RectangleSection{t, width, profile})
      .fixed("ground")
      .body("tip");
  m.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}});
  return flexure_properties(m, m.model().flexures[0], axial, shear);
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

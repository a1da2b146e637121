// Second-order jets against derivatives written by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/core/jet2.hpp"

namespace flexura {
namespace {

using Jet = Jet2<3>;
using std::cos;
using std::sin;
using std::sqrt;

constexpr double x = 0.7, y = -1.3, z = 2.1;
const Jet jx = Jet::variable(0, x);
const Jet jy = Jet::variable(1, y);
const Jet jz = Jet::variable(2, z);

/// Value, gradient and lower triangle of the Hessian (xx, yx, yy, zx, zy, zz).
void expect_jet(const Jet& jet, double value, std::array<double, 3> gradient,
                std::array<double, 6> hessian) {
  const auto near = [](double found, double expected) {
    EXPECT_NEAR(found, expected, 4e-15 * (1.0 + std::abs(expected)));
  };
  near(jet.value, value);
  for (std::size_t i = 0; i < 3; ++i) near(jet.gradient[i], gradient[i]);
  for (std::size_t k = 0; k < 6; ++k) near(jet.hessian[k], hessian[k]);
}

TEST(Jet2, VariablesAndConstants) {
  expect_jet(jy, y, {0, 1, 0}, {});
  expect_jet(Jet(5.0), 5.0, {}, {});
}

TEST(Jet2, SumsAndScalars) {
  expect_jet(2.0 * jx - jy / 4.0 + 1.0 - (3.0 - jz), 2 * x - y / 4 - 2 + z, {2, -0.25, 1}, {});
  expect_jet(1.0 + (-jx) + 0.5, 1.5 - x, {-1, 0, 0}, {});
  Jet sum = jx;
  sum += jy;
  sum *= 3.0;
  expect_jet(sum - 1.0, 3 * (x + y) - 1, {3, 3, 0}, {});
}

TEST(Jet2, Products) {
  expect_jet(jx * jy * jz, x * y * z, {y * z, x * z, x * y}, {0, z, 0, y, x, 0});
  expect_jet(jx * jx, x * x, {2 * x, 0, 0}, {2, 0, 0, 0, 0, 0});
}

TEST(Jet2, Quotients) {
  const double z2 = z * z;
  const double z3 = z2 * z;
  expect_jet(jx / jz, x / z, {1 / z, 0, -x / z2}, {0, 0, 0, -1 / z2, 0, 2 * x / z3});
  expect_jet(2.0 / jz, 2 / z, {0, 0, -2 / z2}, {0, 0, 0, 0, 0, 4 / z3});
  expect_jet(inverse(jx), 1 / x, {-1 / (x * x), 0, 0}, {2 / (x * x * x), 0, 0, 0, 0, 0});
}

TEST(Jet2, ElementaryFunctions) {
  expect_jet(sin(jx * jy), sin(x * y), {y * cos(x * y), x * cos(x * y), 0},
             {-y * y * sin(x * y), cos(x * y) - x * y * sin(x * y), -x * x * sin(x * y), 0, 0, 0});
  expect_jet(cos(jz), cos(z), {0, 0, -sin(z)}, {0, 0, 0, 0, 0, -cos(z)});
  const double r = sqrt(x * x + y * y);
  const double r3 = r * r * r;
  expect_jet(sqrt(jx * jx + jy * jy), r, {x / r, y / r, 0},
             {y * y / r3, -x * y / r3, x * x / r3, 0, 0, 0});
}

TEST(Jet2, HalfSquares) {
  expect_jet(half_square(3.0, jx * jy), 1.5 * x * x * y * y, {3 * x * y * y, 3 * x * x * y, 0},
             {3 * y * y, 6 * x * y, 3 * x * x, 0, 0, 0});
}

/// Of arguments that are curved themselves, against sines, cosines and products.
TEST(Jet2, TurnedComponents) {
  const Jet angle = jx * jz, a = jy * jy * jx, b = jx * jx - jz * jy;
  const auto [along, across] = in_turned_axes(angle, a, b);
  const Jet u = a * cos(angle) + b * sin(angle), v = b * cos(angle) - a * sin(angle);
  expect_jet(along, u.value, u.gradient, u.hessian);
  expect_jet(across, v.value, v.gradient, v.hessian);
}

TEST(Jet2, SecondReadsBothTriangles) {
  const Jet product = jx * jx * jy;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(product.second(i, j), product.second(j, i));
  EXPECT_NEAR(product.second(0, 1), 2 * x, 1e-15);
}

/// Both lanes of a pack are the scalar jet at their own point.
TEST(Jet2, PacksDifferentiateAtTwoPoints) {
  using Packed = Jet2<3, Pack2>;
  const auto function = [](const auto& a, const auto& b, const auto& c) {
    return sin(a) * cos(b * c) / sqrt(c) - 2.0 * a * b + 1.0;
  };
  const double other[3] = {-0.4, 0.9, 3.3};
  const Packed pack =
      function(Packed::variable(0, Pack2{x, other[0]}), Packed::variable(1, Pack2{y, other[1]}),
               Packed::variable(2, Pack2{z, other[2]}));
  const Jet lanes[2] = {
      function(jx, jy, jz),
      function(Jet::variable(0, other[0]), Jet::variable(1, other[1]), Jet::variable(2, other[2]))};
  for (int lane = 0; lane < 2; ++lane) {
    EXPECT_DOUBLE_EQ(pack.value[lane], lanes[lane].value);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_DOUBLE_EQ(pack.gradient[i][lane], lanes[lane].gradient[i]);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_DOUBLE_EQ(pack.hessian[k][lane], lanes[lane].hessian[k]);
  }
}

}  // namespace
}  // namespace flexura

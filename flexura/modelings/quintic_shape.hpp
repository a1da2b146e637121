#pragma once

#include <array>

namespace flexura {

/// Value, slope and second derivative at x in [0, 1] of the quintic deflection with no values at
/// its ends, per end slope (two) and end second derivative (two), for an element of unit length.
/// (The first source's eq. 35 d has misprinted powers: the ramp is 10 x^3 - 15 x^4 + 6 x^5.)
struct QuinticShape {
  std::array<double, 4> value;
  std::array<double, 4> slope;
  std::array<double, 4> bend;
};

inline QuinticShape quintic_shape(double x) {
  const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  return {{x - 6 * x3 + 8 * x4 - 3 * x5, -4 * x3 + 7 * x4 - 3 * x5,
           0.5 * (x2 - 3 * x3 + 3 * x4 - x5), 0.5 * (x3 - 2 * x4 + x5)},
          {1 - 18 * x2 + 32 * x3 - 15 * x4, -12 * x2 + 28 * x3 - 15 * x4,
           0.5 * (2 * x - 9 * x2 + 12 * x3 - 5 * x4), 0.5 * (3 * x2 - 8 * x3 + 5 * x4)},
          {-36 * x + 96 * x2 - 60 * x3, -24 * x + 84 * x2 - 60 * x3,
           0.5 * (2 - 18 * x + 36 * x2 - 20 * x3), 0.5 * (6 * x - 24 * x2 + 20 * x3)}};
}

}  // namespace flexura

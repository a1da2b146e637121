#pragma once

#include <cmath>

namespace flexura {

/// Stress in the plane of motion, and that across it, `zz`, which is zero in thin plates.
struct PlaneStress {
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  double zz = 0.0;

  friend constexpr bool operator==(const PlaneStress&, const PlaneStress&) = default;
};

constexpr PlaneStress operator+(const PlaneStress& a, const PlaneStress& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.xy + b.xy, a.zz + b.zz};
}
constexpr PlaneStress operator*(double k, const PlaneStress& a) {
  return {k * a.xx, k * a.yy, k * a.xy, k * a.zz};
}
constexpr PlaneStress operator-(const PlaneStress& a, const PlaneStress& b) {
  return a + (-1.0) * b;
}

/// The same stress in axes from which those of `local` are turned by the angle of cosine `c` and
/// sine `s`.
constexpr PlaneStress turned(double c, double s, const PlaneStress& local) {
  return {c * c * local.xx + s * s * local.yy - 2.0 * c * s * local.xy,
          s * s * local.xx + c * c * local.yy + 2.0 * c * s * local.xy,
          c * s * (local.xx - local.yy) + (c * c - s * s) * local.xy, local.zz};
}

/// Of the stress in the plane: first the algebraically larger one, `angle` from the x axis to its
/// direction, in (-pi/2, pi/2].
struct PrincipalStress {
  double first = 0.0;
  double second = 0.0;
  double angle = 0.0;
};

inline PrincipalStress principal_stress(const PlaneStress& s) {
  const double mean = 0.5 * (s.xx + s.yy);
  const double radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
  return {mean + radius, mean - radius, 0.5 * std::atan2(2.0 * s.xy, s.xx - s.yy)};
}

inline double von_mises_stress(const PlaneStress& s) {
  const double a = s.xx - s.yy, b = s.yy - s.zz, c = s.zz - s.xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s.xy * s.xy);
}

}  // namespace flexura

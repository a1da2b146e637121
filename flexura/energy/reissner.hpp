#pragma once

#include <array>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// Geometrically exact planar beam (Reissner) with axial force and shear as the unknowns
/// (Hellinger-Reissner): the potential per length of a section whose tangent is at the angle theta,
/// under the force (fx, fy) that the part ahead exerts on it,
///     -f.t - 1/2 [ (f.t)^2/EA + (f.n)^2/GA_s ].
/// Its derivative by f is minus the tangent of the deformed axis, (1 + eps) t + gamma n with
/// eps = f.t/EA and gamma = f.n/GA_s. Compliances may be zero: nothing locks.
/// (Numbers, or lanes of them where a scalar has lanes with sections of their own.)
template <class Scalar, class Compliance>
Scalar reissner_mixed_potential(const Scalar& theta, const Scalar& fx, const Scalar& fy,
                                const Compliance& axial_compliance,
                                const Compliance& shear_compliance) {
  const auto [ft, fn] = in_turned_axes(theta, fx, fy);
  return -(ft + half_square(axial_compliance, ft) + half_square(shear_compliance, fn));
}

/// Derivative of the deformed axis by the arc length: (1 + eps) t + gamma n, where the section's
/// tangent is at the angle theta.
template <class Scalar>
struct AxisSlope {
  Scalar x;
  Scalar y;
};
template <class Scalar>
AxisSlope<Scalar> reissner_axis_slope(const Scalar& theta, const Scalar& stretch,
                                      const Scalar& gamma) {
  using std::cos, std::sin;
  const Scalar c = cos(theta);
  const Scalar s = sin(theta);
  return {stretch * c - gamma * s, stretch * s + gamma * c};
}

/// Its derivatives by angle, stretch and shear: it turns with the angle and is linear in the rest.
inline std::array<Vec2, 3> reissner_slopes(double theta, double stretch, double gamma) {
  const Vec2 t = unit(theta);
  return {stretch * perp(t) - gamma * t, t, perp(t)};
}

/// Stiffnesses of a section: EA, GA_s, EI.
struct SectionStiffness {
  double axial = 0.0;
  double shear = 0.0;
  double bending = 0.0;
};

/// The same beam in displacements: strain energy per length from the derivative (dx, dy) of the
/// position by the arc length of the undeformed axis, the angle theta of the section's normal
/// direction, and the curvature change kappa. `stretch` is the length of (dx, dy) at rest: 1 on the
/// true axis, a little less on an interpolated one.
template <class Scalar, class Stretch>
Scalar reissner_strain_energy(const Scalar& dx, const Scalar& dy, const Scalar& theta,
                              const Scalar& kappa, const SectionStiffness& section,
                              const Stretch& stretch) {
  const auto [along, gamma] = in_turned_axes(theta, dx, dy);
  return half_square(section.axial, along - stretch) + half_square(section.shear, gamma) +
         half_square(section.bending, kappa);
}

}  // namespace flexura

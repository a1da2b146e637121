#pragma once

#include <cmath>

namespace flexura {

/// Geometrically exact planar beam (Reissner) with axial force and shear as the unknowns
/// (Hellinger-Reissner): the potential per length of a section whose tangent is at the angle theta,
/// under the force (fx, fy) that the part ahead exerts on it,
///     -f.t - 1/2 [ (f.t)^2/EA + (f.n)^2/GA_s ].
/// Its derivative by f is minus the tangent of the deformed axis, (1 + eps) t + gamma n with
/// eps = f.t/EA and gamma = f.n/GA_s. Compliances may be zero: nothing locks.
template <class Scalar>
Scalar reissner_mixed_potential(const Scalar& theta, const Scalar& fx, const Scalar& fy,
                                double axial_compliance, double shear_compliance) {
  using std::cos;
  using std::sin;
  const Scalar c = cos(theta);
  const Scalar s = sin(theta);
  const Scalar ft = fx * c + fy * s;
  const Scalar fn = fy * c - fx * s;
  return -ft - 0.5 * (axial_compliance * (ft * ft) + shear_compliance * (fn * fn));
}

/// The same with compliances that differ from lane to lane of the scalar: varying sections.
template <class Scalar, class Lanes>
Scalar reissner_mixed_potential_by_lane(const Scalar& theta, const Scalar& fx, const Scalar& fy,
                                        const Lanes& axial_compliance,
                                        const Lanes& shear_compliance) {
  using std::cos;
  using std::sin;
  const Scalar c = cos(theta);
  const Scalar s = sin(theta);
  const Scalar ft = fx * c + fy * s;
  const Scalar fn = fy * c - fx * s;
  Scalar axial = ft * ft;
  Scalar shear = fn * fn;
  axial *= axial_compliance;
  shear *= shear_compliance;
  return -ft - 0.5 * (axial + shear);
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
template <class Scalar>
Scalar reissner_strain_energy(const Scalar& dx, const Scalar& dy, const Scalar& theta,
                              const Scalar& kappa, const SectionStiffness& section,
                              double stretch = 1.0) {
  using std::cos;
  using std::sin;
  const Scalar c = cos(theta);
  const Scalar s = sin(theta);
  const Scalar eps = dx * c + dy * s - stretch;
  const Scalar gamma = dy * c - dx * s;
  return 0.5 * (section.axial * (eps * eps) + section.shear * (gamma * gamma) +
                section.bending * (kappa * kappa));
}

}  // namespace flexura

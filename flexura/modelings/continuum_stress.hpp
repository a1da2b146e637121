#pragma once

#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/plane_stress.hpp"
#include "flexura/energy/continuum.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// Cauchy stress in the axes that rotate with the material: U S U / J, with U^2 = I + 2 E. It takes
/// the strain that the stress follows from, enhanced strains included, which the places of the
/// nodes alone would not give.
template <class Density>
PlaneStress rotated_stress(const Density& density, const double* e) {
  using Jet = Jet2<3>;
  const Jet w = density(Jet::variable(0, e[0]), Jet::variable(1, e[1]), Jet::variable(2, e[2]));
  const double s11 = w.gradient[0], s22 = w.gradient[1], s12 = w.gradient[2];
  const double c11 = 1.0 + 2.0 * e[0], c22 = 1.0 + 2.0 * e[1], c12 = e[2];
  const double area = std::sqrt(c11 * c22 - c12 * c12);
  const double trace = std::sqrt(c11 + c22 + 2.0 * area);
  const double u11 = (c11 + area) / trace, u22 = (c22 + area) / trace, u12 = c12 / trace;
  const double a11 = u11 * s11 + u12 * s12, a12 = u11 * s12 + u12 * s22;
  const double a21 = u12 * s11 + u22 * s12, a22 = u12 * s12 + u22 * s22;
  const AcrossPlane across = density.across_plane(e[0], e[1], e[2]);
  const double volume = area * across.stretch;
  return {(a11 * u11 + a12 * u12) / volume, (a21 * u12 + a22 * u22) / volume,
          (a11 * u12 + a12 * u22) / volume,
          across.stretch * across.stretch * across.stress / volume};
}

/// Strain energy of a stress per volume, at small strains.
inline double stress_energy(const Material& material, PlaneKind plane, const PlaneStress& s) {
  const double nu = material.poissons_ratio;
  const double across = plane == PlaneKind::strain ? nu : 0.0;
  const double squares = (1.0 - across * across) * (s.xx * s.xx + s.yy * s.yy);
  const double product = (1.0 + across) * nu * s.xx * s.yy;
  return (0.5 * squares - product + (1.0 + nu) * s.xy * s.xy) / material.youngs_modulus;
}

}  // namespace flexura

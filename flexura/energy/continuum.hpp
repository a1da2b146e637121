#pragma once

#include <algorithm>
#include <cmath>

#include "flexura/core/jet2.hpp"

namespace flexura {

/// Lame's constants of an isotropic material.
struct LameConstants {
  double lambda = 0.0;
  double mu = 0.0;
};

inline LameConstants lame_constants(double youngs_modulus, double poissons_ratio) {
  return {youngs_modulus * poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio)),
          youngs_modulus / (2.0 * (1.0 + poissons_ratio))};
}

/// What keeps the strain normal to the plane: nothing (a thin plate, no stress there) or walls.
enum class PlaneKind { stress, strain };

/// What a law has across the plane: the stretch there, and the second Piola-Kirchhoff stress.
struct AcrossPlane {
  double stretch = 1.0;
  double stress = 0.0;
};

// Strain energies per undeformed volume of a continuum in its plane, by the components e11, e22 and
// g12 = 2 e12 of the Green-Lagrange strain E = (F^T F - 1)/2, F the deformation gradient. They
// depend on nothing else of F, so rigid motions cost nothing whatever their size.

/// St. Venant-Kirchhoff: linear between E and the second Piola-Kirchhoff stress. Without stress
/// across the plane, lambda 2 mu/(lambda + 2 mu) stands for lambda, at any strain.
struct StVenantKirchhoff {
  StVenantKirchhoff(LameConstants material, PlaneKind kind)
      : plane(kind),
        lambda(kind == PlaneKind::strain
                   ? material.lambda
                   : 2.0 * material.lambda * material.mu / (material.lambda + 2.0 * material.mu)),
        mu(material.mu) {}

  template <class Scalar>
  Scalar operator()(const Scalar& e11, const Scalar& e22, const Scalar& g12) const {
    return half_square(lambda, e11 + e22) + half_square(2.0 * mu, e11) +
           half_square(2.0 * mu, e22) + half_square(mu, g12);
  }

  AcrossPlane across_plane(double e11, double e22, double /*g12*/) const {
    if (plane == PlaneKind::strain) return {1.0, lambda * (e11 + e22)};
    const double e33 = -0.5 * lambda / mu * (e11 + e22);
    return {std::sqrt(std::max(1.0 + 2.0 * e33, 1e-6)), 0.0};  // far beyond what the law is for
  }

  PlaneKind plane;
  double lambda;
  double mu;
};

/// Compressible neo-Hookean material (Simo and Pister):
///     mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2.
/// In plane stress the square c of the stretch across the plane satisfies
///     mu (c - 1) + lambda/2 ln(c det C) = 0,       C = F^T F in the plane.
struct NeoHookean {
  NeoHookean(LameConstants material, PlaneKind kind) : constants(material), plane(kind) {}

  template <class Scalar>
  Scalar operator()(const Scalar& e11, const Scalar& e22, const Scalar& g12) const {
    const Scalar c11 = 1.0 + 2.0 * e11;
    const Scalar c22 = 1.0 + 2.0 * e22;
    const Scalar in_plane = c11 * c22 - g12 * g12;
    const Scalar across = square_of_stretch(in_plane);
    const Scalar log_volume = 0.5 * log(in_plane * across);
    return 0.5 * constants.mu * (c11 + c22 + across - 3.0) - constants.mu * log_volume +
           half_square(constants.lambda, log_volume);
  }

  AcrossPlane across_plane(double e11, double e22, double g12) const {
    const double in_plane = (1.0 + 2.0 * e11) * (1.0 + 2.0 * e22) - g12 * g12;
    if (plane == PlaneKind::strain) return {1.0, 0.5 * constants.lambda * std::log(in_plane)};
    return {std::sqrt(square_of_stretch_at(in_plane)), 0.0};
  }

  LameConstants constants;
  PlaneKind plane;

 private:
  double square_of_stretch_at(double in_plane) const {
    double c = 1.0;
    for (int k = 0; k < 30; ++k) {
      const double rest =
          constants.mu * (c - 1.0) + 0.5 * constants.lambda * std::log(c * in_plane);
      const double next = c - rest / (constants.mu + 0.5 * constants.lambda / c);
      const double change = std::abs(next - c);
      c = next > 0.0 ? next : 0.5 * c;
      if (change < 1e-15 * c) break;
    }
    return c;
  }
  /// One step of Newton's method in Scalars, from the root, gives its first derivatives; those of
  /// second order multiply a stress that is zero.
  template <class Scalar>
  Scalar square_of_stretch(const Scalar& in_plane) const {
    if (plane == PlaneKind::strain) return Scalar(1.0);
    const double c = square_of_stretch_at(in_plane.value);
    const Scalar rest = 0.5 * constants.lambda * log(c * in_plane) + constants.mu * (c - 1.0);
    return c - rest * (1.0 / (constants.mu + 0.5 * constants.lambda / c));
  }
};

}  // namespace flexura

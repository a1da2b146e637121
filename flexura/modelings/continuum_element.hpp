#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "flexura/core/jet2.hpp"
#include "flexura/modelings/continuum_mesh.hpp"

namespace flexura {

/// The deformation gradient F = [g_xi g_eta] J^-1 at a quadrature point, J^-1 as in
/// ElementTables::Map.
struct DeformationGradient {
  double f11 = 1.0, f12 = 0.0, f21 = 0.0, f22 = 1.0;

  /// e11, e22, 2 e12 of the Green-Lagrange strain.
  std::array<double, 3> strain() const {
    return {0.5 * (f11 * f11 + f21 * f21 - 1.0), 0.5 * (f12 * f12 + f22 * f22 - 1.0),
            f11 * f12 + f21 * f22};
  }
};

inline DeformationGradient deformation_gradient(Vec2 by_xi, Vec2 by_eta,
                                                const std::array<double, 4>& inverse) {
  return {
      by_xi.x * inverse[0] + by_eta.x * inverse[2], by_xi.x * inverse[1] + by_eta.x * inverse[3],
      by_xi.y * inverse[0] + by_eta.y * inverse[2], by_xi.y * inverse[1] + by_eta.y * inverse[3]};
}

/// Derivatives of e11, e22, 2 e12 by (g_xi.x, g_eta.x, g_xi.y, g_eta.y), row by row.
using StrainSlopes = std::array<std::array<double, 4>, 3>;
inline StrainSlopes strain_slopes(const DeformationGradient& f,
                                  const std::array<double, 4>& inverse) {
  StrainSlopes b;
  for (std::size_t a = 0; a < 2; ++a) {
    const double k1 = inverse[2 * a];
    const double k2 = inverse[2 * a + 1];
    b[0][a] = f.f11 * k1;
    b[0][2 + a] = f.f21 * k1;
    b[1][a] = f.f12 * k2;
    b[1][2 + a] = f.f22 * k2;
    b[2][a] = f.f11 * k2 + f.f12 * k1;
    b[2][2 + a] = f.f21 * k2 + f.f22 * k1;
  }
  return b;
}

/// Number of enhanced strains of a four-node element.
inline constexpr std::size_t enhanced_modes = 4;

/// Strains that a four-node element has besides those of its nodes (Simo and Rifai, Int. J. Num.
/// Meth. Eng. 29, 1990): in reference coordinates xi in the first component, eta in the second, xi
/// and eta in the shear; carried to the plane by the Jacobian at the element's middle, times the
/// ratio of the Jacobians, so that their mean is nothing and constant stress stays constant.
struct EnhancedStrains {
  EnhancedStrains(const StripMesh& mesh, std::size_t ex, std::size_t ey);
  /// Of nodes at (-1, -1), (-1, 1), (1, -1), (1, 1) in reference coordinates.
  explicit EnhancedStrains(const std::array<Vec2, 4>& nodes);
  /// Rows e11, e22, 2 e12; a column per mode.
  std::array<std::array<double, enhanced_modes>, 3> at(const ElementPoint& point,
                                                       double jacobian) const;

  std::array<std::array<double, 3>, 3> carry;  ///< reference strain to the plane, at the middle
  double middle_jacobian = 0.0;
};

/// State of one element of N nodes: places of its nodes, strains at the quadrature points (three
/// each; null where they are those of the places), enhanced strains or nothing.
struct ElementState {
  const Vec2* places = nullptr;
  const double* strains = nullptr;
  const double* enhanced = nullptr;
};

/// What an element contributes, by the places of its nodes: 2 N forces and the lower triangle of a
/// row-major 2 N x 2 N stiffness. `follow` and `rest` say how enhanced strains go along with the
/// nodes: d(enhanced) = -rest - follow d(places), 4 x 2 N and 4.
struct ElementTangent {
  double energy = 0.0;
  std::vector<double> forces;
  std::vector<double> stiffness;
  std::array<double, enhanced_modes * 8> follow{};
  std::array<double, enhanced_modes> rest{};
};

/// A change of an element from its last linearization: places of its nodes there and what they move
/// by, strains of the places less the independent ones, and how much of those gaps goes.
struct ElementChange {
  const Vec2* places = nullptr;
  const Vec2* changes = nullptr;
  const double* gaps = nullptr;
  double residual = 0.0;
};
/// What enhanced strains change by, `follow` being that of ElementTangent with `rest` behind it.
void follow_enhanced(const double* follow, const ElementChange& change, double* enhanced);
/// What the strains of all quadrature points change by; `modes` and what enhanced strains change by
/// may be null.
void follow_strains(const ElementTables& tables, std::size_t element, const ElementChange& change,
                    const EnhancedStrains* modes, const double* enhanced, double* strains);

/// The mixed functional of one quadrature point,
///     W(e) + W'(e) : (E(places) + enhanced - e),
/// whose independent strain e ends as that of the places. Newton's method for both takes the stress
/// in the geometric stiffness from e, which goes along to first order only, and so bears steps
/// that turn slender parts far, where E(places) alone would stretch them (Magisano, Leonetti and
/// Garcea, Int. J. Num. Meth. Eng. 109, 2017, for stresses instead of strains).
struct PointEnergy {
  double energy = 0.0;
  std::array<double, 3> stress;   ///< that the forces take: W'(e) + W''(e)(E - e)
  std::array<double, 3> carried;  ///< W'(e), of the geometric stiffness
  std::array<std::array<double, 3>, 3> moduli;
};

/// Adds a quadrature point's share to the two rows of a node: by x of `count` nodes, and `apart`
/// doubles behind by y; `x` and `y` are the rows' slopes by (g_xi.x, g_eta.x, g_xi.y, g_eta.y).
void add_rows(const double (&x)[4], const double (&y)[4], const double* dx, const double* dy,
              std::size_t count, double* row_x, double* row_y, std::size_t apart);

template <class Density>
PointEnergy point_energy(const Density& density, const double* e,
                         const std::array<double, 3>& total) {
  using Jet = Jet2<3>;
  const Jet w = density(Jet::variable(0, e[0]), Jet::variable(1, e[1]), Jet::variable(2, e[2]));
  PointEnergy point;
  point.energy = w.value;
  for (std::size_t i = 0; i < 3; ++i) {
    point.carried[i] = w.gradient[i];
    point.stress[i] = w.gradient[i];
    point.energy += w.gradient[i] * (total[i] - e[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      point.moduli[i][j] = w.second(i, j);
      point.stress[i] += w.second(i, j) * (total[j] - e[j]);
      point.energy += 0.5 * (total[i] - e[i]) * w.second(i, j) * (total[j] - e[j]);
    }
  }
  return point;
}

}  // namespace flexura

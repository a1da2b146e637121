#pragma once

#include "flexura/assembly/angle_field.hpp"
#include "flexura/modelings/beam_mesh.hpp"
#include "flexura/modelings/exact_field.hpp"

// Residuals and tangents of the geometrically exact beam differentiated by hand: what automatic
// differentiation must agree with, and is timed against (benchmarks/beam_tangent.cpp).
namespace flexura::testing {

/// The exact flexure of a constant section: TwoPort::linearize with the derivatives of
/// reissner_mixed_potential in closed form.
class HandDerivedExact {
 public:
  HandDerivedExact(const FlexureProperties& flexure, int modes);
  std::size_t internal_size() const { return field_.unknowns; }
  std::size_t scratch_size() const { return field_.scratch_size(); }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal, double* scratch) const;

 private:
  double axial_compliance_;
  double shear_compliance_;
  AngleField field_;
};

/// Reissner displacement elements of a constant section: TwoPort::linearize with internal forces
/// B^T F and tangent B^T D B + geometric part, as textbooks program it. Precondition: axial and
/// shear compliance > 0.
class HandDerivedBeam {
 public:
  HandDerivedBeam(const FlexureProperties& flexure, int elements, int order);
  std::size_t internal_size() const { return 3 * (mesh_.nodes() - 1); }
  std::size_t scratch_size() const { return internal_size() * (4 + 2 * (width() + 1) + 1); }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal, double* scratch) const;

 private:
  std::size_t width() const { return 3 * (mesh_.order + 1) - 1; }
  double add_point(std::size_t element, std::size_t gauss, const double* y, double* residual,
                   double* band) const;

  double ea_, ga_, ei_;
  BeamMesh mesh_;
  Vec2 chord_;
};

}  // namespace flexura::testing

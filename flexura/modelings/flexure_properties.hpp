#pragma once

#include <optional>
#include <vector>

#include "flexura/geometry/axis_curve.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// A section that changes along the flexure.
struct VaryingSection {
  Section shape;
  double youngs_modulus = 0.0;
  double shear_modulus = 0.0;
  /// Arc lengths between which a Gauss rule of 12 points integrates the section's compliances:
  /// graded to kinks, thin places and infinite slopes of the profile.
  std::vector<double> breaks;
};

/// What a modeling needs of one flexure: its axis and the section's compliances. Axial and shear
/// compliance are zero where they are switched off. For a varying section the numbers are means
/// (harmonic for EI, arithmetic for compliances): they set scales, at() has the values.
struct FlexureProperties {
  struct Local {
    double bending_stiffness = 0.0;  ///< EI
    double axial_compliance = 0.0;   ///< 1/EA
    double shear_compliance = 0.0;   ///< 1/GA_s
  };

  AxisCurve axis;
  double bending_stiffness = 0.0;  ///< EI
  double axial_compliance = 0.0;   ///< 1/EA
  double shear_compliance = 0.0;   ///< 1/GA_s
  std::optional<VaryingSection> varying = std::nullopt;

  Local at(double s) const;
  /// Arc lengths between which axis and section are smooth.
  std::vector<double> smooth_breaks() const;
};

FlexureProperties flexure_properties(const Model& model, const Flexure& flexure, bool axial,
                                     bool shear);

}  // namespace flexura

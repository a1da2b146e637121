#pragma once

#include "flexura/geometry/axis_curve.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// What a modeling needs of one flexure: its axis and the section's compliances. Axial and shear
/// compliance are zero where they are switched off.
struct FlexureProperties {
  AxisCurve axis;
  double bending_stiffness = 0.0;  ///< EI
  double axial_compliance = 0.0;   ///< 1/EA
  double shear_compliance = 0.0;   ///< 1/GA_s
};

FlexureProperties flexure_properties(const Model& model, const Flexure& flexure, bool axial,
                                     bool shear);

}  // namespace flexura

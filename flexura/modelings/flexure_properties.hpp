#pragma once

#include <Eigen/Dense>
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

/// What acts along a flexure, per load factor: dead force per length and per volume (its weight),
/// and the axial strain by which a change of temperature would lengthen it.
struct FlexureField {
  Vec2 per_length;
  Vec2 per_volume;
  double strain = 0.0;

  bool acts() const { return norm(per_length) > 0.0 || norm(per_volume) > 0.0 || strain != 0.0; }
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

  double area = 0.0;  ///< mean
  FlexureField field = {};
  /// Of a link of any shape: displacement of its action end per load there; the numbers above are
  /// then scales only.
  std::optional<Eigen::Matrix3d> compliance = std::nullopt;

  Local at(double s) const;
  /// Dead force per length at s, and on all that lies ahead of s; per load factor.
  Vec2 load_at(double s) const;
  Vec2 load_ahead(double s) const;
  /// Arc lengths between which axis and section are smooth.
  std::vector<double> smooth_breaks() const;
};

FlexureProperties flexure_properties(const Model& model, const Flexure& flexure, bool axial,
                                     bool shear);

}  // namespace flexura

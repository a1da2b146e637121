#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flexura/core/diagnostics.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/energy/continuum.hpp"

namespace flexura {

struct LinearSettings {};

struct ScmbmSettings {
  /// The point of the action body at which the compliance matrix relates load and displacement.
  enum class At { centre, end };
  At at = At::centre;
};

/// Three equal springs that match the flexure's linear bending compliance exactly.
struct PrbmEqualSprings {};
/// Su's 3R chain for a straight flexure (Su, J. Mech. Rob. 1(2), 2009).
struct PrbmSu {};
/// Howell's 1R model for a straight flexure; without `load_ratio` n (axial compression over
/// transverse force) it follows the load.
struct PrbmHowell {
  std::optional<double> load_ratio;
};
/// The user's own chain for straight flexures: `lengths` of the rigid segments from base to
/// action end (fractions of the flexure's length, one more than springs), `stiffness` in EI/L.
struct PrbmSegments {
  std::vector<double> lengths;
  std::vector<double> stiffness;
};
/// The user's own chain for any flexure: joints from base to action end in the flexure's
/// frame (origin at the elastic centre, x across the symmetry axis from the base end to the
/// action end, y from the centre towards the middle of the axis), as fractions of its length;
/// `stiffness` in EI/L.
struct PrbmJoints {
  std::vector<Vec2> joints;
  std::vector<double> stiffness;
};

struct PrbmSettings {
  std::variant<PrbmEqualSprings, PrbmSu, PrbmHowell, PrbmSegments, PrbmJoints> parameters;
};

struct ExactSettings {
  std::optional<int> modes;  ///< Legendre modes per smooth piece; chosen from tolerance if absent
};

/// Beam elements: geometrically exact ones of `order` + 1 nodes each, or two-node ones with a
/// quintic deflection, by von Karman's strains in frames that follow the elements, by the linear
/// theory (Euler-Bernoulli without shear, Timoshenko with it), or as the first source prints them.
struct BeamSettings {
  enum class Theory { exact, von_karman, linear, printed };
  int elements = 16;  ///< per flexure
  int order = 1;      ///< of exact elements
  Theory theory = Theory::exact;
};

/// Beam constraint model of straight flexures, chained where there are several elements.
struct BcmSettings {
  int elements = 1;  ///< per flexure
};

/// Quadrilaterals at large displacement, of Gauss-Lobatto nodes. What is absent follows from the
/// tolerance.
struct ContinuumSettings {
  enum class Law { st_venant_kirchhoff, neo_hookean };
  std::optional<int> elements;  ///< along every flexure
  std::optional<int> across;    ///< elements across the thickness
  std::optional<int> order;
  std::optional<int> order_across;  ///< by default `order`
  PlaneKind plane = PlaneKind::stress;
  Law law = Law::st_venant_kirchhoff;
  bool enhanced = true;      ///< elements of order 1 do not lock in bending
  bool contracting = false;  ///< end faces stay plane, but may get thicker or thinner
};

/// A modeling as a study asks for it.
struct ModelingSettings {
  using Kind = std::variant<LinearSettings, ScmbmSettings, PrbmSettings, ExactSettings,
                            BeamSettings, BcmSettings, ContinuumSettings>;

  Kind kind;
  std::string label;  ///< names the results; by default the modeling's name
  bool axial = true;
  bool shear = true;
  double tolerance = 1e-8;  ///< relative, on the points' paths
  SourcePosition source;
};

/// "linear", "scmbm", "prbm", "exact", "beam", "bcm" or "continuum".
std::string modeling_name(const ModelingSettings& settings);

}  // namespace flexura

#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flexura/core/diagnostics.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/geometry/axis_curve.hpp"
#include "flexura/geometry/mesh_link.hpp"
#include "flexura/geometry/section.hpp"
#include "flexura/model/linkage.hpp"
#include "flexura/model/loads.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/model/motion.hpp"

namespace flexura {

/// The declared units, as words of the model file. Every quantity of a Model is in the
/// consistent system they span (stress = force/length^2, mass = force time^2/length), but for
/// angles, which are in radians; `angle` is only how the file's results name angles.
struct UnitNames {
  std::string length;
  std::string force;
  std::string time;
  std::string angle = "rad";
};

struct Material {
  std::string name;
  double youngs_modulus = 0.0;
  double poissons_ratio = 0.0;
  std::optional<double> density;
  std::optional<double> strength;  ///< the largest fibre stress allowed
  SourcePosition source;
  std::optional<double> thermal_expansion = {};  ///< strain per degree
};

struct NamedSection {
  std::string name;
  Section shape;
  SourcePosition source;
};

struct Point {
  std::string name;
  Vec2 position;  ///< as drawn, global axes
};

struct Body {
  std::string name;
  bool fixed = false;
  std::vector<Point> points;
  std::optional<Vec2> centre;  ///< by default the first flexure end, or joint, on the body
  double mass = 0.0;
  double inertia = 0.0;  ///< about the centre
  SourcePosition source;
  bool free = false;  ///< need not be supported: it flies
};

struct Flexure {
  std::string name;
  std::size_t base = 0;    ///< index into Model::bodies
  std::size_t action = 0;  ///< index into Model::bodies
  bool pinned_base = false;
  bool pinned_action = false;
  AxisShape axis;
  std::size_t material = 0;
  std::size_t section = 0;
  /// Of the place on the action body where the end is fastened, from where it is drawn: assembly
  /// forces the end there.
  Vec2 misfit;
  double misfit_rotation = 0.0;
  SourcePosition source;
  /// Of any shape instead of a strip: `axis` is then link_axis(*link), `section` beyond the list.
  std::shared_ptr<const MeshLink> link = nullptr;
};

/// A body's point or, without one, its centre.
struct SpringEnd {
  std::size_t body = 0;
  std::optional<std::size_t> point;
};

/// Between points of two bodies, or, torsional, between their rotations; without force as drawn
/// unless it is told its free length (or angle) or the force it pulls with as drawn.
struct Spring {
  std::string name;
  SpringEnd base;
  SpringEnd action;
  double stiffness = 0.0;  ///< force per length; torsional: moment per radian
  bool torsional = false;
  std::optional<double> free;     ///< length, or relative rotation
  std::optional<double> preload;  ///< force of the spring as drawn, positive where it pulls
  double damping = 0.0;  ///< force per rate of length; torsional: moment per rate of rotation
  SourcePosition source;
};

/// Study `linear`: compliance matrices and ellipses of elasticity about the drawn state; `loads`
/// adds the poles of these loads.
struct LinearStudy {
  std::vector<Load> loads;
  bool axial = true;
  bool shear = true;
};

/// Where a path followed by arc length ends, whichever comes first.
struct PathEnd {
  double load_factor = 1.0;         ///< first reached from the side the path comes from
  std::optional<int> limit_points;  ///< so many passed
  std::optional<int> steps;         ///< so many taken
  std::optional<int> critical;      ///< so many directions lost or gained at critical states
};

/// At which bifurcation a path followed by arc length leaves its primary branch, counted from 1,
/// and to which side.
struct BranchSwitch {
  int at = 1;
  int side = 1;  ///< 1 or -1
};

/// A body, or one of its points, and a direction there.
struct DirectedPlace {
  std::size_t body = 0;
  std::optional<std::size_t> point;
  std::optional<Vec2> along;
};

/// What a designer reads off a stage along a path: `output` is the place that is to move along a
/// direction (by default the one in which it sets off), `input` the one that drives it.
struct StageSettings {
  DirectedPlace output;
  std::optional<DirectedPlace> input;
};

/// Study `path`: the equilibria as all loads and prescribed displacements grow together, in `steps`
/// equal steps of the load factor from 0 to 1.
struct PathStudy {
  enum class KeptFields { none, last, every_step };
  std::vector<Load> loads;
  FieldLoads fields;
  std::vector<Prescribed> prescribe;
  /// With arc length, states are those the continuation took, none longer than 2/steps.
  bool arc_length = false;
  PathEnd until;
  std::optional<BranchSwitch> branch;
  std::optional<StageSettings> stage;
  std::vector<std::size_t> condense;  ///< bodies whose condensed stiffness is wanted
  KeptFields stress_fields = KeptFields::last;
  int steps = 20;
  bool estimate = true;  ///< of errors; modelings that choose their modes by it have it anyway
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;  ///< index into modelings: what the others are compared with
};

/// Study `buckling`: the first `count` load factors at which the tangent turns singular along the
/// loaded path or, linearised, along its continuation in a straight line from the start.
struct BucklingStudy {
  std::vector<Load> loads;
  bool linearised = false;
  int count = 1;
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;
};

/// The displacement of a flexure's action body relative to its base body, in axes fixed to the
/// base body, at a point fixed to the action body: the flexure's end or its elastic centre.
struct RelativeDisplacement {
  enum class At { end, centre };
  std::size_t flexure = 0;
  Vec2 displacement;
  double rotation = 0.0;
  At at = At::end;
};

/// Study `inverse` (the full-inverse problem): the relative displacements of a set of flexures
/// that reaches every moving body exactly once are prescribed, in `steps` equal steps, and the
/// loads at the bodies' centres that hold the mechanism there come out.
struct InverseStudy {
  std::vector<RelativeDisplacement> relative;
  int steps = 1;
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;
};

struct Study {
  std::string name;
  std::variant<LinearStudy, PathStudy, BucklingStudy, InverseStudy, ModesStudy, TransientStudy,
               ResponseStudy, LinkageStudy>
      kind;
  SourcePosition source;
};

/// What the engineer wrote, checked, in plain values. Order is that of the file throughout.
struct Model {
  std::string title;
  UnitNames units;
  std::vector<Material> materials;
  std::vector<NamedSection> sections;
  std::vector<Body> bodies;
  std::vector<Flexure> flexures;
  std::vector<Spring> springs;
  std::vector<Joint> joints;
  std::vector<Driver> drivers;
  std::vector<Study> studies;
};

/// The section of a strip, or the one that stands for a link of any shape.
Section section_of(const Model& model, const Flexure& flexure);

/// Where an axis begins (base end) and ends (action end), as drawn.
struct AxisEnds {
  Vec2 base;
  Vec2 action;
};
AxisEnds axis_ends(const AxisShape& axis);

/// The body's reference point as drawn: its `centre`, or the first flexure end on it, or the first
/// revolute joint on it, or else the origin.
Vec2 body_centre(const Model& model, std::size_t body);

/// The diagonal of the box around all that has a place as drawn.
double mechanism_size(const Model& model);

/// Whether flexures or springs do not fit as drawn.
bool needs_assembly(const Model& model);

/// For every body the one place where all flexure ends on it are pinned and all its joints are;
/// nothing if an end is clamped or a joint slides, if pins lie apart (they then hold the body's
/// rotation between them), or if there are none.
std::vector<std::optional<Vec2>> common_pins(const Model& model);

/// For every body that hangs on one common pin alone the place of it. Nothing where the body's
/// pose makes sense beyond that: it is fixed or driven, or has inertia about the pin.
std::vector<std::optional<Vec2>> hanging_pins(const Model& model);

/// Whether a body has a rotation of its own: false for one that hangs on a pin.
bool body_can_turn(const Model& model, std::size_t body);

}  // namespace flexura

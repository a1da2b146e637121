#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "flexura/core/stress_field.hpp"
#include "flexura/core/termination.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// A section of a flexure: where it is and what it carries. N positive in tension, M positive
/// where it increases the curvature counter-clockwise, V along the section normal; `stress` is
/// the largest absolute fibre stress.
struct MemberStation {
  double s = 0.0;  ///< arc length of the undeformed axis from the base end
  Pose section;
  double axial_force = 0.0;
  double shear_force = 0.0;
  double bending_moment = 0.0;
  double stress = 0.0;
};

/// A load that holds a body or point where it was prescribed to be, at that place.
struct Reaction {
  Vec2 force;
  double moment = 0.0;
};

/// What a stage's output place does in one state: about it, how stiff it is, and where it is going.
struct StageState {
  /// Force x, y and moment at the place per displacement x, y and rotation there, row by row;
  /// absent where the place cannot move in some direction.
  std::optional<std::array<double, 9>> stiffness;
  /// Largest and smallest stiffness against a force there, its rotation free, and the direction
  /// (radians) of the smallest; absent where the place cannot move.
  std::optional<double> stiff;
  std::optional<double> soft;
  double soft_direction = 0.0;
  std::optional<Vec2> instant_centre;  ///< of its body's motion along the path; none: translation
  double centre_drift = 0.0;           ///< distance of the instant centre from the path's first
  double along = 0.0;                  ///< displacement in its direction, and parasitic: across
  double across = 0.0;
  double rotation = 0.0;
  /// Displacement of the output per displacement of the input, and force on the blocked output per
  /// force on the input; without an input, absent.
  std::optional<double> geometric_advantage;
  std::optional<double> mechanical_advantage;
};

/// Stiffness of chosen bodies at their centres, all else free to follow: rows force x, y, moment of
/// each body in turn, columns displacement x, y, rotation, row by row.
struct CondensedStiffness {
  double load_factor = 0.0;
  std::vector<double> matrix;
};

/// One equilibrium. The vectors run in the order of PathResult's names.
struct PathState {
  double load_factor = 0.0;
  std::vector<Pose> bodies;
  std::vector<Vec2> points;
  std::vector<Pose> mids;               ///< section at mid-length of every flexure
  std::vector<Reaction> reactions;      ///< of PathResult::held
  std::vector<std::vector<Vec2>> axes;  ///< deformed axis of every flexure, for drawing
  std::vector<double> peak_stresses;    ///< of every flexure, the largest over its stations
  double strain_energy = 0.0;
  int unstable_directions = 0;  ///< negative eigenvalues of the tangent; 0 is stable
};

/// Stress fields in one state, axes and places global.
struct FieldState {
  struct OfFlexure {
    std::size_t flexure = 0;  ///< index into PathResult::flexures
    StressField field;
  };
  std::size_t state = 0;  ///< index into ModelingPath::states
  std::vector<OfFlexure> flexures;
};

/// Where the von Mises stress at the nodes of the fields is largest.
struct LargestStress {
  double von_mises = 0.0;
  std::size_t flexure = 0;
  Vec2 place;  ///< in the state
  Vec2 drawn;
};

struct PathEvent {
  std::string kind;  ///< "limit point", "bifurcation", "stability lost", "stability gained"
  double load_factor = 0.0;
  PathState state;
};

/// Something a path passes on its way, seen from the force that it takes: a force that comes to a
/// halt (a limit point under that force), or no force at all (an equilibrium of the mechanism left
/// alone). The force is the reaction of a single driving displacement, or that of all loads.
struct ReactionEvent {
  enum class Kind { halt, zero };
  Kind kind = Kind::halt;
  double load_factor = 0.0;
  double reaction = 0.0;  ///< of the driving displacement; 0 under loads
  bool stable = true;     ///< of what is left alone; meant for `zero`
  PathState state;
};

/// One modeling's path.
struct ModelingPath {
  std::string label;
  std::string modeling;
  Termination termination;
  std::vector<PathState> states;                    ///< states[0] is the undeformed mechanism
  std::vector<std::vector<MemberStation>> members;  ///< per flexure, at the last state
  std::vector<PathEvent> events;
  /// Of paths that a single displacement or rotation drives without loads, or that were followed by
  /// arc length.
  std::vector<ReactionEvent> reaction_events;
  std::vector<std::optional<StageState>> stage;  ///< per state, where a stage is asked for
  std::vector<CondensedStiffness> condensed;     ///< at the first and the last state
  std::vector<FieldState> fields;                ///< as asked for, of modelings that have them
  /// Energy norm of the last state's error in stress, relative to that of its stress; absent
  /// without fields.
  std::optional<double> stress_error;
  std::optional<LargestStress> largest_stress;  ///< of the last state
  int unknowns = 0;
  int steps = 0;       ///< converged load steps, intermediate ones included
  int iterations = 0;  ///< Newton iterations in all
  double seconds = 0.0;
  /// Largest distance of any named point from its converged place, relative to its largest
  /// displacement; absent where the modeling has no discretization.
  std::optional<double> error_estimate;
  /// The same norm, against the study's reference modeling; absent for the reference itself.
  std::optional<double> difference;
};

/// A body or one of its points that is held where it was prescribed to be.
struct HeldPlace {
  std::string name;                  ///< "body" or "body.point"
  std::size_t body = 0;              ///< index into PathResult::bodies
  std::optional<std::size_t> point;  ///< index into PathResult::points
};

/// All modelings of one study of kind `path` or `inverse`.
struct PathResult {
  std::vector<std::string> bodies;  ///< moving bodies
  std::vector<std::string> points;  ///< "body.point", of moving bodies
  std::vector<std::string> flexures;
  std::vector<std::optional<double>> strengths;  ///< of the flexures' materials
  std::string stage;                             ///< the stage's output place, if asked for
  std::vector<std::string> condensed;            ///< bodies of the condensed stiffness, in order
  std::vector<HeldPlace> held;                   ///< what the reactions of all states belong to
  std::vector<ModelingPath> modelings;
  std::size_t reference = 0;  ///< index into modelings
  /// States are those that a continuation took: the load factor need not grow.
  bool by_arc_length = false;
};

}  // namespace flexura

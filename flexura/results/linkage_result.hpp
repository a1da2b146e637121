#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// The linkage with rigid links at an angle of the drive. Rates are by time.
struct RigidPosition {
  double angle = 0.0;                        ///< of the driven body, from its drawn position
  std::vector<Pose> bodies;                  ///< in the order of LinkageResult::bodies
  std::vector<std::vector<Vec2>> flexures;   ///< the axis of each, from base to action end
  std::vector<Vec2> points;                  ///< in the order of LinkageResult::points
  double torque = 0.0;                       ///< on the driven body, that drives it
  Vec2 shaking_force;                        ///< of the moving masses on the frame
  double shaking_moment = 0.0;               ///< about the driven body's centre
  std::vector<Vec2> reactions;               ///< of each pin on the second of its two parts
  std::optional<double> transmission_angle;  ///< of a four-bar, between coupler and follower
};

/// What one flexure does over the turn: a value per position.
struct FlexureCurves {
  std::vector<double> strain;        ///< bending strain of the +n fibre at mid-length
  std::vector<double> axial_strain;  ///< there
  std::vector<double> deflection;    ///< of mid-length across the line between the ends
  std::vector<double> stress;        ///< the largest absolute fibre stress anywhere along it
  /// Stress of the fibres on the side of +n and of -n, over stations (columns) and positions
  /// (rows).
  std::vector<std::vector<double>> upper_stress, lower_stress;
};

/// The largest absolute value over the turn, and where.
struct CurvePeak {
  double value = 0.0;
  double angle = 0.0;
};

/// The elastic motion over a turn by one method.
struct LinkageMotion {
  std::string label;  ///< the method's name
  Termination termination;
  std::string remark;  ///< what should be known beside the numbers; a sentence, or nothing
  std::vector<FlexureCurves> flexures;
  /// Displacements along the axis of each flexure from its rigid position: positions, then
  /// flexures, then the axis' places as in RigidPosition.
  std::vector<std::vector<std::vector<Vec2>>> displacements;
  /// Of bodies' centres and points from their rigid positions: positions, then places.
  std::vector<std::vector<Vec2>> bodies, points;
  int unknowns = 0;
  int iterations = 0;   ///< what they are depends on the method: see `counted`
  std::string counted;  ///< "turns", "iterations of the coupling terms", ..
  double seconds = 0.0;
  std::optional<double> error_estimate;  ///< of strains, over the largest of their flexure
  std::optional<double> difference;      ///< in the same norm, against the method of reference
};

/// Multipliers of Floquet at one mean speed and, there, the largest strain of every flexure.
struct SpeedState {
  double speed = 0.0;                             ///< rad per time
  std::vector<std::complex<double>> multipliers;  ///< largest first
  std::vector<double> peak_strain;
  bool buckles = false;  ///< a link would at rest, somewhere in the turn
};

/// One study of kind `linkage`.
struct LinkageResult {
  std::vector<std::string> bodies;  ///< that move
  std::vector<std::string> points;
  std::vector<std::string> flexures;
  std::vector<std::string> pins;                 ///< "crank.action on A", ..
  std::vector<std::optional<double>> strengths;  ///< of the flexures' materials
  std::vector<std::vector<double>> stations;     ///< arc lengths of each flexure's stresses
  std::string driver;
  double speed = 0.0;              ///< mean, rad per time
  std::string modeling;            ///< as the study names it, with its elements
  std::string damping;             ///< a sentence
  std::string grashof;             ///< of a four-bar: "crank-rocker", ..; else empty
  std::vector<std::string> notes;  ///< findings of the whole study: sentences
  std::vector<RigidPosition> positions;
  /// Angular frequencies: positions, then ascending; those of a mode followed through the turn.
  std::vector<std::vector<double>> frequencies, followed;
  std::vector<LinkageMotion> modelings;  ///< the methods
  std::size_t reference = 0;
  std::vector<std::complex<double>> multipliers;  ///< at the study's speed
  std::vector<SpeedState> speeds;                 ///< empty unless asked for
  /// By what factor the axial forces at this speed would have to grow for a link to buckle at the
  /// worst angle; nothing where none compresses.
  std::optional<double> buckling_factor;
  double buckling_angle = 0.0;
};

}  // namespace flexura

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// How a mechanism moves in a mode: displacements, of which the largest of any point, body or
/// station of an axis is one length unit. The vectors run in the order of ModeResult's names.
struct ModeShape {
  std::vector<Pose> bodies;
  std::vector<Vec2> points;
  std::vector<Pose> mids;               ///< of the section at mid-length of every flexure
  std::vector<std::vector<Vec2>> axes;  ///< of the axis of every flexure
};

/// A mode about an equilibrium.
struct Mode {
  /// Of study `buckling` the load factor; of `modes` the angular frequency, negative where the
  /// mode is unstable and grows at that rate.
  double value = 0.0;
  ModeShape shape;
  // The equilibrium, for drawing:
  std::vector<Pose> bodies;
  std::vector<std::vector<Vec2>> axes;
};

/// The lowest frequencies about one state of a path.
struct FrequencyPoint {
  double load_factor = 0.0;
  std::vector<double> angular_frequencies;  ///< negative: see Mode::value
};

/// One modeling's modes.
struct ModelingModes {
  std::string label;
  std::string modeling;
  Termination termination;
  std::vector<Mode> modes;
  std::vector<FrequencyPoint> curve;  ///< along a path, where it is asked for
  int unknowns = 0;
  double seconds = 0.0;
  /// Largest relative change of a value by refining; absent where nothing can be refined.
  std::optional<double> error_estimate;
  /// Largest relative difference of a value from the reference modeling's of the same number.
  std::optional<double> difference;
};

/// All modelings of one study of kind `buckling` or `modes`.
struct ModeResult {
  std::vector<std::string> bodies;  ///< moving bodies
  std::vector<std::string> points;  ///< "body.point", of moving bodies
  std::vector<std::string> flexures;
  std::vector<ModelingModes> modelings;
  std::size_t reference = 0;  ///< index into modelings
};

}  // namespace flexura

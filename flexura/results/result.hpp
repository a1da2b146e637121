#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/results/drawn_history.hpp"
#include "flexura/results/ellipse.hpp"
#include "flexura/results/linkage_result.hpp"
#include "flexura/results/mode_result.hpp"
#include "flexura/results/motion_result.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// A flexure as drawn: its undeformed axis sampled evenly, and its depth in the plane of motion.
struct DrawnFlexure {
  std::string name;
  std::string base;
  std::string action;
  bool pinned_base = false;
  bool pinned_action = false;
  std::vector<Vec2> axis;
  double depth = 0.0;
  /// Likewise at the points of `axis` where the section varies, else empty.
  std::vector<double> depths = {};
};

/// A body as drawn: the flexure ends, points and centre it carries, undeformed.
struct DrawnBody {
  std::string name;
  bool fixed = false;
  Vec2 centre;
  std::vector<Vec2> ends;  ///< flexure ends on it, in file order
  std::vector<std::string> point_names;
  std::vector<Vec2> points;
};

/// A spring as drawn, by the bodies that its ends belong to.
struct DrawnSpring {
  std::string name;
  std::string base;
  std::string action;
  Vec2 base_place;
  Vec2 action_place;
  bool torsional = false;
};

/// A joint as drawn: a pin at a place, or a slider there along a direction.
struct DrawnJoint {
  std::string name;
  std::string base;
  std::string action;
  Vec2 at;
  std::optional<Vec2> direction;
};

/// The mechanism before any load, to scale.
struct Drawing {
  std::vector<DrawnFlexure> flexures;
  std::vector<DrawnBody> bodies;
  std::vector<DrawnSpring> springs = {};
  std::vector<DrawnJoint> joints = {};
};

/// A load as drawn: at full load factor.
struct DrawnLoad {
  std::string on;  ///< "body" or "body.point"
  Vec2 force;
  double moment = 0.0;
  bool follower = false;
  bool constant = false;
  std::optional<DrawnHistory> history = {};  ///< none: as it is from the start on
};

/// What acts along flexures and on masses, as drawn: at full load factor.
struct DrawnFields {
  struct Spread {
    std::size_t flexure = 0;  ///< index into Drawing::flexures
    Vec2 per_length;
  };
  std::vector<Spread> spread = {};
  Vec2 gravity;
  double temperature = 0.0;
  bool constant = false;
};

struct StudyResult {
  std::string name;
  std::string kind;  ///< as the file says it: "linear", "path", "buckling", "inverse", ..
  Termination termination;
  std::vector<DrawnLoad> loads;
  DrawnFields fields = {};
  std::variant<LinearResult, PathResult, ModeResult, MotionResult, ResponseResult, LinkageResult>
      content;
};

/// Everything a run found out, in the file's declared units, rotations in radians.
struct Result {
  std::string title;
  std::string model_file;
  std::string version;
  std::string length_unit;
  std::string force_unit;
  std::string time_unit;
  std::string angle_unit = "rad";  ///< of angles in the files of linkages
  Drawing drawing;
  std::vector<StudyResult> studies;
};

}  // namespace flexura

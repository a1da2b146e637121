#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "flexura/core/time_history.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// A force and a moment on a body, at one of its points or, without one, at its centre. A
/// follower load turns with the body.
struct Load {
  std::size_t body = 0;
  std::optional<std::size_t> point;
  Vec2 force;
  double moment = 0.0;
  bool follower = false;
  bool constant = false;                ///< there before the others grow
  TimeHistory history = StepHistory{};  ///< in studies of motion, a factor on it
};

/// A dead force per length along a flexure's undeformed axis.
struct SpreadLoad {
  std::size_t flexure = 0;
  Vec2 per_length;
};

/// What acts along flexures and on masses, growing with the loads or there before them.
struct FieldLoads {
  std::vector<SpreadLoad> spread;
  Vec2 gravity;              ///< acceleration of all mass
  double temperature = 0.0;  ///< change, of all flexures
  bool constant = false;

  bool act() const { return !spread.empty() || norm(gravity) > 0.0 || temperature != 0.0; }
};

/// A displacement or rotation of a body, at one of its points or, without one, at its centre, that
/// is imposed instead of a load. Components left out are free.
struct Prescribed {
  std::size_t body = 0;
  std::optional<std::size_t> point;
  std::optional<double> x;  ///< final displacements
  std::optional<double> y;
  std::optional<double> rotation;
  TimeHistory history = StepHistory{};  ///< in studies of motion, a factor on them
};

}  // namespace flexura

#pragma once

#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/studies/periodic_motion.hpp"

namespace flexura {

/// Equations of motion of a mechanism whose driver turns at any constant speed, everything else
/// keeping to its angle.
class TurnLayout {
 public:
  TurnLayout(const Model& model, const PeriodicMotionStudy& study,
             const ModelingSettings& settings);

  MotionLayout at(double speed) const;
  /// Times within a turn at that speed at which a history kinks.
  std::vector<double> breaks(double speed) const;

 private:
  Model model_;  // with the driver at the study's speed
  std::size_t driver_;
  double speed_;
  MotionLayout loaded_;  // nothing prescribed
};

/// What the study's comments rule out: a sentence, empty if nothing does.
std::string refusal_of(const Model& model, const PeriodicMotionStudy& study);

}  // namespace flexura

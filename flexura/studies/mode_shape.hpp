#pragma once

#include <functional>
#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/mode_result.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// A mode from states: `moved(by)` is the mechanism that has gone along it by so much; `step` is
/// small enough to be a rate.
Mode make_mode(const std::function<PathState(double)>& moved, double step, double value);

/// The mode of a system that moves from the state z in a direction of its unknowns.
Mode make_mode(const Model& model, const System& system, const std::vector<double>& z,
               const std::vector<double>& direction, double value);

/// The same of a mechanism in motion, in a direction of its coordinates.
Mode make_mode(const Model& model, const MotionSystem& system, const Moment& moment,
               const Eigen::VectorXd& direction, double value);

}  // namespace flexura

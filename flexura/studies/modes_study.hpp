#pragma once

#include <functional>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/mode_result.hpp"
#include "flexura/solvers/vibration.hpp"

namespace flexura {

/// Natural frequencies and shapes of one modeling.
ModelingModes run_modes(const Model& model, const ModesStudy& study,
                        const ModelingSettings& settings,
                        const std::function<bool(double)>& keep_going);

/// Vibrations about an equilibrium, dense or sparse by size where the solver is left open.
Vibrations find_vibrations(MotionSystem& system, const Moment& moment, int count,
                           ModesStudy::Solver solver);

/// Angular frequencies; negative where a mode grows at that rate.
std::vector<double> signed_frequencies(const Vibrations& vibrations);

}  // namespace flexura

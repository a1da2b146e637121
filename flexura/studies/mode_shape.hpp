#pragma once

#include <vector>

#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/mode_result.hpp"

namespace flexura {

/// The mode of a system that moves from the state z in a direction of its unknowns.
Mode make_mode(const Model& model, const System& system, const std::vector<double>& z,
               const std::vector<double>& direction, double value);

}  // namespace flexura

#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// Study `inverse`: prescribes how flexures displace their action bodies relative to their base
/// bodies, which places every body, and finds the loads that hold the mechanism there. By `scmbm`
/// each flexure's load is a linear function of its relative displacement.
ModelingPath run_inverse(const Model& model, const InverseStudy& study,
                         const ModelingSettings& settings,
                         const std::function<bool(double)>& keep_going);

/// Sets every modeling's difference from the reference: the largest distance of a body's force (or
/// moment) from the reference's, relative to the largest force (moment) there.
void compare_reactions(PathResult& result);

}  // namespace flexura

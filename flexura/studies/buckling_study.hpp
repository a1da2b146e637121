#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/mode_result.hpp"

namespace flexura {

/// The critical load factors of one modeling with their modes, in ascending order. Along the loaded
/// path they are those of its bifurcations and of the limit point that ends it under growing loads.
/// Linearised they are the positive mu of  det(K0 + mu K1) = 0,  K the second derivatives of the
/// potential by all unknowns and K1 their rate along the path at its start.
ModelingModes run_buckling(const Model& model, const BucklingStudy& study,
                           const ModelingSettings& settings,
                           const std::function<bool(double)>& keep_going);

/// Fills in `difference` of every modeling against the reference.
void compare_modes(ModeResult& result);

}  // namespace flexura

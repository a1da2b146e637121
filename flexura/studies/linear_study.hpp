#pragma once

#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/ellipse.hpp"

namespace flexura {

/// Study `linear`: compliance matrix and ellipse of elasticity of every flexure (held at its base,
/// loaded at its action end), every moving body and every named point, and the poles of the loads.
LinearResult run_linear(const Model& model, const LinearStudy& study, Termination& termination);

}  // namespace flexura

#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// One modeling's path through a study of kind `path`. `keep_going(fraction)` is asked after each
/// output step.
ModelingPath run_path(const Model& model, const PathStudy& study, const ModelingSettings& settings,
                      const std::function<bool(double)>& keep_going);

/// Sets every modeling's difference from the reference: for each named point (body centres where
/// none is named), the largest distance over the path relative to the point's largest displacement
/// by the reference; of these the largest. Of paths followed by arc length, limit points,
/// bifurcations and ends are compared.
void compare_with_reference(PathResult& result);

}  // namespace flexura

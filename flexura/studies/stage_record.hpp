#pragma once

#include <optional>
#include <vector>

#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// Fills in `stage` and `condensed` of a path from what was traced.
void add_stage_records(const Model& model, const PathStudy& study, const TracedPath& traced,
                       ModelingPath& path);

}  // namespace flexura

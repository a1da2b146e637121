#pragma once

#include "flexura/model/model.hpp"
#include "flexura/results/result.hpp"
#include "flexura/studies/run_studies.hpp"

namespace flexura::app {

/// Runs studies as `options` says, with a progress line unless `quiet`; Ctrl-C ends them early,
/// with what they have by then.
Result run_watched(const Model& model, RunOptions options, bool quiet);

}  // namespace flexura::app

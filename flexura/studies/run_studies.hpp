#pragma once

#include <string>
#include <vector>

#include "flexura/core/progress.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/result.hpp"

namespace flexura {

struct RunOptions {
  std::vector<std::string> studies;    ///< names to run; empty: all
  std::vector<std::string> modelings;  ///< labels or modeling names to run; empty: all
  int threads = 0;                     ///< 0: as many as there are processors
  ProgressCallback progress;           ///< may be empty
};

/// Runs the studies of a model, their modelings side by side on threads. Results do not depend on
/// the number of threads. Precondition: the model is valid (validate_model finds nothing) and the
/// names in the options exist.
Result run_studies(const Model& model, const RunOptions& options);

}  // namespace flexura

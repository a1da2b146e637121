#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/linkage_result.hpp"

namespace flexura {

/// Study `linkage`. `termination`: whether the linkage goes round; what its methods came to is
/// theirs. `keep_going` is told the share of the work that is done and may stop it.
LinkageResult run_linkage(const Model& model, const LinkageStudy& study, Termination& termination,
                          const std::function<bool(double)>& keep_going);

}  // namespace flexura

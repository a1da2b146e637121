#pragma once

#include <functional>
#include <string_view>

namespace flexura {

/// What long work reports: the study, the modeling's label, and how far along it is (0 to 1).
struct ProgressReport {
  std::string_view study;
  std::string_view label;
  double fraction = 0.0;
};

/// Called from any thread, one call at a time; false asks the work to stop at the next state, and
/// what converged is kept.
using ProgressCallback = std::function<bool(const ProgressReport&)>;

}  // namespace flexura

#pragma once

#include <string>

namespace flexura {

/// How a computation ended. It starts as `not_run` and can only become good by converging.
enum class Status { not_run, converged, stopped };

/// Why: `reason` is a sentence that names the cause and what to try; empty when converged.
struct Termination {
  Status status = Status::not_run;
  std::string reason;

  bool converged() const { return status == Status::converged; }
};

}  // namespace flexura

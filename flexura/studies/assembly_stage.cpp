#include "flexura/studies/assembly_stage.hpp"

#include <fmt/format.h>

#include "flexura/solvers/load_stepping.hpp"
#include "flexura/studies/singular_mechanism.hpp"

namespace flexura {

bool assemble(const Model& model, double tolerance, TracedPath& path, std::vector<double>& z) {
  System& system = *path.systems.back();
  z = system.initial_state();
  if (!system.needs_assembly()) return true;
  system.set_assembling(true);
  LoadStepping<System> stepping(system, {tolerance, 1e-4});
  if (!stepping.start(z) || system.is_singular()) {
    path.termination = {Status::stopped, describe_singular(model, system.softest_body())};
    return false;
  }
  const SteppingSummary summary = stepping.advance(1.0);
  path.iterations += stepping.iterations();
  z = stepping.state();
  system.set_assembling(false);
  if (summary.outcome == SteppingOutcome::reached) {
    for (const StabilityChange& change : stepping.changes())
      path.events.push_back({change.after > change.before ? "stability lost" : "stability gained",
                             0.0, path.systems.size() - 1, z, change.after});
    return true;
  }
  const double share = 100.0 * summary.load_factor;
  path.termination = {
      Status::stopped,
      summary.outcome == SteppingOutcome::limit_point
          ? fmt::format("the mechanism cannot be assembled: with {:.4g} % of misfits, free lengths "
                        "and constant loads it snaps away. Let them be smaller, or prescribe what "
                        "holds it meanwhile",
                        share)
          : fmt::format("the mechanism cannot be assembled: Newton's method fails past {:.4g} % of "
                        "misfits, free lengths and constant loads. Let them be smaller",
                        share)};
  return false;
}

}  // namespace flexura

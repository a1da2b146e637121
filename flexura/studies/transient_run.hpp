#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/motion_result.hpp"
#include "flexura/solvers/time_march.hpp"
#include "flexura/studies/motion_start.hpp"

namespace flexura {

/// A mechanism and where it starts to move. `origin`: the state of a path from which this motion,
/// or the first of those that it goes on from, set off; as drawn where it has no system.
struct TransientStart {
  std::unique_ptr<MotionSystem> system;
  Moment moment;
  Termination termination;
  MotionStart origin;
};

TransientStart start_transient(const Model& model, const TransientStudy& study,
                               const ModelingSettings& settings);
/// The same start with every flexure refined, as far as flexures can be.
TransientStart refine(const TransientStart& start, const Model& model, const TransientStudy& study);

/// How finely a run steps: by tolerance, or by fixed steps where `step` > 0.
struct TransientSteps {
  double step = 0.0;
  double tolerance = 0.0;
};

/// Integrates from the start to the end of the study. `record` is called at the start and at every
/// output time with the moment and its energies; it or `keep_going` may stop the run.
struct TransientRun {
  Termination termination;
  MarchCounts counts;
};
using RecordMoment = std::function<void(const Moment&, const EnergyBalance&)>;
TransientRun integrate(MotionSystem& system, Moment& moment, const TransientStudy& study,
                       const TransientSteps& steps, const RecordMoment& record,
                       const std::function<bool(double)>& keep_going);

}  // namespace flexura

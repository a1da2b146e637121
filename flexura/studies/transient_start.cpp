#include <cmath>

#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/motion_start.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/transient_run.hpp"

namespace flexura {
namespace {

constexpr int most_damped_modes = 200;

std::unique_ptr<MotionSystem> make_moving(const Model& model, const TransientStudy& study,
                                          const ModelingSettings& settings) {
  MotionLayout layout = make_motion_layout(model, {study.loads, study.fields, study.damping},
                                           settings, study.inertia);
  add_prescribed(layout, model, with_drivers(model, study.prescribe));
  return std::make_unique<MotionSystem>(std::move(layout));
}

/// Every mode about the start loses the same share of critical damping.
void add_modal_damping(MotionSystem& system, const Moment& rest, double share) {
  if (share == 0.0) return;
  const int count =
      static_cast<int>(std::min<Eigen::Index>(system.coordinates(), most_damped_modes));
  const Vibrations modes = find_vibrations(system, rest, count, ModesStudy::Solver::automatic);
  std::vector<ModalForce> forces;
  for (Eigen::Index i = 0; i < modes.squares.size(); ++i) {
    if (!(modes.squares[i] > 0.0)) continue;
    forces.push_back(
        {system.multiply_mass(modes.shapes.col(i)), 2.0 * share * std::sqrt(modes.squares[i])});
  }
  system.set_modal_damping(std::move(forces));
}

/// Where drivers move from the first moment on, so does the mechanism, as if its flexures were
/// rigid: the rates that take the least strain.
bool follow_drivers(MotionSystem& system, Moment& moment, double duration) {
  Eigen::VectorXd r;
  system.residual(moment, r);
  const Eigen::VectorXd rates = system.constraint_rates(moment);
  if (rates.size() == 0 || rates.lpNorm<Eigen::Infinity>() == 0.0) return true;
  MotionFactor<double> factor;
  return project_rates(system, moment, duration, factor);
}

}  // namespace

TransientStart start_transient(const Model& model, const TransientStudy& study,
                               const ModelingSettings& settings) {
  TransientStart start;
  start.system = make_moving(model, study, settings);
  start.moment = start.system->drawn_moment();
  start.termination.status = Status::converged;
  if (!study.from) {
    add_modal_damping(*start.system, start.moment, study.damping.modal);
    if (!follow_drivers(*start.system, start.moment, study.duration))
      start.termination = {Status::stopped, "the mechanism cannot follow its drivers as drawn"};
    return start;
  }
  const auto& kind = model.studies[study.from->study].kind;
  if (std::holds_alternative<PathStudy>(kind)) {
    MotionStart path = start_about(model, study.from, settings, study.inertia);
    start.termination = path.termination;
    if (!path.termination.converged()) return start;
    add_modal_damping(*path.system, path.moment, study.damping.modal);
    start.system->set_modal_damping(path.system->modal_damping());
    start.moment.q = path.moment.q;
    start.moment.multipliers.tail(3 * static_cast<Eigen::Index>(start.system->member_count())) =
        path.moment.multipliers.tail(3 * static_cast<Eigen::Index>(start.system->member_count()));
    return start;
  }
  const auto& before = std::get<TransientStudy>(kind);
  TransientStart earlier = start_transient(model, before, settings);
  start.termination = earlier.termination;
  if (!earlier.termination.converged()) return start;
  start.system->set_modal_damping(earlier.system->modal_damping());
  const TransientRun run = integrate(*earlier.system, earlier.moment, before,
                                     {before.step.value_or(0.0), before.tolerance}, {}, {});
  start.termination = run.termination;
  if (!run.termination.converged())
    start.termination.reason = "the study it starts from stopped early: " + run.termination.reason;
  start.moment.q = earlier.moment.q;
  start.moment.v = earlier.moment.v;
  return start;
}

}  // namespace flexura

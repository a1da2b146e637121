#include <fmt/format.h>

#include <cmath>

#include "flexura/studies/modes_study.hpp"
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

/// Every mode about the origin loses the same share of critical damping.
void add_modal_damping(TransientStart& start, double share) {
  if (share == 0.0) return;
  MotionSystem& system = *start.system;
  MotionSystem& resting = start.origin.system ? *start.origin.system : system;
  const Moment rest = start.origin.system ? start.origin.moment : system.drawn_moment();
  const int count =
      static_cast<int>(std::min<Eigen::Index>(system.coordinates(), most_damped_modes));
  const Vibrations modes = find_vibrations(resting, rest, count, ModesStudy::Solver::automatic);
  std::vector<ModalForce> forces;
  for (Eigen::Index i = 0; i < modes.squares.size(); ++i) {
    if (!(modes.squares[i] > 0.0)) continue;
    forces.push_back(
        {resting.multiply_mass(modes.shapes.col(i)), 2.0 * share * std::sqrt(modes.squares[i])});
  }
  system.set_modal_damping(std::move(forces));
}

/// At rest in the state of a path that is the origin.
void rest_at_origin(TransientStart& start) {
  const auto loads = 3 * static_cast<Eigen::Index>(start.system->member_count());
  start.moment.q = start.origin.moment.q;
  start.moment.multipliers.tail(loads) = start.origin.moment.multipliers.tail(loads);
}

bool starts_in_path(const Model& model, const TransientStudy& study) {
  return study.from && std::holds_alternative<PathStudy>(model.studies[study.from->study].kind);
}

/// Refined flexures do not end where the ones before did: moves all as little as mass and stiffness
/// over a time `span` let it until the constraints are closed.
bool close_gaps(MotionSystem& system, Moment& moment, double span) {
  constexpr int most_iterations = 20;
  MotionFactor<double> factor;
  Eigen::VectorXd r;
  for (int k = 0; k < most_iterations; ++k) {
    system.residual(moment, r);
    if (!r.allFinite()) return false;
    if (system.relative_gap(r) < 1e-12) return true;
    system.linearize(moment);
    if (!system.factorize(1.0 / (span * span), 0.0, factor)) return false;
    r.head(system.coordinates()).setZero();
    r.tail(system.multipliers()) *= -1.0;
    system.solve(factor, r);
    moment.q += r.head(system.coordinates());
  }
  return false;
}

/// Where drivers move from the first moment on, so does the mechanism, as if its flexures were
/// rigid: the rates that take the least strain, and of those the least energy. They are the limit
/// of the projection over a long span: changes by longer ones grow up to the mechanism's periods,
/// fall beyond them, and grow again once rounding decides.
bool follow_drivers(MotionSystem& system, Moment& moment, double duration) {
  constexpr int most_spans = 14;
  Eigen::VectorXd r;
  system.residual(moment, r);
  const Eigen::VectorXd rates = system.constraint_rates(moment);
  if (rates.size() == 0 || rates.lpNorm<Eigen::Infinity>() == 0.0) return true;
  MotionFactor<double> factor;
  const Moment still = moment;
  if (!project_rates(system, moment, duration, factor)) return false;
  Eigen::VectorXd before = moment.v;
  double last_change = 0.0;
  bool falls = false;
  double span = duration;
  for (int k = 0; k < most_spans; ++k) {
    span *= 10.0;
    Moment slower = still;
    if (!project_rates(system, slower, span, factor)) break;
    const double change = system.size_of(slower.v - before);
    if (falls && change >= last_change) break;
    falls = k > 0 && change < last_change;
    if (falls) moment.v = slower.v;
    before = slower.v;
    last_change = change;
  }
  return true;
}

/// Whether the places that histories impose at the start are those that the mechanism is in.
bool drivers_stand_there(MotionSystem& system, const Moment& moment) {
  constexpr double step_error = 1e-4;  // of a run's end
  Eigen::VectorXd r;
  system.residual(moment, r);
  return system.relative_gap(r) < step_error;
}

}  // namespace

TransientStart start_transient(const Model& model, const TransientStudy& study,
                               const ModelingSettings& settings) {
  TransientStart start;
  start.system = make_moving(model, study, settings);
  start.moment = start.system->drawn_moment();
  start.termination.status = Status::converged;
  if (!study.from || starts_in_path(model, study)) {
    if (study.from) {
      start.origin = start_about(model, study.from, settings, study.inertia);
      start.termination = start.origin.termination;
      if (!start.termination.converged()) return start;
      rest_at_origin(start);
    }
    if (!follow_drivers(*start.system, start.moment, study.duration))
      start.termination = {Status::stopped,
                           "the mechanism cannot follow its drivers from where it starts"};
  } else {
    const auto& before = std::get<TransientStudy>(model.studies[study.from->study].kind);
    TransientStart earlier = start_transient(model, before, settings);
    start.termination = earlier.termination;
    if (!start.termination.converged()) return start;
    const TransientRun run = integrate(*earlier.system, earlier.moment, before,
                                       {before.step.value_or(0.0), before.tolerance}, {}, {});
    start.termination = run.termination;
    if (!run.termination.converged())
      start.termination.reason =
          "the study it starts from stopped early: " + run.termination.reason;
    start.moment.q = earlier.moment.q;
    start.moment.v = earlier.moment.v;
    start.origin = std::move(earlier.origin);
    if (start.termination.converged() && !drivers_stand_there(*start.system, start.moment))
      start.termination = {
          Status::stopped,
          fmt::format("at time 0 the drivers, or what is prescribed, are not where study '{}' has "
                      "left them: histories start anew with every study. A history by `table` that "
                      "starts from where they are goes on",
                      model.studies[study.from->study].name)};
  }
  if (start.termination.converged()) add_modal_damping(start, study.damping.modal);
  return start;
}

TransientStart refine(const TransientStart& start, const Model& model,
                      const TransientStudy& study) {
  TransientStart finer;
  finer.termination = start.termination;
  finer.system = start.system->refined();
  if (!finer.system) {
    finer.system = std::make_unique<MotionSystem>(start.system->layout());
    finer.system->set_modal_damping(start.system->modal_damping());
    finer.moment = start.moment;
    return finer;
  }
  finer.moment = start.system->prolong(start.moment, *finer.system);
  bool found = true;
  if (start.origin.system) {
    finer.origin.system = start.origin.system->refined();
    finer.origin.moment = start.origin.system->prolong(start.origin.moment, *finer.origin.system);
    found = solve_at_rest(*finer.origin.system, finer.origin.moment);
  }
  if (found && starts_in_path(model, study)) {
    rest_at_origin(finer);
  } else if (found && study.from) {
    found = close_gaps(*finer.system, finer.moment, study.duration);
  }
  if (found) {
    add_modal_damping(finer, study.damping.modal);
  } else {
    finer.termination = {Status::stopped, "no start with refined flexures was found"};
  }
  return finer;
}

}  // namespace flexura

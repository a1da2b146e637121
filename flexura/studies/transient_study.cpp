#include "flexura/studies/transient_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/studies/displacement_norm.hpp"
#include "flexura/studies/motion_start.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/transient_run.hpp"

namespace flexura {
namespace {

constexpr double finer_tolerance = 0.1;  // of the run that the estimate takes for the truth

class Transient {
 public:
  Transient(const Model& model, const TransientStudy& study, const ModelingSettings& settings,
            const std::function<bool(double)>& keep_going)
      : model_(model), study_(study), settings_(settings), keep_going_(keep_going) {}

  ModelingMotion run();

 private:
  TransientSteps steps() const { return {study_.step.value_or(0.0), study_.tolerance}; }
  void record(const MotionSystem& system, const Moment& moment, const EnergyBalance& energy);
  void estimate_error(const TransientStart& start);

  const Model& model_;
  const TransientStudy& study_;
  const ModelingSettings& settings_;
  const std::function<bool(double)>& keep_going_;
  std::vector<Prescribed> held_;
  double largest_energy_ = 0.0;
  ModelingMotion motion_;
};

void Transient::record(const MotionSystem& system, const Moment& moment,
                       const EnergyBalance& energy) {
  MotionState state{moment.time, make_path_state(model_, MovingState(system, moment), 0.0), energy};
  state.state.strain_energy = energy.strain;
  state.state.reactions = reactions_of(
      held_, [&](std::size_t row) { return system.prescribed_reaction(row, moment.multipliers); });
  largest_energy_ =
      std::max({largest_energy_, energy.kinetic, energy.strain, std::abs(energy.work)});
  motion_.states.push_back(std::move(state));
}

ModelingMotion Transient::run() {
  motion_.label = settings_.label;
  motion_.modeling = modeling_name(settings_);
  held_ = with_drivers(model_, study_.prescribe);
  TransientStart start = start_transient(model_, study_, settings_);
  motion_.unknowns = static_cast<int>(start.system->size());
  motion_.termination = start.termination;
  if (!start.termination.converged()) return std::move(motion_);
  const Moment first = start.moment;
  const double share = study_.estimate ? 0.4 : 1.0;  // of the time that is yet to be spent
  const auto keep_going = [&](double fraction) {
    return !keep_going_ || keep_going_(share * fraction);
  };
  MotionSystem& system = *start.system;
  const TransientRun run = integrate(
      system, start.moment, study_, steps(),
      [&](const Moment& moment, const EnergyBalance& energy) { record(system, moment, energy); },
      keep_going);
  motion_.termination = run.termination;
  motion_.steps = run.counts.steps;
  motion_.rejected = run.counts.rejected;
  motion_.iterations = run.counts.iterations;
  motion_.smallest_step = run.counts.steps > 0 ? run.counts.smallest_step : 0.0;
  motion_.largest_step = run.counts.largest_step;
  for (const MotionState& state : motion_.states)
    if (largest_energy_ > 0.0)
      motion_.energy_error =
          std::max(motion_.energy_error, std::abs(state.energy.error) / largest_energy_);
  motion_.members = make_members(model_, MovingState(system, start.moment));
  start.moment = first;
  if (study_.estimate && run.termination.converged()) estimate_error(start);
  return std::move(motion_);
}

/// Against a run with refined flexures and finer steps. Where that stops early, there is no
/// estimate.
void Transient::estimate_error(const TransientStart& start) {
  TransientStart fine_start = refine(start, model_, study_);
  if (!fine_start.termination.converged()) return;
  MotionSystem& finer = *fine_start.system;
  double ratio = 1.0;
  for (std::size_t k = 0; k < start.system->member_count(); ++k)
    ratio = std::max(ratio, start.system->port(k).error_ratio());
  if (study_.step && study_.method != TransientStudy::Method::radau)
    ratio = std::max(ratio, 4.0 / 3.0);
  const TransientSteps fine{0.5 * study_.step.value_or(0.0), finer_tolerance * study_.tolerance};
  LargestDisplacements largest(motion_.states.front().state);
  for (const MotionState& state : motion_.states) largest.add(state.state);
  const std::vector<double> sizes = largest.values();
  const double noise = displacement_rounding(motion_.states.front().state);
  double worst = 0.0;
  std::size_t k = 0;
  const auto compare = [&](const Moment& at, const EnergyBalance&) {
    const PathState state = make_path_state(model_, MovingState(finer, at), 0.0);
    if (k < motion_.states.size())
      worst = std::max(worst, relative_distance(motion_.states[k++].state, state, sizes, noise));
  };
  const TransientRun run =
      integrate(finer, fine_start.moment, study_, fine, compare,
                [&](double fraction) { return !keep_going_ || keep_going_(0.4 + 0.6 * fraction); });
  if (run.termination.converged()) motion_.error_estimate = ratio * worst;
}

}  // namespace

ModelingMotion run_transient(const Model& model, const TransientStudy& study,
                             const ModelingSettings& settings,
                             const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  ModelingMotion motion = Transient(model, study, settings, keep_going).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  motion.seconds = took.count();
  return motion;
}

void compare_motions(MotionResult& result) {
  const ModelingMotion& reference = result.modelings[result.reference];
  if (reference.states.empty()) return;
  LargestDisplacements largest(reference.states.front().state);
  for (const MotionState& state : reference.states) largest.add(state.state);
  const std::vector<double> sizes = largest.values();
  const double noise = displacement_rounding(reference.states.front().state);
  for (std::size_t m = 0; m < result.modelings.size(); ++m) {
    ModelingMotion& motion = result.modelings[m];
    const std::size_t states = std::min(motion.states.size(), reference.states.size());
    if (m == result.reference || states < 2) continue;
    double worst = 0.0;
    for (std::size_t k = 0; k < states; ++k)
      worst = std::max(worst, relative_distance(motion.states[k].state, reference.states[k].state,
                                                sizes, noise));
    motion.difference = worst;
  }
}

std::string method_name(const TransientStudy& study) {
  switch (study.method) {
    case TransientStudy::Method::generalized_alpha:
      return fmt::format("generalized_alpha, spectral radius {}", study.spectral_radius);
    case TransientStudy::Method::energy_momentum:
      return "energy_momentum";
    case TransientStudy::Method::radau:
      break;
  }
  return "radau";
}

std::string damping_sentence(const DampingSettings& damping) {
  if (damping.modal > 0.0)
    return fmt::format("{:.6g} of critical damping in every mode about the start", damping.modal);
  if (damping.mass == 0.0 && damping.stiffness == 0.0) return "no damping but that of dampers";
  return fmt::format("Rayleigh damping: {:.6g} times mass and {:.6g} times stiffness", damping.mass,
                     damping.stiffness);
}

}  // namespace flexura

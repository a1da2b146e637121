#include "flexura/studies/transient_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/assembly/discrete_motion.hpp"
#include "flexura/solvers/energy_momentum.hpp"
#include "flexura/solvers/generalized_alpha.hpp"
#include "flexura/solvers/radau.hpp"

namespace flexura {
namespace {

/// Newton's method ends well below the error of a step (what it leaves is felt by 1/h in rates, by
/// 1/h^2 in forces), and in any case where joints and ends of flexures are closed to what short
/// steps after it can bear.
double newton_tolerance(double tolerance) {
  return tolerance > 0.0 ? std::min(1e-3 * tolerance, 1e-6) : 1e-11;
}

constexpr double same_time = 1e-12;  // as a share of the study's duration

/// Output times and, between them, those at which loads or the rates of imposed motions jump.
struct Goal {
  double time = 0.0;
  bool is_output = false;
  bool load_jumps = false;
  bool rate_jumps = false;
};
std::vector<Goal> goals_of(const MotionSystem& system, const TransientStudy& study) {
  std::vector<Goal> goals;
  for (int k = 1; k <= study.outputs; ++k)
    goals.push_back(
        {k == study.outputs ? study.duration : study.duration * k / study.outputs, true});
  const auto add = [&](const TimeHistory& history, bool imposed) {
    const auto breaks = history_breaks(history, 0.0, study.duration);
    if (breaks.size() > most_breaks) return;
    for (const double at : breaks) goals.push_back({at, false, !imposed, imposed});
  };
  for (const TimeHistory& history : system.layout().loads) add(history, false);
  for (const TimeHistory& history : system.layout().prescribed) add(history, true);
  std::sort(goals.begin(), goals.end(),
            [](const Goal& a, const Goal& b) { return a.time < b.time; });
  std::vector<Goal> merged;
  for (const Goal& goal : goals) {
    if (merged.empty() || goal.time > merged.back().time + same_time * study.duration) {
      merged.push_back(goal);
      continue;
    }
    merged.back().is_output = merged.back().is_output || goal.is_output;
    merged.back().load_jumps = merged.back().load_jumps || goal.load_jumps;
    merged.back().rate_jumps = merged.back().rate_jumps || goal.rate_jumps;
  }
  return merged;
}

/// Work of loads and losses to damping, added up step by step.
class Ledger {
 public:
  explicit Ledger(MotionSystem& system) : system_(system), keeps_books_(system.has_power()) {}

  bool keeps_books() const { return keeps_books_; }
  void add(double work, double dissipated) {
    work_ += work;
    dissipated_ += dissipated;
  }
  /// The balance at a moment, from its energies; that at the first is the start's.
  EnergyBalance balance(const Moment& moment, const MotionEnergies& energies, double kinetic) {
    EnergyBalance balance;
    balance.kinetic = kinetic;
    balance.strain = energies.strain;
    if (!started_) {
      start_ = kinetic + energies.strain;
      dead_start_ = energies.dead_work;
      started_ = true;
    }
    balance.work = energies.dead_work - dead_start_ + work_;
    balance.dissipated = dissipated_;
    balance.error = kinetic + energies.strain - start_ - balance.work + dissipated_;
    balance.momentum = energies.momentum;
    balance.angular_momentum = energies.angular_momentum;
    system_.residual(moment, residual_);
    balance.drift = system_.largest_gap(residual_);
    return balance;
  }

 private:
  MotionSystem& system_;
  bool keeps_books_;
  bool started_ = false;
  double work_ = 0.0;
  double dissipated_ = 0.0;
  double start_ = 0.0;
  double dead_start_ = 0.0;
  Eigen::VectorXd residual_;
};

struct March {
  MotionSystem& system;
  Moment& moment;
  Ledger& ledger;
  const TransientStudy& study;
  const TransientSteps& steps;
  const RecordMoment& record;
  const std::function<bool(double)>& keep_going;

  /// `integrator` steps; `after` books a step of length h; `energies` makes the balance.
  template <class Integrator, class After, class Energies>
  TransientRun run(Integrator& integrator, const After& after, const Energies& energies) const;

 private:
  void strike(double span) const;
};

/// What is imposed changes its speed at once: the blow's work is the gain of kinetic energy.
void March::strike(double span) const {
  const double before = system.energies(moment).kinetic;
  MotionFactor<double> factor;
  if (!project_rates(system, moment, span, factor)) return;
  if (ledger.keeps_books()) ledger.add(system.energies(moment).kinetic - before, 0.0);
}

template <class Integrator, class After, class Energies>
TransientRun March::run(Integrator& integrator, const After& after,
                        const Energies& energies) const {
  TransientRun run;
  const double first_step = std::min(study.duration / study.outputs, 1e-4 * study.duration);
  TimeMarch<Integrator> march(integrator,
                              {steps.step, steps.tolerance, first_step, 1e-13 * study.duration});
  int since_asked = 0;
  const auto booked = [&](double h) {
    after(h);
    if (++since_asked < 50) return true;
    since_asked = 0;
    return !keep_going || keep_going(moment.time / study.duration);
  };
  if (record) record(moment, energies());
  run.termination.status = Status::converged;
  for (const Goal& goal : goals_of(system, study)) {
    // a step that ends at a jump has the load, or the imposed speed, from before it
    const bool jumps = goal.load_jumps || goal.rate_jumps;
    const double end = goal.time - (jumps ? same_time * study.duration : 0.0);
    if (!march.advance(moment, end, booked)) {
      run.termination = {Status::stopped,
                         march.was_stopped()
                             ? fmt::format("cancelled at time {:.6g}", moment.time)
                             : fmt::format("no step leads on from time {:.6g}, however short: the "
                                           "mechanism locks or snaps there, or its motion is too "
                                           "fast for its modes; a smaller step or tolerance, other "
                                           "loads or more modes may help",
                                           moment.time)};
      break;
    }
    moment.time = goal.time;
    if (jumps) march.restart(goal.rate_jumps);
    if (goal.rate_jumps) strike(steps.step > 0.0 ? steps.step : first_step);
    if (!goal.is_output) continue;
    if (record) record(moment, energies());
    if (goal.time < study.duration && keep_going && !keep_going(moment.time / study.duration)) {
      run.termination = {Status::stopped, fmt::format("cancelled at time {:.6g}", moment.time)};
      break;
    }
  }
  run.counts = march.counts();
  return run;
}

TransientRun by_radau(const March& march) {
  Ledger& ledger = march.ledger;
  using Integrator = Radau<MotionSystem, Moment, MotionFactor>;
  const double tolerance = march.steps.step > 0.0 ? 0.0 : march.steps.tolerance;
  Integrator integrator(march.system, {newton_tolerance(tolerance), tolerance});
  double last_step = 0.0;
  const auto after = [&](double h) {
    last_step = h;
    if (!ledger.keeps_books()) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const MotionPower power = march.system.power(integrator.stages()[i]);
      const double weight = h * integrator.tableau().weights[static_cast<Eigen::Index>(i)];
      ledger.add(weight * power.loads, weight * power.damping);
    }
  };
  MotionFactor<double> factor;
  return march.run(integrator, after, [&] {
    Moment moment = march.moment;  // with rates that the constraints allow
    if (last_step > 0.0 && !project_rates(march.system, moment, last_step, factor))
      moment.v = march.moment.v;
    const MotionEnergies energies = march.system.energies(moment);
    return ledger.balance(moment, energies, energies.kinetic);
  });
}

TransientRun by_generalized_alpha(const March& march) {
  Ledger& ledger = march.ledger;
  using Integrator = GeneralizedAlpha<MotionSystem, Moment, MotionFactor>;
  const double tolerance = march.steps.step > 0.0 ? 0.0 : march.steps.tolerance;
  Integrator integrator(march.system,
                        {march.study.spectral_radius, newton_tolerance(tolerance), tolerance});
  MotionPower before;
  if (ledger.keeps_books()) before = march.system.power(march.moment);
  const auto after = [&](double h) {
    if (!ledger.keeps_books()) return;
    const MotionPower now = march.system.power(march.moment);
    ledger.add(0.5 * h * (before.loads + now.loads), 0.5 * h * (before.damping + now.damping));
    before = now;
  };
  return march.run(integrator, after, [&] {
    const MotionEnergies energies = march.system.energies(march.moment);
    return ledger.balance(march.moment, energies, energies.kinetic);
  });
}

TransientRun by_energy_momentum(const March& march) {
  Ledger& ledger = march.ledger;
  DiscreteMotion discrete(march.system);
  using Integrator = EnergyMomentum<DiscreteMotion, Moment, MotionFactor, Vec2>;
  Integrator integrator(discrete, {1e-11});
  const auto after = [&](double) { ledger.add(discrete.work(), discrete.dissipated()); };
  return march.run(integrator, after, [&] {
    MotionEnergies energies = march.system.energies(march.moment);
    if (integrator.velocities().empty())
      return ledger.balance(march.moment, energies, energies.kinetic);
    const DiscreteMotion::Momenta momenta =
        discrete.momenta(integrator.places(), integrator.velocities());
    energies.momentum = momenta.linear;
    energies.angular_momentum = momenta.angular;
    return ledger.balance(march.moment, energies, momenta.kinetic);
  });
}

}  // namespace

TransientRun integrate(MotionSystem& system, Moment& moment, const TransientStudy& study,
                       const TransientSteps& steps, const RecordMoment& record,
                       const std::function<bool(double)>& keep_going) {
  Ledger ledger(system);
  const March march{system, moment, ledger, study, steps, record, keep_going};
  switch (study.method) {
    case TransientStudy::Method::generalized_alpha:
      return by_generalized_alpha(march);
    case TransientStudy::Method::energy_momentum:
      return by_energy_momentum(march);
    case TransientStudy::Method::radau:
      break;
  }
  return by_radau(march);
}

}  // namespace flexura

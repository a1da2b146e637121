#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "flexura/studies/linkage_methods.hpp"

namespace flexura {
namespace {

constexpr int sweep_stages = 3;

/// Every second position does where only multipliers and peaks are wanted; breaks of loads stay.
LinkageStudy coarser(LinkageStudy study) {
  study.positions = std::max(60, study.positions / 2);
  return study;
}

/// `buckles`: some link would, at rest; modes that damp are then those of the elastic stiffness.
SpeedState at_speed(const LinkageTurn& turn, const LinkageStudy& study,
                    const std::vector<double>& ends, double speed, bool buckles) {
  SpeedState state{speed, {}, {}, buckles};
  try {
    const PeriodicOscillation oscillation(ends, sweep_stages, [&](double angle) {
      const Eigen::MatrixXd stiffness = turn.stiffness(angle, speed);
      return turn.oscillation(angle, speed, stiffness,
                              buckles ? turn.matrices(angle).stiffness : stiffness);
    });
    const PeriodicOscillation::Periodic periodic = oscillation.solve_periodic();
    state.multipliers = periodic.multipliers;
    const auto& members = turn.system().layout().members;
    state.peak_strain.assign(members.size(), 0.0);
    const std::vector<OscillationState> states = oscillation.states(periodic.start);
    for (std::size_t k = 1; k < states.size(); ++k) {
      const Eigen::RowVectorXd strains =
          strains_at(study, turn, ends[k], speed, by_time(turn.drive(ends[k]), speed, states[k]));
      for (std::size_t m = 0; m < members.size(); ++m)
        state.peak_strain[m] =
            std::max(state.peak_strain[m], std::abs(strains[static_cast<Eigen::Index>(m)]));
    }
  } catch (const LinkageTurn::Buckled&) {
    if (!buckles) return at_speed(turn, study, ends, speed, true);
  }
  return state;
}

}  // namespace

std::vector<SpeedState> sweep_speeds(const Model& model, const LinkageStudy& study,
                                     const std::function<bool(double)>& keep_going) {
  const LinkageStudy coarse = coarser(study);
  LinkageTurn turn(model, coarse, false);
  const std::vector<double> ends = turn.interval_ends(1);
  if (!study.speeds || !turn.visit(LinkageTurn::stage_angles(ends, sweep_stages))) return {};
  const SpeedRange& range = *study.speeds;
  std::vector<SpeedState> states(static_cast<std::size_t>(range.count));
  std::atomic<int> done = 0;
  std::atomic<bool> going = true;
  tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t k) {
    if (!going) return;
    const double share = static_cast<double>(k) / static_cast<double>(range.count - 1);
    states[k] = at_speed(turn, coarse, ends, range.from + share * (range.to - range.from), false);
    if (keep_going && !keep_going(static_cast<double>(++done) / range.count)) going = false;
  });
  if (!going) std::erase_if(states, [](const SpeedState& state) { return state.speed == 0.0; });
  return states;
}

}  // namespace flexura

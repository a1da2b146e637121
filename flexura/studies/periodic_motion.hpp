#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/core/termination.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// The motion that a mechanism repeats with every turn of a driven body.
struct PeriodicMotionStudy {
  std::size_t driver = 0;  ///< of the model; turns a body
  double speed = 0.0;      ///< angle per time, not 0; its sign is the sense. The driver's own
                           ///< amount and history do not count
  /// Histories of loads and of the other drivers are those of the turn from time 0 on, and are
  /// repeated with it: they end as they began (see `break_of_period`). At lower speeds they keep to
  /// the angle.
  std::vector<Load> loads;
  FieldLoads fields;
  DampingSettings damping;  ///< Rayleigh's. Modal damping belongs to a state, and has to be 0
  InertiaSettings inertia;
  int outputs = 180;         ///< intervals per turn
  double tolerance = 1e-6;   ///< per step, of displacements in mean flexure lengths
  double miss = 1e-8;        ///< by which the orbit may miss itself after a turn, as FreeState
                             ///< measures: what bends a flexure by an angle counts about that
  int multipliers = 6;       ///< so many of the largest are wanted
  int most_turns = 150;      ///< of the search at one speed, linearised ones included
  bool slower_first = true;  ///< where none is found directly, from lower speeds upwards
};

/// Speeds that were tried, in their order.
struct SpeedTried {
  double speed = 0.0;
  bool found = false;
  int iterations = 0;
  int turns = 0;  ///< linearised ones included
};

struct PeriodicMotion {
  Termination termination;  ///< converged: `moments` are the orbit at the speed that was asked for
  double speed = 0.0;       ///< of the moments: the greatest at which an orbit was found, 0 if none
  std::unique_ptr<MotionSystem> system;  ///< at that speed
  std::vector<Moment> moments;           ///< at outputs + 1 equal times, from 0 to a turn
  /// Floquet multipliers, the largest first: as many as the search met, those wanted among them to
  /// `multiplier_residuals`.
  std::vector<std::complex<double>> multipliers;
  std::vector<double> multiplier_residuals;
  std::vector<double> misses;  ///< of the iterations at the last speed
  std::vector<SpeedTried> speeds;
  int turns = 0;             ///< in all
  int flows = 0;             ///< linearised turns in all, but for the multipliers'
  int multiplier_flows = 0;  ///< theirs
  int steps_per_turn = 0;
  int iterations = 0;  ///< of Newton's method in the steps, in all
  double seconds = 0.0;
};

/// Why a history cannot be that of one turn, repeated; empty if it can.
std::string break_of_period(const TimeHistory& history, double period);

/// `keep_going` is asked after every turn; none: always. What the study's comments rule out ends
/// before any turn, with the reason.
PeriodicMotion find_periodic_motion(const Model& model, const PeriodicMotionStudy& study,
                                    const ModelingSettings& settings,
                                    const std::function<bool()>& keep_going = {});

}  // namespace flexura

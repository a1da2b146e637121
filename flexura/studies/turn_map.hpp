#pragma once

#include <optional>
#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/solvers/time_march.hpp"
#include "flexura/studies/free_state.hpp"

namespace flexura {

/// How a turn from time 0 to `duration` is integrated.
struct TurnSettings {
  double duration = 0.0;
  int outputs = 0;         ///< equal intervals; every step ends at the next output at the latest
  double tolerance = 0.0;  ///< of a step's error
  std::vector<double> breaks;  ///< times at which loads or imposed motions kink
};

/// One turn of a mechanism by Radau's method as a map of its free state (a PeriodMap): rotations
/// that wind in it by full turns have them taken off at its end.
/// Steps follow the tolerance, and are then kept for all states near the one they were made for:
/// so the map is smooth to what Newton's method leaves, and its flow can be taken by differences.
class TurnMap {
 public:
  TurnMap(MotionSystem& system, const Moment& about, TurnSettings settings);

  const FreeState& free_state() const { return free_state_; }
  bool turn(const Eigen::VectorXd& x, Eigen::VectorXd& end);
  bool flow(const Eigen::VectorXd& direction, Eigen::VectorXd& image);
  /// The moments at the outputs, from 0 to a turn, of the state of the last turn once more.
  bool record(std::vector<Moment>& moments);

  /// Time at which the last turn that did not come round ended.
  double failed_at() const { return failed_at_; }
  /// Of all turns.
  const MarchCounts& counts() const { return counts_; }
  /// Steps in a turn at present.
  int steps_per_turn() const { return static_cast<int>(steps_.size()); }

 private:
  struct Step {
    double length = 0.0;
    double end = 0.0;  ///< time
    bool breaks = false;
    bool is_output = false;
  };
  bool march(Moment& moment);
  bool repeat(Moment& moment, std::vector<Moment>* moments);
  bool close_turn(const Moment& start, Moment& end, Eigen::VectorXd& x);

  MotionSystem& system_;
  TurnSettings settings_;
  FreeState free_state_;
  std::vector<Eigen::Index> rotations_;  // places in q
  std::vector<Step> steps_;
  Eigen::VectorXd stepped_for_;  // the state that they were made for
  Eigen::VectorXd at_, end_;     // of the last turn
  Eigen::VectorXd multipliers_;  // at the start of a turn, about
  double failed_at_ = 0.0;
  MarchCounts counts_;
};

}  // namespace flexura

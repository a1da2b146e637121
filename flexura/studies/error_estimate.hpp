#pragma once

#include <memory>
#include <vector>

#include "flexura/assembly/system.hpp"

namespace flexura {

/// Measures a discretization by solving once more with a finer one from the same state.
class ErrorEstimate {
 public:
  /// The finer system of `system`; `available()` is false where there is nothing to refine.
  explicit ErrorEstimate(const System& system) : finer_(system.refined()) {}
  bool available() const { return finer_ != nullptr; }

  /// Solves the finer system at the load factor and held poses of `system`, from z; its unknowns.
  /// Counts into `iterations`. False where it does not converge.
  bool solve(const System& system, const std::vector<double>& z, int& iterations);
  const std::vector<double>& finer_state() const { return z_; }
  const System& finer() const { return *finer_; }
  /// Hands the finer system over, to go on with.
  std::unique_ptr<System> release() { return std::move(finer_); }

 private:
  /// Learns how many iterations leave the estimate within 5 % of the converged one, and up to which
  /// size of the first step, which grows with the loads, that will hold.
  void calibrate(const std::vector<double>& distances, double first_step);

  std::unique_ptr<System> finer_;
  int enough_ = 0;
  double largest_first_step_ = 0.0;
  std::vector<double> z_;
  std::vector<double> step_;
};

/// What a change from a system to its refined one has to be multiplied by to be the error: the
/// largest of its flexures' (TwoPort::error_ratio).
double error_ratio(const System& system);

}  // namespace flexura

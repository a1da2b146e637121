#pragma once

#include <Eigen/Dense>
#include <complex>

#include "flexura/assembly/motion_system.hpp"

namespace flexura {

/// Complex amplitudes of coordinates about a state: solutions of
///     (K + i w C - w^2 M) u = f,
/// where C is the system's own damping and, of every mode, `modal` times the critical.
class HarmonicMotion {
 public:
  HarmonicMotion(MotionSystem& system, const Moment& moment, double modal);

  /// Empty where nothing limits the amplitude.
  Eigen::VectorXcd solve(const Eigen::VectorXd& load, double w);

 private:
  Eigen::VectorXcd apply(const Eigen::VectorXcd& load) const;
  Eigen::VectorXcd solve_by_modes(const Eigen::VectorXd& load, double w) const;
  Eigen::VectorXcd solve_by_rank(const Eigen::VectorXd& load, double w) const;

  MotionSystem& system_;
  bool modes_stay_apart_ = true;  // the system's own damping couples none of them
  Eigen::MatrixXd shapes_;        // of the damped modes
  Eigen::MatrixXd momenta_;       // M shape
  Eigen::VectorXd squares_;
  Eigen::VectorXd losses_;  // 2 modal w of each
  MotionFactor<std::complex<double>> factor_;
};

}  // namespace flexura

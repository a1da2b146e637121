#pragma once

#include <Eigen/Dense>

#include "flexura/assembly/motion_system.hpp"

namespace flexura {

/// What the constraints of a mechanism leave free of its coordinates and rates, as a vector x near
/// a moment. With W the weights of coordinates (what displaces by a mean flexure length counts as
/// one) and G the constraints' derivatives there, let the columns of R span the rows of G/W and
/// those of N, orthonormal like them, what is across. Then
///     W (q - q_0) = N x_q + R c,    span W v = N x_v + R d
/// where c and d follow from the constraints and their rates, at q.
class FreeState {
 public:
  /// `span`: a time that makes rates as large as coordinates.
  FreeState(MotionSystem& system, const Moment& about, double span);

  Eigen::Index size() const { return 2 * free_; }
  Eigen::VectorXd reduce(const Moment& moment) const;
  /// Coordinates and rates at moment.time, the rest stays. False where the constraints cannot be
  /// closed: too far away.
  bool restore(const Eigen::VectorXd& x, Moment& moment) const;

 private:
  bool close(Moment& moment) const;
  /// Derivatives of the constraints along R at the moment of the last residual; G in full.
  Eigen::MatrixXd slopes(const Moment& moment, Eigen::MatrixXd& constraints) const;
  Eigen::VectorXd along_constraints(const Eigen::VectorXd& shares) const;
  Eigen::VectorXd along_free(const Eigen::Ref<const Eigen::VectorXd>& shares) const;
  Eigen::VectorXd free_part(const Eigen::VectorXd& scaled) const;

  MotionSystem& system_;
  double span_;
  Eigen::Index free_ = 0;
  Eigen::VectorXd origin_;
  Eigen::HouseholderQR<Eigen::MatrixXd> factor_;  // of (G/W)^T: its Q is [R N]
};

}  // namespace flexura

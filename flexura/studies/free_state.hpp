#pragma once

#include <Eigen/Dense>

#include "flexura/assembly/motion_system.hpp"

namespace flexura {

/// What the constraints of a mechanism leave free of its coordinates and rates, as a vector x near
/// a moment of rest. With W the weights of coordinates and G the constraints' derivatives there,
/// let the columns of R span the rows of G/W and those of N, orthonormal like them, what is across.
/// Then
///     W (q - q_0) = N L_q^-T x_q + R c,    W v = N L_v^-T x_v + R d
/// where c and d follow from the constraints and their rates, at q. The lengths of x are those of
/// energies, half their squares, in units of the mean EI/L of the flexures:
///     L_q L_q^T = N^T (K + M/span^2) N,    L_v L_v^T = N^T (M + small K) N,    K and M by W.
/// So a vibration keeps its length, where it is not damped, whether it is soft or stiff; what bends
/// a flexure by an angle counts about as much as that.
class FreeState {
 public:
  /// `span`: a time that is long for a vibration of the mechanism, in which what has no stiffness
  /// moves.
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
  using Factor = Eigen::LLT<Eigen::MatrixXd>;
  void measure(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, double span);
  Eigen::VectorXd along_free(const Eigen::Ref<const Eigen::VectorXd>& x, const Factor& by) const;
  Eigen::VectorXd free_part(const Eigen::VectorXd& whole, const Factor& by) const;

  MotionSystem& system_;
  Eigen::Index free_ = 0;
  Eigen::VectorXd origin_;
  Eigen::HouseholderQR<Eigen::MatrixXd> factor_;  // of (G/W)^T: its Q is [R N]
  Factor by_energy_;                              // L_q
  Factor by_momentum_;                            // L_v
};

}  // namespace flexura

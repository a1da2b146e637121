#pragma once

#include <Eigen/Dense>
#include <optional>

namespace flexura {

/// Small vibrations about an equilibrium: M x'' + K x = 0 with G x = 0.
struct Vibrations {
  Eigen::VectorXd squares;  ///< of the angular frequencies, ascending; negative: x grows
  Eigen::MatrixXd shapes;   ///< one per column, x.M x = 1
  bool found = false;
};

/// The `count` lowest by a dense solver. K and M are symmetric, M positive semidefinite. With M =
/// B^T B and A = [K + shift M, G^T; G, 0], the eigenvalues of the symmetric B (A^-1) B^T are
/// 1/(square + shift); the shift is zero unless A is then singular.
Vibrations dense_vibrations(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                            const Eigen::MatrixXd& constraints, int count);

/// Solutions x of (K + shift M) x + G^T lambda = b, G x = 0, and products with M.
class VibrationOperator {
 public:
  virtual ~VibrationOperator() = default;
  virtual Eigen::Index size() const = 0;
  /// At most so many frequencies are zero.
  virtual Eigen::Index most_rigid() const = 0;
  virtual bool set_shift(double shift) = 0;
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) const = 0;
  virtual Eigen::VectorXd multiply_mass(const Eigen::VectorXd& x) const = 0;
  /// How many squares are less than the given one, by the inertia of K - square M (Sylvester); none
  /// where that is singular. What `set_shift` did stays.
  virtual std::optional<int> count_below(double square) const = 0;
};

/// The same by Lanczos' method, which needs no matrix, at shifts that make K + shift M positive
/// definite: rigid motions and unstable ones come out like all others. That none was missed is
/// counted.
Vibrations sparse_vibrations(VibrationOperator& op, int count);

}  // namespace flexura

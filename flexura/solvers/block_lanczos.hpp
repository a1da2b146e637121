#pragma once

#include <Eigen/Dense>
#include <functional>

namespace flexura {

/// The largest eigenvalues of an operator S that is symmetric in the inner product x.M y, M
/// positive semidefinite: what M does not see has no eigenvalue.
struct SymmetricPencil {
  Eigen::Index size = 0;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& momentum)> inverse;  ///< S x from M x
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> multiply_mass;
};

/// Lanczos' method by blocks, every vector made orthogonal to all before: a space that grows until
/// the wanted eigenvalues have settled. A block finds eigenvalues that come several times; what a
/// space has missed all the same, `widen` lets in.
class BlockLanczos {
 public:
  explicit BlockLanczos(SymmetricPencil pencil);

  /// Grows the space until the `count` largest have settled, or all that there are. False where
  /// numbers are not finite.
  bool settle(Eigen::Index count);
  /// Adds a block that comes from nowhere.
  void widen() { from_nowhere_ = true; }

  const Eigen::VectorXd& values() const { return values_; }  ///< descending
  /// Of the `count` largest, x.M x = 1.
  Eigen::MatrixXd vectors(Eigen::Index count) const;
  bool is_exhausted() const { return exhausted_; }

 private:
  bool grow();
  Eigen::VectorXd next_random();
  bool append(Eigen::VectorXd x, double least);
  void reserve(Eigen::Index columns);
  void project();
  bool has_settled(Eigen::Index count) const;

  SymmetricPencil pencil_;
  Eigen::Index columns_ = 0;  // of the space
  Eigen::Index images_ = 0;   // how many of them have one
  Eigen::MatrixXd basis_;     // x.M x = 1
  Eigen::MatrixXd momenta_;   // M basis
  Eigen::MatrixXd matrix_;    // momenta . S basis
  Eigen::VectorXd values_;
  Eigen::MatrixXd shapes_;  // of the projected operator
  unsigned long long seed_ = 88172645463325252ULL;
  bool from_nowhere_ = true;
  bool exhausted_ = false;
};

}  // namespace flexura

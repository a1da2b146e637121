#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace flexura {

/// An eigenvalue that a space of directions has of a linearised map A, with its eigenvector.
struct RitzPair {
  std::complex<double> value;
  Eigen::VectorXcd vector;    ///< of length 1
  Eigen::VectorXcd residual;  ///< A vector - value vector
};

/// Orthonormal directions V and their images A V under a linearised map. The equations
/// (A - I) d = -r are solved in their span by least squares (GMRES, where directions are added as
/// remainders come), eigenvalues by Rayleigh and Ritz.
class FlowDirections {
 public:
  Eigen::Index count() const { return directions_.cols(); }
  void clear();

  /// The part of `x` across all directions, of length 1; empty where there is none to speak of.
  Eigen::VectorXd across(const Eigen::VectorXd& x) const;
  /// A direction as `across` gives it, and its image.
  void add(const Eigen::VectorXd& direction, const Eigen::VectorXd& image);
  Eigen::VectorXd direction(Eigen::Index k) const { return directions_.col(k); }
  void set_image(Eigen::Index k, const Eigen::VectorXd& image) { images_.col(k) = image; }

  /// The image of a step that was taken is known without a flow, from the ends of two turns:
  /// Broyden's update, of what is across the directions as if a turn left nothing of it.
  void learn(const Eigen::VectorXd& step, const Eigen::VectorXd& image);

  struct Solution {
    Eigen::VectorXd step;
    Eigen::VectorXd remainder;  ///< r + (A - I) step
  };
  Solution solve(const Eigen::VectorXd& r) const;

  /// The largest first.
  std::vector<RitzPair> ritz_pairs() const;

 private:
  Eigen::MatrixXd directions_;
  Eigen::MatrixXd images_;
};

}  // namespace flexura

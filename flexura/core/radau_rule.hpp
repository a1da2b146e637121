#pragma once

#include <Eigen/Dense>

namespace flexura {

/// Radau IIA of s stages on [0, 1]: nodes, the last of which is 1, and integrals of the polynomials
/// through them from 0 to each node; the last row are the weights. Order 2s - 1.
struct RadauRule {
  Eigen::VectorXd nodes;
  Eigen::MatrixXd integrals;
};

/// s >= 1.
RadauRule radau_rule(int stages);

}  // namespace flexura

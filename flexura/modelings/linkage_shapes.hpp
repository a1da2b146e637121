#pragma once

#include <Eigen/Dense>

namespace flexura {

/// How the inside of a flexure follows its tip, and vibrates with the tip held.
struct HeldShapes {
  Eigen::MatrixXd by_tip;      ///< three columns: by a displacement and a rotation of the tip
  Eigen::MatrixXd vibrations;  ///< the lowest, x.M x = 1
};

/// `tip`: that of internal unknowns, three rows. Where it is three of the unknowns alone, as that
/// of a mesh, all others are found by sparse factorizations.
HeldShapes held_shapes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                       const Eigen::MatrixXd& tip, int count);

}  // namespace flexura

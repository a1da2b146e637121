#pragma once

#include <Eigen/Dense>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// The unknowns that place a flexure between its bodies, in this order: position (2) and rotation
/// of the base body, rotation of the flexure's own base section (the body's where it is clamped,
/// free where it is pinned), then the same of the action body and tip.
inline constexpr int port_unknowns = 8;
enum PortUnknown {
  base_x,
  base_y,
  base_turn,
  base_section,
  action_x,
  action_y,
  action_turn,
  action_section
};

/// Arms as drawn: from the base body's centre to the flexure's base end, from the action body's
/// centre to its action end, and from there to the point (fixed to the tip section) whose
/// displacement the modeling relates to the load.
struct PortArms {
  Vec2 base;
  Vec2 action;
  Vec2 tip;
};

/// Where the tip's point is, seen from the base section: x, y from the base end in axes that turn
/// with the base section, and its rotation relative to it; with derivatives by the eight unknowns.
struct RelativePose {
  using Jacobian = Eigen::Matrix<double, 3, port_unknowns>;
  using Hessian = Eigen::Matrix<double, port_unknowns, port_unknowns>;

  Eigen::Vector3d value;
  Jacobian jacobian;
  Hessian hessian;  ///< of load . value
};

/// `q` holds the eight unknowns. With the complex numbers of the plane,
///     value = e^{-i psi_A} (x_B + e^{i phi_B} r_B + e^{i psi_B} r_P - x_A - e^{i phi_A} r_A).
RelativePose relative_pose(const double (&q)[port_unknowns], const PortArms& arms,
                           const Eigen::Vector3d& load);

}  // namespace flexura

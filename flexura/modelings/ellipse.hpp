#pragma once

#include <Eigen/Dense>
#include <optional>

#include "flexura/core/vec2.hpp"
#include "flexura/results/ellipse.hpp"

namespace flexura {

/// The compliance matrix at another point of the same body.
Eigen::Matrix3d shift_compliance(const Eigen::Matrix3d& compliance, Vec2 from, Vec2 to);

/// The ellipse of elasticity of a compliance matrix that holds at the point `at`: elastic weight
/// w = C_33, centre, and semi-axes sqrt(eigenvalues of the centre's 2x2 block / w), turned by 90
/// degrees, so that a force along one semi-axis displaces by w times the other's square. Absent
/// where no moment turns the body.
std::optional<Ellipse> make_ellipse(const Eigen::Matrix3d& compliance, Vec2 at);

/// The antipolar line of a point p with respect to an ellipse: all x with
/// (x - centre) . A^-1 (p - centre) = -1, A = a^2 u u^T + b^2 v v^T. It holds the poles (centres of
/// rotation) of all forces through p. Absent where p is the centre.
std::optional<Line2> antipolar_line(const Ellipse& ellipse, Vec2 p);

/// Matrix, ellipse, principal single-point compliances and directions, antipolar line of `at`.
ElasticityRecord make_elasticity_record(ElasticityRecord::Of of, const std::string& name, Vec2 at,
                                        const Eigen::Matrix3d& compliance);

}  // namespace flexura

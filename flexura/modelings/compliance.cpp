#include "flexura/modelings/compliance.hpp"

#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// Gauss points that integrate products of two sines of an angle that turns by `turning`.
int points_for(double turning) { return 12 + 2 * static_cast<int>(std::ceil(turning)); }

}  // namespace

Eigen::Matrix3d compliance_matrix(const FlexureProperties& flexure, Vec2 at) {
  const AxisCurve& axis = flexure.axis;
  const std::vector<double> breaks = flexure.smooth_breaks();
  const QuadratureRule& rule = gauss_legendre(points_for(axis.turning()));
  Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
  for (std::size_t piece = 0; piece + 1 < breaks.size(); ++piece) {
    const double half = 0.5 * (breaks[piece + 1] - breaks[piece]);
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double s = breaks[piece] + half * (1.0 + rule.nodes[g]);
      const double ds = half * rule.weights[g];
      const Vec2 arm = at - axis.position(s);
      const Vec2 t = unit(axis.tangent_angle(s));
      const Eigen::Vector3d v(-arm.y, arm.x, 1.0);
      const Eigen::Vector3d axial(t.x, t.y, 0.0);
      const Eigen::Vector3d normal(-t.y, t.x, 0.0);
      const FlexureProperties::Local local = flexure.at(s);
      c += (ds / local.bending_stiffness) * v * v.transpose();
      c += (ds * local.axial_compliance) * axial * axial.transpose();
      c += (ds * local.shear_compliance) * normal * normal.transpose();
    }
  }
  return c;
}

Vec2 elastic_centre(const Eigen::Matrix3d& compliance, Vec2 at) {
  const double w = compliance(2, 2);
  return at + Vec2{-compliance(2, 1) / w, compliance(2, 0) / w};
}

CompliantPort::CompliantPort(const FlexureProperties& flexure, Vec2 at)
    : flexure_(flexure),
      at_(at - flexure.axis.position(0.0)),
      compliance_(compliance_matrix(flexure, at)) {}

TipResponse CompliantPort::linearize(const Eigen::Vector3d& load, const double* /*internal*/,
                                     double* /*scratch*/) const {
  TipResponse response;
  const Eigen::Vector3d displacement = compliance_ * load;
  response.tip = Eigen::Vector3d(at_.x, at_.y, 0.0) + displacement;
  response.flexibility = compliance_;
  response.strain_energy = 0.5 * load.dot(displacement);
  return response;
}

/// The linear field between base and tip, from forces in equilibrium on the flexure as drawn.
std::vector<SectionState> CompliantPort::sections(const Eigen::Vector3d& load,
                                                  std::span<const double> /*internal*/) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  const Vec2 f{load[0], load[1]};
  const auto moment_at = [&](Vec2 r) { return load[2] + cross(at_ - r, f); };
  std::vector<SectionState> states;
  Vec2 strain;        // displacement by axial and shear strain
  double turn = 0.0;  // integral of M/EI
  Vec2 turn_moment;   // integral of M/EI r
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const Vec2 at = grid.positions[k];
    const Vec2 bending = perp(turn * at - turn_moment);
    const Vec2 t = unit(grid.angles[k]);
    states.push_back({{at + bending + strain, turn}, dot(f, t), dot(f, perp(t)), moment_at(at)});
    if (k + 1 == grid.s.size()) break;
    for (std::size_t g = grid.first[k]; g < grid.first[k + 1]; ++g) {
      const StationGrid::Node& node = grid.nodes[g];
      const Vec2 e = unit(node.angle);
      const FlexureProperties::Local local = flexure_.at(node.s);
      const double k_bending = node.weight * moment_at(node.position) / local.bending_stiffness;
      turn += k_bending;
      turn_moment = turn_moment + k_bending * node.position;
      strain = strain + node.weight * (local.axial_compliance * dot(f, e) * e +
                                       local.shear_compliance * dot(f, perp(e)) * perp(e));
    }
  }
  return states;
}

}  // namespace flexura

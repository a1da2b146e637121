#include "flexura/modelings/compliance.hpp"

#include <array>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/ellipse.hpp"
#include "flexura/modelings/link_compliance.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// Gauss points that integrate products of two sines of an angle that turns by `turning`.
int points_for(double turning) { return 12 + 2 * static_cast<int>(std::ceil(turning)); }

}  // namespace

Eigen::Matrix3d compliance_matrix(const FlexureProperties& flexure, Vec2 at) {
  const AxisCurve& axis = flexure.axis;
  if (flexure.compliance)
    return shift_compliance(*flexure.compliance, axis.position(axis.length()), at);
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
      compliance_(compliance_matrix(flexure, at)) {
  if (feels_surroundings()) integrate_field();
}

/// Section forces are linear in p = (load, a, b), a and b being the shares of the dead force ahead
/// in its drawn direction and at a right angle to it (clockwise):
///     W = -1/2 p.Q p - p.drawn - load_factor p.heat.
void CompliantPort::integrate_field() {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  std::vector<Vec2> slopes, ahead, across;
  for (const StationGrid::Node& node : grid.nodes) {
    slopes.push_back(unit(node.angle));
    ahead.push_back(flexure_.load_ahead(node.s));
    across.push_back(-1.0 * perp(ahead.back()));
  }
  const auto moments = moments_ahead(grid, slopes, ahead);
  const auto cross_moments = moments_ahead(grid, slopes, across);
  const Vec2 start = flexure_.axis.position(0.0);
  for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
    const StationGrid::Node& node = grid.nodes[k];
    const FlexureProperties::Local local = flexure_.at(node.s);
    const Vec2 t = slopes[k];
    const Vec2 n = perp(t);
    const Vec2 arm = start + at_ - flexure_.axis.position(node.s);
    Load5 axial, normal, moment;
    axial << t.x, t.y, 0.0, dot(ahead[k], t), dot(across[k], t);
    normal << n.x, n.y, 0.0, dot(ahead[k], n), dot(across[k], n);
    moment << -arm.y, arm.x, 1.0, moments.at_nodes[k], cross_moments.at_nodes[k];
    quadratic_ += node.weight * (local.axial_compliance * axial * axial.transpose() +
                                 local.shear_compliance * normal * normal.transpose() +
                                 moment * moment.transpose() / local.bending_stiffness);
    drawn_ += node.weight * axial;
    heat_ += node.weight * flexure_.field.strain * axial;
  }
  drawn_.head<3>() << at_.x, at_.y, 0.0;
}

TipResponse CompliantPort::linearize_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load, const double* /*internal*/,
                                        double* /*scratch*/, FieldResponse& field) const {
  using Jet = Jet2<5>;
  const Jet turn = Jet::variable(3, surroundings.turn);
  const Jet share = Jet::variable(4, surroundings.load_factor);
  std::array<Jet, 5> p{Jet::variable(0, load[0]), Jet::variable(1, load[1]),
                       Jet::variable(2, load[2]), share * cos(turn), share * sin(turn)};
  Jet w;
  if (surroundings.linearised) {
    p[3] = share;
    p[4] = Jet();
    w += -drawn_[4] * (share * turn);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    w += -drawn_[row] * p[i] - heat_[row] * (share * p[i]);
    for (std::size_t j = 0; j < 5; ++j)
      w += -0.5 * quadratic_(row, static_cast<Eigen::Index>(j)) * (p[i] * p[j]);
  }
  TipResponse response;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    response.tip[row] = -w.gradient[i];
    field.tip_by_turn[row] = -w.second(i, 3);
    field.tip_by_factor[row] = -w.second(i, 4);
    for (std::size_t j = 0; j < 3; ++j)
      response.flexibility(row, static_cast<Eigen::Index>(j)) = -w.second(i, j);
  }
  field.by_turn = w.gradient[3];
  field.by_factor = w.gradient[4];
  field.turn_turn = w.second(3, 3);
  field.turn_factor = w.second(3, 4);
  response.strain_energy =
      w.value + load.dot(response.tip) - surroundings.load_factor * field.by_factor;
  return response;
}

TipResponse CompliantPort::linearize(const Eigen::Vector3d& load, const double* /*internal*/,
                                     double* /*scratch*/) const {
  TipResponse response;
  const Eigen::Vector3d displacement = compliance_ * load;
  response.tip = Eigen::Vector3d(at_.x, at_.y, 0.0) + displacement;
  response.flexibility = compliance_;
  response.strain_energy = 0.5 * load.dot(displacement);
  return response;
}

/// From the displacement of the end, which is fixed to the point that the matrix is about.
std::vector<SectionState> CompliantPort::stations_of_link(const Eigen::Vector3d& load) const {
  const AxisCurve& axis = flexure_.axis;
  const Vec2 drawn = axis.position(axis.length()) - axis.position(0.0);
  const Eigen::Vector3d d = compliance_ * load;
  const Vec2 f{load[0], load[1]};
  const Vec2 end = drawn + Vec2{d[0], d[1]} + d[2] * perp(drawn - at_);
  return link_sections(drawn, {end, d[2]}, {f.x, f.y, load[2] + cross(at_ - drawn, f)}, true);
}

/// The linear field between base and tip, from forces in equilibrium on the flexure as drawn.
std::vector<SectionState> CompliantPort::sections_in(const Surroundings& surroundings,
                                                     const Eigen::Vector3d& load,
                                                     std::span<const double> /*internal*/) const {
  if (flexure_.compliance) return stations_of_link(load);
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  const Vec2 f{load[0], load[1]};
  const double share = surroundings.load_factor;
  const auto dead = [&](double s) {
    if (!feels_surroundings()) return Vec2{};
    const double turn = surroundings.linearised ? 0.0 : surroundings.turn;
    return share * rotate(-turn, flexure_.load_ahead(s));
  };
  std::vector<Vec2> slopes, forces;
  for (const StationGrid::Node& node : grid.nodes) {
    slopes.push_back(unit(node.angle));
    forces.push_back(dead(node.s));
  }
  const auto dead_moments = moments_ahead(grid, slopes, forces);
  const auto moment_at = [&](Vec2 r) { return load[2] + cross(at_ - r, f); };
  std::vector<SectionState> states;
  Vec2 strain;        // displacement by axial and shear strain
  double turn = 0.0;  // integral of M/EI
  Vec2 turn_moment;   // integral of M/EI r
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const Vec2 at = grid.positions[k];
    const Vec2 bending = perp(turn * at - turn_moment);
    const Vec2 t = unit(grid.angles[k]);
    const Vec2 force = f + dead(grid.s[k]);
    states.push_back({{at + bending + strain, turn},
                      dot(force, t),
                      dot(force, perp(t)),
                      moment_at(at) + dead_moments.at_stations[k]});
    if (k + 1 == grid.s.size()) break;
    for (std::size_t g = grid.first[k]; g < grid.first[k + 1]; ++g) {
      const StationGrid::Node& node = grid.nodes[g];
      const Vec2 e = unit(node.angle);
      const Vec2 n = f + forces[g];
      const FlexureProperties::Local local = flexure_.at(node.s);
      const double k_bending = node.weight * (moment_at(node.position) + dead_moments.at_nodes[g]) /
                               local.bending_stiffness;
      turn += k_bending;
      turn_moment = turn_moment + k_bending * node.position;
      strain =
          strain +
          node.weight * ((local.axial_compliance * dot(n, e) + share * flexure_.field.strain) * e +
                         local.shear_compliance * dot(n, perp(e)) * perp(e));
    }
  }
  return states;
}

}  // namespace flexura

#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "flexura/assembly/two_port.hpp"
#include "flexura/core/jet2.hpp"
#include "flexura/core/symmetric_factor.hpp"

namespace flexura {

/// A flexure whose sections turn by angles linear in its internal unknowns y,
///     theta_g = theta0_g + J_g . y   at points g with weights w_g,
/// and whose end is found by adding up the tangents of its points. Two modelings are of this kind:
/// the exact flexure (points are Gauss points, y its moment modes) and the pseudo-rigid-body
/// chain (points are rigid segments, y its joint rotations). With a mixed potential phi per point,
///     W(y, f, mu) = 1/2 y.S y + sum_g w_g phi_g(theta_g, f) - f . offset - mu R . y,
/// where -d(phi)/d(f) is the derivative of the deformed axis and
/// offset = chord as drawn - sum_g w_g t(theta0_g): the flexure is free of stress as drawn whatever
/// the quadrature.
struct AngleField {
  /// Points come in pairs: an odd one out gets a companion without weight.
  void complete_pairs() {
    if (weights.size() % 2 == 0) return;
    weights.push_back(0.0);
    angles.push_back(0.0);
    places.push_back(0.0);
    turns.resize(turns.size() + unknowns, 0.0);
  }

  std::size_t unknowns = 0;
  std::vector<double> weights;
  std::vector<double> angles;     ///< theta0
  std::vector<double> turns;      ///< J, points x unknowns, row-major
  std::vector<double> places;     ///< arc lengths
  std::vector<double> tip_turn;   ///< R
  std::vector<double> stiffness;  ///< S, unknowns x unknowns, row-major
  Vec2 offset;

  std::size_t scratch_size() const { return unknowns * (2 * unknowns + 9); }

  /// theta_g - theta0_g.
  double turn(std::size_t point, const double* y) const {
    const double* j = turns.data() + point * unknowns;
    double angle = 0.0;
    for (std::size_t i = 0; i < unknowns; ++i) angle += j[i] * y[i];
    return angle;
  }
};

/// The sum of both lanes.
template <std::size_t N>
Jet2<N> add_lanes(const Jet2<N, Pack2>& pair) {
  Jet2<N> sum(pair.value[0] + pair.value[1]);
  for (std::size_t i = 0; i < N; ++i) sum.gradient[i] = pair.gradient[i][0] + pair.gradient[i][1];
  for (std::size_t k = 0; k < sum.hessian.size(); ++k)
    sum.hessian[k] = pair.hessian[k][0] + pair.hessian[k][1];
  return sum;
}

/// What all points of an angle field add up to, besides what depends on the internal unknowns.
struct AngleFieldSums {
  Jet2<3> potential;  ///< of it, only value and derivatives by the force are meant
  double bending = 0.0;
  double tip_rotation = 0.0;
};

/// Residual and tangent: per unknown W_y, W_yfx, W_yfy, W_ymu in `columns`, W_yy in the lower
/// triangle of `tangent` (m x m, row-major). `potential(point, theta, fx, fy)` is phi on
/// Jet2<3, Pack2>: points are evaluated in pairs.
template <class Potential>
AngleFieldSums assemble_angle_field(const AngleField& field, const Potential& potential,
                                    const Eigen::Vector3d& load, const double* y,
                                    double* __restrict columns, double* __restrict tangent) {
  using Jet = Jet2<3, Pack2>;
  const std::size_t m = field.unknowns;
  std::fill(columns, columns + 4 * m, 0.0);
  std::copy(field.stiffness.begin(), field.stiffness.end(), tangent);

  const Jet fx = Jet::variable(1, Pack2{load[0], load[0]});
  const Jet fy = Jet::variable(2, Pack2{load[1], load[1]});
  Jet pairs;
  for (std::size_t g = 0; g < field.weights.size(); g += 2) {
    const double* __restrict turn0 = field.turns.data() + g * m;
    const double* __restrict turn1 = turn0 + m;
    const Pack2 angle{field.angles[g] + field.turn(g, y),
                      field.angles[g + 1] + field.turn(g + 1, y)};
    Jet phi = potential(g, Jet::variable(0, angle), fx, fy);
    phi *= Pack2{field.weights[g], field.weights[g + 1]};
    const Pack2 by_angle = phi.gradient[0];
    const Pack2 by_fx = phi.second(0, 1);
    const Pack2 by_fy = phi.second(0, 2);
    const Pack2 by_angle_twice = phi.second(0, 0);
    for (std::size_t i = 0; i < m; ++i) {
      const double j0 = turn0[i];
      const double j1 = turn1[i];
      columns[4 * i] += by_angle[0] * j0 + by_angle[1] * j1;
      columns[4 * i + 1] += by_fx[0] * j0 + by_fx[1] * j1;
      columns[4 * i + 2] += by_fy[0] * j0 + by_fy[1] * j1;
      const double scaled0 = by_angle_twice[0] * j0;
      const double scaled1 = by_angle_twice[1] * j1;
      double* row = tangent + i * m;
      for (std::size_t k = 0; k <= i; ++k) row[k] += scaled0 * turn0[k] + scaled1 * turn1[k];
    }
    pairs += phi;
  }
  AngleFieldSums sums{add_lanes(pairs)};
  for (std::size_t i = 0; i < m; ++i) {
    double stiff = 0.0;
    for (std::size_t k = 0; k < m; ++k) stiff += field.stiffness[i * m + k] * y[k];
    sums.bending += 0.5 * stiff * y[i];
    sums.tip_rotation += field.tip_turn[i] * y[i];
    columns[4 * i] += stiff - load[2] * field.tip_turn[i];
    columns[4 * i + 3] = -field.tip_turn[i];
  }
  return sums;
}

/// TwoPort::linearize of an angle field.
template <class Potential>
TipResponse linearize_angle_field(const AngleField& field, const Potential& potential,
                                  const Eigen::Vector3d& load, const double* y, double* scratch) {
  const std::size_t m = field.unknowns;
  double* columns = scratch;  // W_y.., then the same times the inverse of W_yy
  double* coupling = scratch + 4 * m;
  double* tangent = scratch + 8 * m;
  double* factor = scratch + (8 + m) * m;
  double* column = scratch + (8 + 2 * m) * m;
  const AngleFieldSums sums = assemble_angle_field(field, potential, load, y, columns, tangent);
  std::copy(columns, columns + 4 * m, coupling);

  const Jet2<3>& sum = sums.potential;
  TipResponse response;
  response.singular =
      !solve_symmetric(tangent, dense_layout(m), factor, column, columns, response.negative);
  response.strain_energy =
      sums.bending + sum.value - load[0] * sum.gradient[1] - load[1] * sum.gradient[2];
  response.tip = {field.offset.x - sum.gradient[1], field.offset.y - sum.gradient[2],
                  sums.tip_rotation};
  response.flexibility << -sum.second(1, 1), -sum.second(1, 2), 0.0,  //
      -sum.second(2, 1), -sum.second(2, 2), 0.0,                      //
      0.0, 0.0, 0.0;
  add_eliminated(m, coupling, columns, response);
  return response;
}

/// TwoPort::hessian of an angle field.
template <class Potential>
Eigen::MatrixXd angle_field_hessian(const AngleField& field, const Potential& potential,
                                    const Eigen::Vector3d& load, const double* y) {
  const std::size_t m = field.unknowns;
  std::vector<double> columns(4 * m), tangent(m * m);
  const AngleFieldSums sums =
      assemble_angle_field(field, potential, load, y, columns.data(), tangent.data());
  Eigen::Matrix3d by_load = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      by_load(i, j) =
          sums.potential.second(static_cast<std::size_t>(i) + 1, static_cast<std::size_t>(j) + 1);
  return port_hessian(columns.data(), dense_layout(m), tangent.data(), by_load);
}

}  // namespace flexura

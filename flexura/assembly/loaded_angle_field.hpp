#pragma once

#include <vector>

#include "flexura/assembly/angle_field.hpp"

namespace flexura {

/// What acts along an angle field, per load factor: at every point the dead force on all that lies
/// ahead of it (axes as drawn), and the axial strain of a free flexure, by temperature.
struct FieldLoad {
  std::vector<Vec2> ahead;
  double strain = 0.0;
};

/// TwoPort::linearize_in of an angle field. The force of a section is the tip's and that ahead,
///     n_g = f + load_factor R(-turn) ahead_g,
/// and W(y, f, mu) = 1/2 y.S y + sum_g w_g [ phi_g(theta_g, n_g) - load_factor strain n_g.t_g ]
///                   - f.offset - mu R.y.
/// Scratch: that of the field and 8 m doubles more.
template <class Potential>
TipResponse linearize_loaded_angle_field(const AngleField& field, const FieldLoad& acting,
                                         const Surroundings& surroundings,
                                         const Potential& potential, const Eigen::Vector3d& load,
                                         const double* y, double* scratch, FieldResponse& by) {
  using Jet = Jet2<3, Pack2>;
  const std::size_t m = field.unknowns;
  double* columns = scratch;  // as linearize_angle_field, then those by turn and factor
  double* field_columns = scratch + 4 * m;
  double* coupling = scratch + 8 * m;
  double* field_coupling = scratch + 12 * m;
  double* tangent = scratch + 16 * m;
  double* factor = tangent + m * m;
  double* column = factor + m * m;
  std::fill(scratch, scratch + 8 * m, 0.0);
  std::copy(field.stiffness.begin(), field.stiffness.end(), tangent);

  const double share = surroundings.load_factor;
  by = {};
  double value = 0.0;
  Eigen::Vector2d by_force = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_force_twice = Eigen::Matrix2d::Zero();
  for (std::size_t g = 0; g < field.weights.size(); g += 2) {
    const Vec2 rate[2] = {rotate(-surroundings.turn, acting.ahead[g]),
                          rotate(-surroundings.turn, acting.ahead[g + 1])};
    const Jet theta = Jet::variable(
        0, Pack2{field.angles[g] + field.turn(g, y), field.angles[g + 1] + field.turn(g + 1, y)});
    const Jet nx =
        Jet::variable(1, Pack2{load[0] + share * rate[0].x, load[0] + share * rate[1].x});
    const Jet ny =
        Jet::variable(2, Pack2{load[1] + share * rate[0].y, load[1] + share * rate[1].y});
    const Jet elongation = acting.strain * (nx * cos(theta) + ny * sin(theta));
    const Jet phi = potential(g, theta, nx, ny) - share * elongation;
    for (std::size_t lane = 0; lane < 2; ++lane) {
      const double w = field.weights[g + lane];
      const double* turn = field.turns.data() + (g + lane) * m;
      const Eigen::Vector2d n(phi.gradient[1][lane], phi.gradient[2][lane]);
      const Eigen::Vector2d angle_n(phi.second(0, 1)[lane], phi.second(0, 2)[lane]);
      Eigen::Matrix2d nn;
      nn << phi.second(1, 1)[lane], phi.second(1, 2)[lane], phi.second(2, 1)[lane],
          phi.second(2, 2)[lane];
      const Eigen::Vector2d heat(elongation.gradient[1][lane], elongation.gradient[2][lane]);
      const Eigen::Vector2d grow(rate[lane].x, rate[lane].y);
      const Eigen::Vector2d spin = share * Eigen::Vector2d(rate[lane].y, -rate[lane].x);
      value += w * phi.value[lane];
      by_force += w * n;
      by_force_twice += w * nn;
      by.by_turn += w * n.dot(spin);
      by.by_factor += w * (n.dot(grow) - elongation.value[lane]);
      by.tip_by_turn.head<2>() -= w * nn * spin;
      by.tip_by_factor.head<2>() -= w * (nn * grow - heat);
      by.turn_turn += w * (spin.dot(nn * spin) - share * n.dot(grow));
      by.turn_factor +=
          w * (spin.dot(nn * grow) - heat.dot(spin) + n.dot(Eigen::Vector2d(grow[1], -grow[0])));
      const double angle = w * phi.gradient[0][lane];
      const double angle_twice = w * phi.second(0, 0)[lane];
      const double angle_turn = w * angle_n.dot(spin);
      const double angle_factor = w * (angle_n.dot(grow) - elongation.gradient[0][lane]);
      for (std::size_t i = 0; i < m; ++i) {
        columns[4 * i] += angle * turn[i];
        columns[4 * i + 1] += w * angle_n[0] * turn[i];
        columns[4 * i + 2] += w * angle_n[1] * turn[i];
        field_columns[4 * i] += angle_turn * turn[i];
        field_columns[4 * i + 1] += angle_factor * turn[i];
        for (std::size_t k = 0; k <= i; ++k) tangent[i * m + k] += angle_twice * turn[i] * turn[k];
      }
    }
  }
  double bending = 0.0;
  double tip_rotation = 0.0;
  for (std::size_t i = 0; i < m; ++i) {
    double stiff = 0.0;
    for (std::size_t k = 0; k < m; ++k) stiff += field.stiffness[i * m + k] * y[k];
    bending += 0.5 * stiff * y[i];
    tip_rotation += field.tip_turn[i] * y[i];
    columns[4 * i] += stiff - load[2] * field.tip_turn[i];
    columns[4 * i + 3] = -field.tip_turn[i];
  }
  std::copy(scratch, scratch + 8 * m, coupling);
  TipResponse response;
  int negative = 0;
  response.singular =
      !solve_symmetric(tangent, dense_layout(m), factor, column, columns, response.negative) ||
      !solve_symmetric(tangent, dense_layout(m), factor, column, field_columns, negative);
  // partial derivatives at y: the work of all forces on what they displace
  response.strain_energy = bending + value - load.head<2>().dot(by_force) - share * by.by_factor;
  response.tip = {field.offset.x - by_force[0], field.offset.y - by_force[1], tip_rotation};
  response.flexibility.setZero();
  response.flexibility.topLeftCorner<2, 2>() = -by_force_twice;
  add_eliminated(m, coupling, columns, response);
  add_eliminated_field(m, coupling, columns, field_coupling, field_columns, by);
  return response;
}

}  // namespace flexura

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "flexura/core/jet2.hpp"
#include "flexura/core/symmetric_factor.hpp"
#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/beam_mesh.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {

/// Beam elements from an energy density: Lagrange interpolation of displacement and rotation on
/// Gauss-Lobatto nodes, one Gauss point less per element than nodes, so that nothing locks.
///
/// `Density` is a value type with a template
///     Scalar operator()(dx, dy, theta, kappa, stretch) const
/// that gives the strain energy per length from the derivative (dx, dy) of the position by the arc
/// length of the undeformed axis, the angle theta of the section's normal, and the curvature change
/// kappa; `stretch` is the length of (dx, dy) at rest. Residual and tangent follow by
/// differentiation at the Gauss points. docs/new_element.md shows how to add one.
template <class Density>
class LagrangeBeamPort final : public TwoPort {
 public:
  LagrangeBeamPort(const FlexureProperties& flexure, BeamSettings settings, Density density)
      : flexure_(flexure),
        density_(std::move(density)),
        settings_(settings),
        mesh_(flexure.axis, settings.elements, settings.order),
        chord_(flexure.axis.position(mesh_.length) - flexure.axis.position(0.0)) {
    if (feels_surroundings()) dead_ = dead_load_on(mesh_, flexure_);
  }

  std::size_t internal_size() const override { return 3 * (mesh_.nodes() - 1); }
  std::size_t scratch_size() const override {
    return elimination_size() + (feels_surroundings() ? 12 * internal_size() : 0);
  }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  bool feels_surroundings() const override { return flexure_.field.acts(); }
  TipResponse linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                           const double* internal, double* scratch,
                           FieldResponse& field) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return sections_in({}, load, internal);
  }
  std::vector<SectionState> sections_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load,
                                        std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override {
    return std::make_shared<LagrangeBeamPort>(
        flexure_, BeamSettings{2 * settings_.elements, settings_.order, {}}, density_);
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return halving_error_ratio(mesh_); }

  /// Half bandwidth of the energy's Hessian.
  std::size_t width() const { return 3 * (mesh_.order + 1) - 1; }
  /// The energy; its gradient into every fourth of 4 m doubles of `columns`, its Hessian into the
  /// `band` (lower rows of width + 1), both overwritten. `heat` stretches without stress.
  double assemble(const double* y, double* columns, double* band, double heat) const;
  const BeamMesh& mesh() const { return mesh_; }
  const Density& density() const { return density_; }

 private:
  std::size_t elimination_size() const { return internal_size() * (4 + 2 * (width() + 1) + 1); }
  double add_point(std::size_t element, std::size_t gauss, const double* y, double* residual,
                   double* band, double heat) const;
  double assemble(const double* y, double* scratch, double heat = 0.0) const {
    return assemble(y, scratch, scratch + 4 * internal_size(), heat);
  }
  double add_heat(std::size_t element, std::size_t gauss, const double* y, double heat,
                  double* columns) const;
  DisplacementElements elements() const {
    return {internal_size(), width(), internal_size() - 3, mesh_.length, chord_};
  }

  FlexureProperties flexure_;
  Density density_;
  BeamSettings settings_;
  BeamMesh mesh_;
  Vec2 chord_;
  DeadLoad dead_;
};

/// Adds one Gauss point to residual and tangent. Unknowns of node k >= 1 are y[3 (k-1)..]: the
/// displacement over the flexure's length, and the rotation. The density's four variables are
/// linear in them, so the chain rule is a pair of products with shape values.
template <class Density>
double LagrangeBeamPort<Density>::add_point(std::size_t element, std::size_t gauss, const double* y,
                                            double* residual, double* band, double heat) const {
  using Jet = Jet2<4>;
  const std::size_t per = mesh_.order + 1;
  const double* n = mesh_.shape.data() + gauss * per;
  const double* d = mesh_.slope.data() + gauss * per;
  const BeamMesh::GaussPoint& point = mesh_.points[element * mesh_.order + gauss];
  const std::size_t first = element * mesh_.order;  // node
  const double length = mesh_.length;

  double dx = point.tangent.x, dy = point.tangent.y, theta = point.angle, kappa = 0.0;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const double* node = y + 3 * (first + a - 1);
    dx += length * d[a] * node[0];
    dy += length * d[a] * node[1];
    theta += n[a] * node[2];
    kappa += d[a] * node[2];
  }
  const auto energy_of = [&](const auto& density) {
    return density(Jet::variable(0, dx), Jet::variable(1, dy), Jet::variable(2, theta),
                   Jet::variable(3, kappa), point.stretch + heat);
  };
  Jet energy = [&] {
    if constexpr (requires { density_.at(point.s); })  // of a section that varies
      return energy_of(density_.at(point.s));
    else
      return energy_of(density_);
  }();
  energy *= point.weight;

  const std::size_t stride = width() + 1;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const double da = length * d[a];
    const std::size_t i = 3 * (first + a - 1);
    residual[4 * i] += da * energy.gradient[0];
    residual[4 * (i + 1)] += da * energy.gradient[1];
    residual[4 * (i + 2)] += n[a] * energy.gradient[2] + d[a] * energy.gradient[3];
    // Hessian times the columns of node a
    std::array<std::array<double, 3>, 4> h;
    for (std::size_t v = 0; v < 4; ++v)
      h[v] = {da * energy.second(v, 0), da * energy.second(v, 1),
              n[a] * energy.second(v, 2) + d[a] * energy.second(v, 3)};
    double* row[3];  // row[r][c] is entry (i + r, c)
    for (std::size_t r = 0; r < 3; ++r) row[r] = band + (i + r) * stride + width() - (i + r);
    for (std::size_t b = first == 0 ? 1 : 0; b < a; ++b) {
      const double db = length * d[b];
      const std::size_t j = 3 * (first + b - 1);
      for (std::size_t r = 0; r < 3; ++r) {
        row[r][j] += db * h[0][r];
        row[r][j + 1] += db * h[1][r];
        row[r][j + 2] += n[b] * h[2][r] + d[b] * h[3][r];
      }
    }
    for (std::size_t r = 0; r < 3; ++r) {  // the node's own block: its lower triangle
      row[r][i] += da * h[0][r];
      if (r > 0) row[r][i + 1] += da * h[1][r];
      if (r > 1) row[r][i + 2] += n[a] * h[2][r] + d[a] * h[3][r];
    }
  }
  return energy.value;
}

template <class Density>
double LagrangeBeamPort<Density>::assemble(const double* y, double* columns, double* band,
                                           double heat) const {
  std::fill_n(columns, 4 * internal_size(), 0.0);
  std::fill_n(band, internal_size() * (width() + 1), 0.0);
  double energy = 0.0;
  for (std::size_t e = 0; e < mesh_.elements; ++e)
    for (std::size_t g = 0; g < mesh_.order; ++g) energy += add_point(e, g, y, columns, band, heat);
  return energy;
}

template <class Density>
TipResponse LagrangeBeamPort<Density>::linearize(const Eigen::Vector3d& load, const double* y,
                                                 double* scratch) const {
  TipResponse response;
  response.strain_energy = assemble(y, scratch);
  eliminate_displacements(elements(), load, y, scratch, response);
  return response;
}

/// Adds W_y,heat of one Gauss point, the derivative by the free axial strain, to every fourth
/// double; its W_heat.
template <class Density>
double LagrangeBeamPort<Density>::add_heat(std::size_t element, std::size_t gauss, const double* y,
                                           double heat, double* columns) const {
  using Jet = Jet2<5>;
  const std::size_t per = mesh_.order + 1;
  const double* n = mesh_.shape.data() + gauss * per;
  const double* d = mesh_.slope.data() + gauss * per;
  const BeamMesh::GaussPoint& point = mesh_.points[element * mesh_.order + gauss];
  const std::size_t first = element * mesh_.order;
  double dx = point.tangent.x, dy = point.tangent.y, theta = point.angle, kappa = 0.0;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const double* node = y + 3 * (first + a - 1);
    dx += mesh_.length * d[a] * node[0];
    dy += mesh_.length * d[a] * node[1];
    theta += n[a] * node[2];
    kappa += d[a] * node[2];
  }
  const auto energy_of = [&](const auto& density) {
    const std::array<Jet, 4> v{Jet::variable(0, dx), Jet::variable(1, dy), Jet::variable(2, theta),
                               Jet::variable(3, kappa)};
    const Jet stretch = Jet::variable(4, point.stretch + heat);
    if constexpr (requires { density(v[0], v[1], v[2], v[3], stretch); })
      return density(v[0], v[1], v[2], v[3], stretch);
    else  // takes the stretch as a number: knows no heat
      return density(v[0], v[1], v[2], v[3], point.stretch);
  };
  Jet energy = [&] {
    if constexpr (requires { density_.at(point.s); })
      return energy_of(density_.at(point.s));
    else
      return energy_of(density_);
  }();
  energy *= point.weight;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const std::size_t i = 3 * (first + a - 1);
    columns[4 * i] += mesh_.length * d[a] * energy.second(0, 4);
    columns[4 * (i + 1)] += mesh_.length * d[a] * energy.second(1, 4);
    columns[4 * (i + 2)] += n[a] * energy.second(2, 4) + d[a] * energy.second(3, 4);
  }
  return energy.gradient[4];
}

template <class Density>
TipResponse LagrangeBeamPort<Density>::linearize_in(const Surroundings& surroundings,
                                                    const Eigen::Vector3d& load, const double* y,
                                                    double* scratch, FieldResponse& field) const {
  const std::size_t m = internal_size();
  const double strain = flexure_.field.strain;
  const double heat = surroundings.load_factor * strain;
  double* field_coupling = scratch + 8 * m;
  double* work = scratch + 12 * m;
  TipResponse response;
  response.strain_energy = assemble(y, work, heat);
  std::fill_n(scratch, 12 * m, 0.0);
  double by_heat = 0.0;
  if (strain != 0.0)
    for (std::size_t e = 0; e < mesh_.elements; ++e)
      for (std::size_t g = 0; g < mesh_.order; ++g)
        by_heat += add_heat(e, g, y, heat, field_coupling + 1);
  for (std::size_t i = 0; i < m; ++i) field_coupling[4 * i + 1] *= strain;
  field = {};
  field.by_factor = strain * by_heat;
  dead_.add(surroundings, mesh_.length, y, work, field_coupling, field);
  response.strain_energy -= strain != 0.0 ? heat * by_heat : 0.0;
  eliminate_with_fields(elements(), load, y, scratch, response, field);
  return response;
}

template <class Density>
Eigen::MatrixXd LagrangeBeamPort<Density>::hessian(const Eigen::Vector3d& /*load*/,
                                                   const double* y) const {
  std::vector<double> scratch(scratch_size());
  assemble(y, scratch.data());
  return displacement_hessian(elements(), scratch.data());
}

template <class Density>
std::vector<SectionState> LagrangeBeamPort<Density>::sections_in(
    const Surroundings& surroundings, const Eigen::Vector3d& load,
    std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  std::vector<double> nodal(3, 0.0);
  nodal.insert(nodal.end(), internal.begin(), internal.end());
  const auto moved_at = [&](double s, Vec2 drawn) {
    double u[3];
    mesh_.interpolate(s, nodal, u);
    return Pose{drawn + mesh_.length * Vec2{u[0], u[1]}, u[2]};
  };
  const Vec2 tip = chord_ + mesh_.length * Vec2{nodal[nodal.size() - 3], nodal[nodal.size() - 2]};
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k)
    states.push_back(section_at(grid, k, moved_at(grid.s[k], grid.positions[k]), tip, load));
  if (!feels_surroundings()) return states;
  std::vector<Vec2> nodes;
  for (const StationGrid::Node& node : grid.nodes)
    nodes.push_back(moved_at(node.s, node.position).position);
  add_dead_forces(grid, flexure_, surroundings, nodes, states);
  return states;
}

/// Rotations are interpolated; positions follow from them, without axial and shear strain.
/// (Positions interpolated as well would stretch a thin curved flexure out of all proportion.)
template <class Density>
void LagrangeBeamPort<Density>::prolong(std::span<const double> internal,
                                        std::span<double> refined) const {
  const BeamMesh fine(flexure_.axis, 2 * settings_.elements, settings_.order);
  std::vector<double> coarse_turns, turns(fine.nodes() - 1);
  for (std::size_t i = 2; i < internal.size(); i += 3) coarse_turns.push_back(internal[i]);
  prolong_nodes(mesh_, fine, 1, coarse_turns, turns);
  turns.insert(turns.begin(), 0.0);

  const std::vector<double> integrate = fine.antiderivative();
  Vec2 start;  // displacement of the element's first node
  for (std::size_t e = 0; e < fine.elements; ++e) {
    std::vector<Vec2> slopes;
    for (std::size_t g = 0; g < fine.order; ++g) {
      double turn = 0.0;
      for (std::size_t a = 0; a <= fine.order; ++a)
        turn += fine.shape[g * (fine.order + 1) + a] * turns[e * fine.order + a];
      const Vec2 tangent = fine.points[e * fine.order + g].tangent;
      slopes.push_back(rotate(turn, tangent) - tangent);
    }
    Vec2 moved;
    for (std::size_t a = 1; a <= fine.order; ++a) {
      moved = start;
      for (std::size_t g = 0; g < fine.order; ++g)
        moved = moved + integrate[a * fine.order + g] * slopes[g];
      const std::size_t node = e * fine.order + a;
      refined[3 * (node - 1)] = moved.x / fine.length;
      refined[3 * (node - 1) + 1] = moved.y / fine.length;
      refined[3 * (node - 1) + 2] = turns[node];
    }
    start = moved;
  }
}

}  // namespace flexura

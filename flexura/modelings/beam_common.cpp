#include "flexura/modelings/beam_common.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "flexura/core/symmetric_factor.hpp"

namespace flexura {

double halving_error_ratio(const BeamMesh& mesh) {
  return 1.0 / (1.0 - std::pow(0.25, static_cast<double>(mesh.order)));
}

void prolong_nodes(const BeamMesh& mesh, const BeamMesh& finer, std::size_t components,
                   std::span<const double> coarse, std::span<double> fine) {
  std::vector<double> nodal(components, 0.0);
  nodal.insert(nodal.end(), coarse.begin(), coarse.end());
  const double h = finer.length / static_cast<double>(finer.elements);
  std::size_t k = 0;
  for (std::size_t e = 0; e < finer.elements; ++e)
    for (std::size_t a = 1; a <= finer.order; ++a, ++k)
      mesh.interpolate(h * (static_cast<double>(e) + finer.node_place(a)), nodal,
                       fine.subspan(k * components, components));
}

namespace {

void add_tip_load(const DisplacementElements& e, const Eigen::Vector3d& load, double* columns) {
  const double lever[3] = {e.length, e.length, 1.0};  // of the tip's unknowns on its pose
  for (std::size_t c = 0; c < 3; ++c) {
    columns[4 * (e.tip + c)] -= lever[c] * load[static_cast<Eigen::Index>(c)];
    columns[4 * (e.tip + c) + c + 1] = -lever[c];
  }
}

}  // namespace

Eigen::MatrixXd displacement_hessian(const DisplacementElements& e, double* scratch) {
  add_tip_load(e, Eigen::Vector3d::Zero(), scratch);
  return port_hessian(scratch, band_layout(e.unknowns, e.width), scratch + 4 * e.unknowns,
                      Eigen::Matrix3d::Zero());
}

void eliminate_displacements(const DisplacementElements& e, const Eigen::Vector3d& load,
                             const double* y, double* scratch, TipResponse& response) {
  double* columns = scratch;
  double* band = scratch + 4 * e.unknowns;
  const double lever[3] = {e.length, e.length, 1.0};
  add_tip_load(e, load, columns);
  const std::size_t size = e.unknowns * (e.width + 1);
  response.singular = !solve_symmetric(band, band_layout(e.unknowns, e.width), band + size,
                                       band + 2 * size, columns, response.negative);
  response.tip << e.chord.x, e.chord.y, 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    response.tip[row] += lever[c] * (y[e.tip + c] - columns[4 * (e.tip + c)]);
    for (std::size_t k = 0; k < 3; ++k)
      response.flexibility(row, static_cast<Eigen::Index>(k)) =
          -lever[c] * columns[4 * (e.tip + c) + k + 1];
  }
}

void eliminate_with_fields(const DisplacementElements& e, const Eigen::Vector3d& load,
                           const double* y, double* scratch, TipResponse& response,
                           FieldResponse& field) {
  const std::size_t m = e.unknowns;
  double* solved = scratch + 4 * m;
  const double* coupling = scratch + 8 * m;
  double* work = scratch + 12 * m;
  std::copy_n(coupling, 4 * m, solved);
  eliminate_displacements(e, load, y, work, response);
  std::copy_n(work, 4 * m, scratch);
  double* band = work + 4 * m;
  int negative = 0;
  const std::size_t size = m * (e.width + 1);
  response.singular = !solve_symmetric(band, band_layout(m, e.width), band + size, band + 2 * size,
                                       solved, negative) ||
                      response.singular;
  const double lever[3] = {e.length, e.length, 1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    field.tip_by_turn[row] -= lever[c] * solved[4 * (e.tip + c)];
    field.tip_by_factor[row] -= lever[c] * solved[4 * (e.tip + c) + 1];
  }
  for (std::size_t i = 0; i < m; ++i) {
    const double by_turn = coupling[4 * i];
    field.by_turn -= by_turn * scratch[4 * i];
    field.turn_turn -= by_turn * solved[4 * i];
    field.turn_factor -= by_turn * solved[4 * i + 1];
  }
}

/// The moment of w (r - r(s)) summed is that of w r, less r(s) x N(s).
void add_dead_forces(const StationGrid& grid, const FlexureProperties& flexure,
                     const Surroundings& surroundings, const std::vector<Vec2>& nodes,
                     std::vector<SectionState>& states) {
  const auto turned = [&](Vec2 v) {
    return surroundings.load_factor * rotate(-surroundings.turn, v);
  };
  std::vector<double> moments;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    moments.push_back(cross(nodes[k], turned(flexure.load_at(grid.nodes[k].s))));
  const StationGrid::Integral<double> sums = grid.integrate(moments);
  for (std::size_t k = 0; k < states.size(); ++k) {
    SectionState& state = states[k];
    const Vec2 dead = turned(flexure.load_ahead(grid.s[k]));
    const Vec2 t = unit(grid.angles[k] + state.pose.rotation);
    state.axial_force += dot(dead, t);
    state.shear_force += dot(dead, perp(t));
    state.bending_moment +=
        sums.at_stations.back() - sums.at_stations[k] - cross(state.pose.position, dead);
  }
}

DeadLoad dead_load_on(const BeamMesh& mesh, const FlexureProperties& flexure) {
  DeadLoad dead;
  dead.nodal.assign(mesh.nodes() - 1, Vec2{});
  const Vec2 start = flexure.axis.position(0.0);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const std::size_t first = p / mesh.order * mesh.order;
    const double* shape = mesh.shape.data() + p % mesh.order * (mesh.order + 1);
    const Vec2 w = mesh.points[p].weight * flexure.load_at(mesh.points[p].s);
    const Vec2 drawn = flexure.axis.position(mesh.points[p].s) - start;
    dead.along += dot(w, drawn);
    dead.across += dot(perp(w), drawn);
    for (std::size_t a = first == 0 ? 1 : 0; a <= mesh.order; ++a)
      dead.nodal[first + a - 1] = dead.nodal[first + a - 1] + shape[a] * w;
  }
  return dead;
}

void DeadLoad::add(const Surroundings& surroundings, double length, const double* y,
                   double* columns, double* coupling, FieldResponse& field) const {
  const double share = surroundings.load_factor;
  double sum = along;
  double turned_sum = across;
  for (std::size_t k = 0; k < nodal.size(); ++k) {
    const Vec2 moved = length * Vec2{y[3 * k], y[3 * k + 1]};
    sum += dot(nodal[k], moved);
    turned_sum += dot(perp(nodal[k]), moved);
    const Vec2 now = length * rotate(-surroundings.turn, nodal[k]);
    const Vec2 spin = -1.0 * perp(now);  // by turn
    columns[12 * k] -= share * now.x;
    columns[12 * k + 4] -= share * now.y;
    coupling[12 * k] -= share * spin.x;
    coupling[12 * k + 4] -= share * spin.y;
    coupling[12 * k + 1] -= now.x;
    coupling[12 * k + 5] -= now.y;
  }
  const double c = std::cos(surroundings.turn);
  const double s = std::sin(surroundings.turn);
  const double work = c * sum - s * turned_sum;
  const double by_turn = -s * sum - c * turned_sum;
  field.by_factor -= work;
  field.by_turn -= share * by_turn;
  field.turn_turn += share * work;
  field.turn_factor -= by_turn;
}

}  // namespace flexura

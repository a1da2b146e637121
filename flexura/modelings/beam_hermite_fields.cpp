#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/beam_hermite.hpp"
#include "flexura/modelings/quintic_shape.hpp"

// Von Karman's and the linear elements under loads along them and changes of temperature.

namespace flexura {

/// At Gauss points.
auto HermiteBeamPort::dead_work(std::size_t element, const double* y, double turn) const
    -> DeadWork {
  const double arc = length_ / static_cast<double>(elements());
  const QuadratureRule& rule = gauss_legendre(gauss_points);
  const ElementJets jets = element_jets(element, y);
  DeadWork work;
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const double x = 0.5 * (1.0 + rule.nodes[q]);
    const Vec2 load = flexure_.load_at(arc * (static_cast<double>(element) + x));
    const Vec2 now = (0.5 * rule.weights[q] * arc) * rotate(-turn, load);
    const PlaceJets place = place_at(jets, x);
    work.now += now.x * place[0] + now.y * place[1];
    work.by_turn += now.y * place[0] - now.x * place[1];
  }
  return work;
}

/// The linear theory takes the work about the drawn state, and turns the loads as drawn.
void HermiteBeamPort::add_dead(std::size_t element, const double* y,
                               const Surroundings& surroundings, double* work, double* coupling,
                               FieldResponse& field) const {
  const double share = surroundings.load_factor;
  const auto at = places(element);
  DeadWork dead = dead_work(element, y, is_linear() ? 0.0 : surroundings.turn);
  if (is_linear()) {
    dead.by_turn = Unknowns(dead_work(element, rest_.data(), 0.0).by_turn.value);
    dead.now.value += surroundings.turn * dead.by_turn.value;
  }
  field.by_factor -= dead.now.value;
  field.by_turn -= share * dead.by_turn.value;
  if (!is_linear()) field.turn_turn += share * dead.now.value;
  field.turn_factor -= dead.by_turn.value;
  double* band = work + 4 * internal_size();
  const std::size_t stride = width() + 1;
  for (std::size_t i = 0; i < element_unknowns; ++i) {
    if (at[i] < 0) continue;
    const auto row = static_cast<std::size_t>(at[i]);
    work[4 * row] -= share * dead.now.gradient[i];
    coupling[4 * row] -= share * dead.by_turn.gradient[i];
    coupling[4 * row + 1] -= dead.now.gradient[i];
    for (std::size_t j = 0; j < element_unknowns; ++j)
      if (at[j] >= 0 && at[j] <= at[i])
        band[row * stride + width() - row + static_cast<std::size_t>(at[j])] -=
            share * dead.now.second(i, j);
  }
}

/// What heat does besides stretching the elements: it couples with the load factor.
void HermiteBeamPort::add_heat(std::size_t element, const double* y, double load_factor,
                               double* coupling, FieldResponse& field) const {
  const double strain = flexure_.field.strain;
  const auto at = places(element);
  Energy e =
      is_linear() ? energy(element, rest_.data(), 0.0) : energy(element, y, load_factor * strain);
  if (is_linear()) {
    const auto v = gather(element, y);
    e.heat = load_factor * strain * elements_[element].length / flexure_.axial_compliance;
    for (std::size_t i = 0; i < element_unknowns; ++i) e.heat += e.by_heat[i] * v[i];
  }
  field.by_factor += strain * e.heat;
  for (std::size_t i = 0; i < element_unknowns; ++i)
    if (at[i] >= 0) coupling[4 * static_cast<std::size_t>(at[i]) + 1] += strain * e.by_heat[i];
}

TipResponse HermiteBeamPort::linearize_in(const Surroundings& surroundings,
                                          const Eigen::Vector3d& load, const double* y,
                                          double* scratch, FieldResponse& field) const {
  const std::size_t m = internal_size();
  const double share = surroundings.load_factor;
  double* coupling = scratch + 8 * m;
  double* work = scratch + 12 * m;
  std::fill_n(scratch, 12 * m, 0.0);
  TipResponse response;
  response.strain_energy = assemble(y, work, share * flexure_.field.strain);
  field = {};
  if (flexure_.field.strain != 0.0)
    for (std::size_t e = 0; e < elements(); ++e) add_heat(e, y, share, coupling, field);
  response.strain_energy -= share * field.by_factor;
  for (std::size_t e = 0; e < elements(); ++e) add_dead(e, y, surroundings, work, coupling, field);
  eliminate_with_fields(assembled(), load, y, scratch, response, field);
  return response;
}

/// By the linear theory forces are in equilibrium on the flexure as drawn.
std::vector<SectionState> HermiteBeamPort::sections_in(const Surroundings& surroundings,
                                                       const Eigen::Vector3d& load,
                                                       std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.axis.breaks());
  const auto pose_at = [&](double s, Vec2 drawn) {
    const double place = s / length_ * settings_.elements;
    const std::size_t e = std::min(elements() - 1, static_cast<std::size_t>(place));
    return axis_pose(e, place - static_cast<double>(e), drawn, internal.data());
  };
  const std::size_t last = internal.size() - 4;
  const Vec2 tip = chord_ + length_ * Vec2{internal[last], internal[last + 1]};
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const Pose held{grid.positions[k], 0.0};
    states.push_back(is_linear()
                         ? section_at(grid, k, held, chord_, load)
                         : section_at(grid, k, pose_at(grid.s[k], held.position), tip, load));
  }
  if (feels_surroundings()) {
    std::vector<Vec2> nodes;
    for (const StationGrid::Node& node : grid.nodes)
      nodes.push_back(is_linear() ? node.position : pose_at(node.s, node.position).position);
    Surroundings acting = surroundings;
    if (is_linear()) acting.turn = 0.0;
    add_dead_forces(grid, flexure_, acting, nodes, states);
  }
  if (is_linear())
    for (std::size_t k = 0; k < states.size(); ++k)
      states[k].pose = pose_at(grid.s[k], grid.positions[k]);
  return states;
}

}  // namespace flexura

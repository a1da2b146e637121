#include "flexura/modelings/beam_hermite.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/core/symmetric_factor.hpp"
#include "flexura/energy/von_karman.hpp"
#include "flexura/modelings/quintic_shape.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {

HermiteBeamPort::HermiteBeamPort(const FlexureProperties& flexure, BeamSettings settings)
    : flexure_(flexure), settings_(settings), length_(flexure.axis.length()) {
  const AxisCurve& axis = flexure_.axis;
  const Vec2 origin = axis.position(0.0);
  chord_ = axis.position(length_) - origin;
  const double h = length_ / settings.elements;
  for (std::size_t e = 0; e < elements(); ++e) {
    const double ends[2] = {h * static_cast<double>(e), h * static_cast<double>(e + 1)};
    const Vec2 a = axis.position(ends[0]);
    const Vec2 b = axis.position(std::min(ends[1], length_));
    Element element;
    element.start = a - origin;
    element.length = norm(b - a);
    element.direction = (1.0 / element.length) * (b - a);
    element.tangent_angle = std::atan2(element.direction.y, element.direction.x);
    for (std::size_t i = 0; i < 2; ++i) {
      const double s = std::min(ends[i], length_);
      const Vec2 t = unit(axis.tangent_angle(s));
      const double slope = cross(element.direction, t) / dot(element.direction, t);
      element.slopes[i] = slope;
      const double curvature = axis.curvature(s);
      element.bends[i] = curvature * std::pow(1.0 + slope * slope, 1.5);
    }
    elements_.push_back(element);
  }
  rest_.assign(internal_size(), 0.0);
}

/// [curvature of node 0], then per element [shear strain], displacement, rotation and curvature of
/// its far node.
auto HermiteBeamPort::places(std::size_t element) const -> std::array<int, element_unknowns> {
  const int per = shears() ? 5 : 4;
  const int own = 1 + static_cast<int>(element) * per;  // the element's first
  const int node = own - 4;                             // of the near node
  const int far = own + (shears() ? 1 : 0);
  if (element == 0) return {-1, -1, -1, 0, far, far + 1, far + 2, far + 3, shears() ? own : -1};
  return {node, node + 1, node + 2, node + 3, far, far + 1, far + 2, far + 3, shears() ? own : -1};
}

auto HermiteBeamPort::gather(std::size_t element, const double* y) const
    -> std::array<double, element_unknowns> {
  std::array<double, element_unknowns> v{};
  const auto at = places(element);
  for (std::size_t i = 0; i < element_unknowns; ++i)
    if (at[i] >= 0) v[i] = y[at[i]];
  return v;
}

/// Displacements and curvatures are unknowns in units of the flexure's length.
auto HermiteBeamPort::deform(const Element& element,
                             const std::array<double, element_unknowns>& v) const -> Deformed {
  std::array<Unknowns, element_unknowns> u;
  for (std::size_t i = 0; i < element_unknowns; ++i) u[i] = Unknowns::variable(i, v[i]);
  const Vec2 d = element.direction;
  const Unknowns cx = length_ * (u[4] - u[0]) + element.length * d.x;
  const Unknowns cy = length_ * (u[5] - u[1]) + element.length * d.y;
  const Unknowns chord = sqrt(cx * cx + cy * cy);
  Deformed p;
  p[elongation] = chord - element.length;
  for (std::size_t i = 0; i < 2; ++i) {
    const double angle = element.tangent_angle + std::atan(element.slopes[i]);
    const Unknowns psi = u[i == 0 ? 2 : 6] + angle;
    const Unknowns tx = cos(psi), ty = sin(psi);
    const Unknowns slope = (cx * ty - cy * tx) / (cx * tx + cy * ty);
    p[i == 0 ? slope_a : slope_b] = slope;
    const double drawn =
        element.bends[i] / std::pow(1.0 + element.slopes[i] * element.slopes[i], 1.5);
    const Unknowns stretch = 1.0 + slope * slope;
    const Unknowns curvature = (1.0 / length_) * u[i == 0 ? 3 : 7] + drawn;
    p[i == 0 ? bend_a : bend_b] = curvature * (stretch * sqrt(stretch));
  }
  p[shear] = u[8];
  return p;
}

/// Gauss points give curvature energy and the mean axial strain, as functions of the deformations;
/// the chain rule makes them functions of the unknowns.
auto HermiteBeamPort::energy(std::size_t index, const double* y, double heat) const -> Energy {
  using Strains = Jet2<3>;  // w', w'', gamma
  const Element& element = elements_[index];
  const double l = element.length;
  const Deformed p = deform(element, gather(index, y));
  const QuadratureRule& rule = gauss_legendre(gauss_points);

  std::array<double, deformations> g{}, mean_g{};
  std::array<std::array<double, deformations>, deformations> h{}, mean_h{};
  double value = 0.0;
  double mean = p[elongation].value / l;
  mean_g[elongation] = 1.0 / l;
  const auto add = [](const Strains& f, const std::array<std::array<double, deformations>, 3>& by,
                      auto& gradient, auto& hessian) {
    for (std::size_t k = 0; k < deformations; ++k) {
      for (std::size_t v = 0; v < 3; ++v) gradient[k] += f.gradient[v] * by[v][k];
      for (std::size_t m = 0; m < deformations; ++m)
        for (std::size_t v = 0; v < 3; ++v)
          for (std::size_t w = 0; w < 3; ++w) hessian[k][m] += f.second(v, w) * by[v][k] * by[w][m];
    }
  };
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const QuinticShape n = quintic_shape(0.5 * (1.0 + rule.nodes[q]));
    const double weight = 0.5 * rule.weights[q];
    std::array<std::array<double, deformations>, 3> by{};
    by[0] = {0.0, n.slope[0], n.slope[1], l * n.slope[2], l * n.slope[3], n.slope[0] + n.slope[1]};
    by[1] = {0.0, n.bend[0] / l, n.bend[1] / l, n.bend[2], n.bend[3], (n.bend[0] + n.bend[1]) / l};
    by[2][shear] = 1.0;
    double at[3] = {0.0, 0.0, 0.0};
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t k = 0; k < deformations; ++k) at[v] += by[v][k] * p[k].value;
    const double slope0 = n.slope[0] * element.slopes[0] + n.slope[1] * element.slopes[1] +
                          l * (n.slope[2] * element.bends[0] + n.slope[3] * element.bends[1]);
    const double bend0 = (n.bend[0] * element.slopes[0] + n.bend[1] * element.slopes[1]) / l +
                         n.bend[2] * element.bends[0] + n.bend[3] * element.bends[1];
    const Strains dw = Strains::variable(0, at[0]);
    const Strains ddw = Strains::variable(1, at[1]);
    const Strains gamma = Strains::variable(2, at[2]);
    Strains strain = von_karman_axial_strain(Strains(0.0), dw) - 0.5 * slope0 * slope0;
    strain *= weight;
    mean += strain.value;
    add(strain, by, mean_g, mean_h);
    const Strains kappa = graph_curvature(dw - gamma, ddw) - graph_curvature(slope0, bend0);
    Strains bending = kappa * kappa;
    bending *= 0.5 * flexure_.bending_stiffness * weight * l * std::sqrt(1.0 + slope0 * slope0);
    value += bending.value;
    add(bending, by, g, h);
  }
  const double ea = l / flexure_.axial_compliance;
  mean -= heat;
  value += 0.5 * ea * mean * mean;
  const double ga = shears() ? l / flexure_.shear_compliance : 0.0;
  value += 0.5 * ga * p[shear].value * p[shear].value;
  g[shear] += ga * p[shear].value;
  h[shear][shear] += ga;

  Energy out;
  out.value = value;
  out.heat = -ea * mean;
  std::array<double, deformations> total = g;
  for (std::size_t k = 0; k < deformations; ++k) total[k] += ea * mean * mean_g[k];
  for (std::size_t k = 0; k < deformations; ++k) {
    for (std::size_t i = 0; i < element_unknowns; ++i) {
      out.gradient[i] += total[k] * p[k].gradient[i];
      out.by_heat[i] -= ea * mean_g[k] * p[k].gradient[i];
      for (std::size_t j = 0; j < element_unknowns; ++j)
        out.hessian[i][j] += total[k] * p[k].second(i, j);
    }
    for (std::size_t m = 0; m < deformations; ++m) {
      const double hkm = h[k][m] + ea * (mean_g[k] * mean_g[m] + mean * mean_h[k][m]);
      if (hkm == 0.0) continue;
      for (std::size_t i = 0; i < element_unknowns; ++i)
        for (std::size_t j = 0; j < element_unknowns; ++j)
          out.hessian[i][j] += hkm * p[k].gradient[i] * p[m].gradient[j];
    }
  }
  return out;
}

/// By the linear theory, residual and energy of the quadratic expansion about the drawn state.
void HermiteBeamPort::add_element(std::size_t element, const double* y, double heat,
                                  double* residual, double* band, double& energy_sum) const {
  Energy e = energy(element, is_linear() ? rest_.data() : y, is_linear() ? 0.0 : heat);
  const auto at = places(element);
  if (is_linear()) {
    const auto v = gather(element, y);
    e.value = 0.5 * heat * heat * elements_[element].length / flexure_.axial_compliance;
    for (std::size_t i = 0; i < element_unknowns; ++i) {
      double slope = 0.0;
      for (std::size_t j = 0; j < element_unknowns; ++j) slope += e.hessian[i][j] * v[j];
      e.value += (0.5 * slope + heat * e.by_heat[i]) * v[i];
      e.gradient[i] = slope + heat * e.by_heat[i];
    }
  }
  energy_sum += e.value;
  const std::size_t stride = width() + 1;
  for (std::size_t i = 0; i < element_unknowns; ++i) {
    if (at[i] < 0) continue;
    const auto row = static_cast<std::size_t>(at[i]);
    residual[4 * row] += e.gradient[i];
    for (std::size_t j = 0; j < element_unknowns; ++j) {
      if (at[j] < 0 || at[j] > at[i]) continue;
      const auto column = static_cast<std::size_t>(at[j]);
      band[row * stride + width() + column - row] += e.hessian[i][j];
    }
  }
}

double HermiteBeamPort::assemble(const double* y, double* columns, double* band,
                                 double heat) const {
  std::fill_n(columns, 4 * internal_size(), 0.0);
  std::fill_n(band, internal_size() * (width() + 1), 0.0);
  double energy = 0.0;
  for (std::size_t e = 0; e < elements(); ++e) add_element(e, y, heat, columns, band, energy);
  return energy;
}

TipResponse HermiteBeamPort::linearize(const Eigen::Vector3d& load, const double* y,
                                       double* scratch) const {
  TipResponse response;
  response.strain_energy = assemble(y, scratch);
  eliminate_displacements(assembled(), load, y, scratch, response);
  return response;
}

Eigen::MatrixXd HermiteBeamPort::hessian(const Eigen::Vector3d& /*load*/, const double* y) const {
  std::vector<double> scratch(scratch_size());
  assemble(y, scratch.data());
  return displacement_hessian(assembled(), scratch.data());
}

Pose HermiteBeamPort::section_pose(std::size_t index, double x, const double* y) const {
  const Element& element = elements_[index];
  const auto v = gather(index, y);
  const bool small = is_linear();
  Deformed p = deform(element, small ? std::array<double, element_unknowns>{} : v);
  if (small)  // to first order
    for (Unknowns& part : p)
      for (std::size_t i = 0; i < element_unknowns; ++i) part.value += part.gradient[i] * v[i];
  const QuinticShape n = quintic_shape(x);
  const double l = element.length;
  const auto graph = [&](double a, double b, double c, double d, const std::array<double, 4>& f,
                         double power) {
    return power * (a * f[0] + b * f[1]) + power * l * (c * f[2] + d * f[3]);
  };
  const double gamma = p[shear].value;
  const double w = graph(p[slope_a].value + gamma, p[slope_b].value + gamma, p[bend_a].value,
                         p[bend_b].value, n.value, l);
  const double slope = graph(p[slope_a].value + gamma, p[slope_b].value + gamma, p[bend_a].value,
                             p[bend_b].value, n.slope, 1.0);
  const double drawn =
      graph(element.slopes[0], element.slopes[1], element.bends[0], element.bends[1], n.slope, 1.0);
  const Vec2 a = element.start + length_ * Vec2{v[0], v[1]};
  const Vec2 b = element.start + l * element.direction + length_ * Vec2{v[4], v[5]};
  const Vec2 along = (1.0 / norm(b - a)) * (b - a);
  const double turn_sine = cross(element.direction, along);
  const double turn_cosine = dot(element.direction, along);
  double turn = std::atan2(turn_sine, turn_cosine) + std::atan(slope - gamma) - std::atan(drawn);
  // the node's rotation says how many turns
  const double near = v[2] + (v[6] - v[2]) * x;
  turn += 2.0 * M_PI * std::round((near - turn) / (2.0 * M_PI));
  return {a + x * (b - a) + w * perp(along), turn};
}

Pose HermiteBeamPort::axis_pose(std::size_t element, double x, Vec2 drawn, const double* y) const {
  const std::vector<double> rest(internal_size(), 0.0);
  Pose pose = section_pose(element, x, y);
  const Vec2 lack = drawn - section_pose(element, x, rest.data()).position;
  const bool small = is_linear();
  pose.position = pose.position + (small ? lack : rotate(pose.rotation, lack));
  return pose;
}

void HermiteBeamPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  BeamSettings finer = settings_;
  finer.elements *= 2;
  const HermiteBeamPort fine(flexure_, finer);
  for (std::size_t e = 0; e < elements(); ++e) {
    const auto v = gather(e, internal.data());
    const auto first = fine.places(2 * e);
    const auto second = fine.places(2 * e + 1);
    const Vec2 drawn = fine.elements_[2 * e + 1].start;
    const Pose middle = axis_pose(e, 0.5, drawn, internal.data());
    const Vec2 moved = middle.position - drawn;
    const double mid[4] = {moved.x / length_, moved.y / length_, middle.rotation,
                           0.5 * (v[3] + v[7])};
    if (e == 0) refined[0] = internal[0];
    for (std::size_t i = 0; i < 4; ++i) {
      refined[static_cast<std::size_t>(first[4 + i])] = mid[i];
      refined[static_cast<std::size_t>(second[4 + i])] = v[4 + i];
    }
    if (!shears()) continue;
    refined[static_cast<std::size_t>(first[8])] = v[8];
    refined[static_cast<std::size_t>(second[8])] = v[8];
  }
}

std::shared_ptr<const TwoPort> make_hermite_beam_port(const FlexureProperties& flexure,
                                                      const BeamSettings& settings) {
  return std::make_shared<HermiteBeamPort>(flexure, settings);
}

}  // namespace flexura

#include <algorithm>
#include <cmath>

#include "flexura/energy/von_karman.hpp"
#include "flexura/modelings/beam_hermite.hpp"
#include "flexura/modelings/quintic_shape.hpp"

// Where the axis and the sections of von Karman's and the linear elements are, and what they carry.

namespace flexura {

/// The value at v, no second derivatives: by the linear theory, of jets taken at the drawn state.
auto HermiteBeamPort::to_first_order(PlaceJets jets,
                                     const std::array<double, element_unknowns>& v) const
    -> PlaceJets {
  for (Unknowns& jet : jets) {
    for (std::size_t i = 0; i < element_unknowns; ++i) jet.value += jet.gradient[i] * v[i];
    jet.hessian.fill(0.0);
  }
  return jets;
}

auto HermiteBeamPort::element_jets(std::size_t index, const double* y) const -> ElementJets {
  const Element& element = elements_[index];
  const auto u = gather(index, is_linear() ? rest_.data() : y);
  ElementJets jets;
  jets.index = index;
  jets.at = gather(index, y);
  jets.deformed = deform(element, u);
  jets.x = length_ * Unknowns::variable(0, u[0]);
  jets.y = length_ * Unknowns::variable(1, u[1]);
  jets.along =
      length_ * Unknowns::variable(4, u[4]) - jets.x + element.length * element.direction.x;
  jets.beside =
      length_ * Unknowns::variable(5, u[5]) - jets.y + element.length * element.direction.y;
  jets.shortness = inverse(jets.deformed[elongation] + element.length);
  return jets;
}

/// What the element's own axis lacks to the true one, of sixth order in its length, keeps its
/// direction.
auto HermiteBeamPort::place_at(const ElementJets& jets, double x) const -> PlaceJets {
  const Element& element = elements_[jets.index];
  const double l = element.length;
  const Deformed& p = jets.deformed;
  const QuinticShape n = quintic_shape(x);
  const double ends = n.value[0] + n.value[1];
  const Unknowns w = (l * (n.value[0] * p[slope_a] + n.value[1] * p[slope_b] + ends * p[shear]) +
                      l * l * (n.value[2] * p[bend_a] + n.value[3] * p[bend_b])) *
                     jets.shortness;
  const double drawn_w = l * (n.value[0] * element.slopes[0] + n.value[1] * element.slopes[1]) +
                         l * l * (n.value[2] * element.bends[0] + n.value[3] * element.bends[1]);
  const double arc = length_ / static_cast<double>(elements());
  const Vec2 own = element.start + x * l * element.direction + drawn_w * perp(element.direction);
  const double s = std::min(length_, arc * (static_cast<double>(jets.index) + x));
  const Vec2 base = element.start + flexure_.axis.position(s) - flexure_.axis.position(0.0) - own;
  const PlaceJets place{jets.x + x * jets.along - w * jets.beside + base.x,
                        jets.y + x * jets.beside + w * jets.along + base.y};
  return is_linear() ? to_first_order(place, jets.at) : place;
}

auto HermiteBeamPort::direction_at(const ElementJets& jets, double x, bool along_axis) const
    -> PlaceJets {
  const double l = elements_[jets.index].length;
  const Deformed& p = jets.deformed;
  const QuinticShape n = quintic_shape(x);
  const double ends = n.slope[0] + n.slope[1] - (along_axis ? 0.0 : 1.0);
  const Unknowns slope = n.slope[0] * p[slope_a] + n.slope[1] * p[slope_b] + ends * p[shear] +
                         l * (n.slope[2] * p[bend_a] + n.slope[3] * p[bend_b]);
  const Unknowns size = jets.shortness * inverse(sqrt(1.0 + slope * slope));
  const PlaceJets direction{(jets.along - slope * jets.beside) * size,
                            (jets.beside + slope * jets.along) * size};
  return is_linear() ? to_first_order(direction, jets.at) : direction;
}

std::vector<double> HermiteBeamPort::weights() const {
  // a curvature over the flexure's length bends an element's share of it
  const double share = 1.0 / static_cast<double>(elements());
  std::vector<double> weights(internal_size(), 1.0);
  weights[0] = share * share;
  for (std::size_t e = 0; e < elements(); ++e)
    weights[static_cast<std::size_t>(places(e)[7])] = share * share;
  return weights;
}

Eigen::Vector3d HermiteBeamPort::add_tip_load(const Eigen::Vector3d& load, const double* y,
                                              double* columns) const {
  const std::size_t tip = internal_size() - 4;
  const double lever[3] = {length_, length_, 1.0};
  Eigen::Vector3d place(chord_.x, chord_.y, 0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    columns[4 * (tip + c)] -= lever[c] * load[static_cast<Eigen::Index>(c)];
    columns[4 * (tip + c) + c + 1] = -lever[c];
    place[static_cast<Eigen::Index>(c)] += lever[c] * y[tip + c];
  }
  return place;
}

/// What the unknowns make of an element; by the linear theory, to first order.
auto HermiteBeamPort::deformed_values(std::size_t index, const double* y) const -> Deformed {
  const auto v = gather(index, y);
  Deformed p = deform(elements_[index], is_linear() ? std::array<double, element_unknowns>{} : v);
  if (is_linear())
    for (Unknowns& part : p)
      for (std::size_t i = 0; i < element_unknowns; ++i) part.value += part.gradient[i] * v[i];
  return p;
}

auto HermiteBeamPort::graph_at(std::size_t index, double x, const Deformed& p) const -> Graph {
  const Element& element = elements_[index];
  const double l = element.length;
  const QuinticShape n = quintic_shape(x);
  const double gamma = p[shear].value;
  const auto slope = [&](double a, double b, double c, double d) {
    return n.slope[0] * a + n.slope[1] * b + l * (n.slope[2] * c + n.slope[3] * d);
  };
  const auto bend = [&](double a, double b, double c, double d) {
    return (n.bend[0] * a + n.bend[1] * b) / l + n.bend[2] * c + n.bend[3] * d;
  };
  const double a = p[slope_a].value + gamma, b = p[slope_b].value + gamma;
  const auto& s = element.slopes;
  const auto& k = element.bends;
  return {slope(a, b, p[bend_a].value, p[bend_b].value) - gamma,
          bend(a, b, p[bend_a].value, p[bend_b].value), slope(s[0], s[1], k[0], k[1]),
          bend(s[0], s[1], k[0], k[1])};
}

double HermiteBeamPort::axial_force(std::size_t index, const double* y) const {
  const double heat = flexure_.field.strain;
  const Energy e = energy(index, is_linear() ? rest_.data() : y, heat);
  double force = -e.heat;
  if (is_linear()) {
    const auto v = gather(index, y);
    for (std::size_t i = 0; i < element_unknowns; ++i) force -= e.by_heat[i] * v[i];
  }
  return force / elements_[index].length;
}

double HermiteBeamPort::bending_moment(std::size_t index, double x, const double* y) const {
  const Graph g = graph_at(index, x, deformed_values(index, y));
  const double ei = flexure_.bending_stiffness;
  if (!is_linear())
    return ei * (graph_curvature(g.slope, g.bend) - graph_curvature(g.drawn_slope, g.drawn_bend));
  const auto curvature =
      graph_curvature(Jet2<2>::variable(0, g.drawn_slope), Jet2<2>::variable(1, g.drawn_bend));
  return ei * (curvature.gradient[0] * (g.slope - g.drawn_slope) +
               curvature.gradient[1] * (g.bend - g.drawn_bend));
}

/// Shear from the shear strain or, without one, from the slope of the moment.
std::vector<SectionState> HermiteBeamPort::strained_sections(
    std::span<const double> internal) const {
  std::vector<SectionState> states = sections_in({}, Eigen::Vector3d::Zero(), internal);
  const double step = length_ / static_cast<double>(states.size() - 1);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double place = step * static_cast<double>(k) / length_ * static_cast<double>(elements());
    const std::size_t e = std::min(elements() - 1, static_cast<std::size_t>(place));
    states[k].axial_force = axial_force(e, internal.data());
    states[k].bending_moment = bending_moment(e, place - static_cast<double>(e), internal.data());
    if (shears()) states[k].shear_force = gather(e, internal.data())[8] / flexure_.shear_compliance;
  }
  if (shears()) return states;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const std::size_t before = k > 0 ? k - 1 : 0;
    const std::size_t after = std::min(k + 1, states.size() - 1);
    states[k].shear_force = (states[before].bending_moment - states[after].bending_moment) /
                            (step * static_cast<double>(after - before));
  }
  return states;
}

}  // namespace flexura

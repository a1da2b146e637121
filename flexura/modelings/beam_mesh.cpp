#include "flexura/modelings/beam_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/lagrange.hpp"
#include "flexura/core/quadrature.hpp"

namespace flexura {

BeamMesh::BeamMesh(const AxisCurve& axis, int element_count, int element_order)
    : elements(static_cast<std::size_t>(element_count)),
      order(static_cast<std::size_t>(element_order)),
      length(axis.length()),
      node_places_(gauss_lobatto(element_order + 1).nodes) {
  const QuadratureRule& rule = gauss_legendre(element_order);
  const double half = 0.5 * length / static_cast<double>(elements);
  for (const double x : rule.nodes) {
    const std::vector<double> values = shape_at(x);
    shape.insert(shape.end(), values.begin(), values.end());
    for (const double d : lagrange_slopes(node_places_, x)) slope.push_back(d / half);
  }
  points.reserve(elements * order);
  const auto place = [&](std::size_t e, std::size_t a) {
    const double s = 2.0 * half * (static_cast<double>(e) + node_place(a));
    return axis.position(std::min(s, length));
  };
  for (std::size_t e = 0; e < elements; ++e) {
    std::vector<Vec2> nodes_here;
    for (std::size_t a = 0; a <= order; ++a) nodes_here.push_back(place(e, a));
    for (std::size_t g = 0; g < order; ++g) {
      Vec2 tangent;
      for (std::size_t a = 0; a <= order; ++a)
        tangent = tangent + slope[g * (order + 1) + a] * nodes_here[a];
      points.push_back({half * rule.weights[g],
                        half * (2.0 * static_cast<double>(e) + 1.0 + rule.nodes[g]), tangent,
                        std::atan2(tangent.y, tangent.x), norm(tangent)});
    }
  }
}

std::vector<double> BeamMesh::shape_at(double x) const { return lagrange_values(node_places_, x); }

std::vector<double> BeamMesh::slope_at(double x) const {
  std::vector<double> slopes = lagrange_slopes(node_places_, x);
  for (double& d : slopes) d *= 2.0 * static_cast<double>(elements) / length;
  return slopes;
}

std::vector<double> BeamMesh::antiderivative() const {
  const QuadratureRule& rule = gauss_legendre(static_cast<int>(order));
  const double half = 0.5 * length / static_cast<double>(elements);
  std::vector<double> integrals;
  for (std::size_t a = 0; a <= order; ++a) {
    const double scale = 0.5 * (node_places_[a] + 1.0);
    for (std::size_t g = 0; g < order; ++g) {
      double integral = 0.0;
      for (std::size_t q = 0; q < order; ++q) {
        const double x = -1.0 + scale * (1.0 + rule.nodes[q]);
        double basis = rule.weights[q] * scale * half;
        for (std::size_t b = 0; b < order; ++b)
          if (b != g) basis *= (x - rule.nodes[b]) / (rule.nodes[g] - rule.nodes[b]);
        integral += basis;
      }
      integrals.push_back(integral);
    }
  }
  return integrals;
}

void BeamMesh::interpolate(double s, std::span<const double> nodal,
                           std::span<double> values) const {
  const double place = s / length * static_cast<double>(elements);
  const auto e = std::min(elements - 1, static_cast<std::size_t>(std::max(0.0, place)));
  const std::vector<double> n = shape_at(2.0 * (place - static_cast<double>(e)) - 1.0);
  const std::size_t components = values.size();
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t a = 0; a <= order; ++a)
    for (std::size_t c = 0; c < components; ++c)
      values[c] += n[a] * nodal[(e * order + a) * components + c];
}

}  // namespace flexura

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Equal elements along a flexure, `order` + 1 Gauss-Lobatto nodes each, `order` Gauss points each.
/// The axis is interpolated between its nodes as displacements are: only so does an element move
/// rigidly without strain.
struct BeamMesh {
  struct GaussPoint {
    double weight = 0.0;  ///< of ds
    double s = 0.0;
    Vec2 tangent;        ///< derivative by s of the axis as drawn, interpolated like displacements
    double angle = 0.0;  ///< of it
    double stretch = 0.0;  ///< its length
  };

  BeamMesh(const AxisCurve& axis, int element_count, int element_order);

  std::size_t elements = 0;
  std::size_t order = 0;
  double length = 0.0;
  std::vector<GaussPoint> points;  ///< element by element
  std::vector<double> shape;  ///< order x (order + 1): of node a at Gauss point g of an element
  std::vector<double> slope;  ///< the same, derivative by s

  std::size_t nodes() const { return elements * order + 1; }
  /// Where node a of an element is, as a fraction of the element.
  double node_place(std::size_t a) const { return 0.5 * (1.0 + node_places_[a]); }
  /// Values of the element's shape functions at x in [-1, 1].
  std::vector<double> shape_at(double x) const;
  /// Their derivatives by s there.
  std::vector<double> slope_at(double x) const;
  /// Interpolates nodal values (components per node, first node included) at arc length s.
  void interpolate(double s, std::span<const double> nodal, std::span<double> values) const;
  /// Values at the nodes of an element of the integral from its start of the polynomial with the
  /// given values at its Gauss points: (order + 1) x order.
  std::vector<double> antiderivative() const;

 private:
  std::vector<double> node_places_;  // in [-1, 1]
};

}  // namespace flexura

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/geometry/axis_curve.hpp"
#include "flexura/geometry/plane_elements.hpp"
#include "flexura/geometry/section.hpp"
#include "flexura/model/modeling_settings.hpp"

namespace flexura {

/// The outline of a flexure and its depth across the plane. A section that is given by its area and
/// second moment is the rectangle with the same.
struct StripShape {
  StripShape(AxisCurve curve, Section of_it);

  AxisCurve axis;
  Section section;

  double thickness(double s) const;
  double width(double s) const;
  /// Arc lengths between which axis and section are smooth.
  std::vector<double> breaks() const;
};

/// Lagrange polynomials through Gauss-Lobatto points in one direction of an element.
class LagrangeLine {
 public:
  explicit LagrangeLine(int order);
  std::size_t order() const { return places_.size() - 1; }
  double place(std::size_t node) const { return places_[node]; }
  std::vector<double> values(double x) const;
  std::vector<double> slopes(double x) const;

 private:
  std::vector<double> places_;  // -1 .. 1
};

/// Lagrange polynomials through the points of a Gauss rule, at x.
std::vector<double> through_gauss(std::size_t count, double x);

/// What elements of one kind need to know of each other's likes.
struct ElementTables {
  /// Quadrature points of an element, and of every node value and slopes there.
  using Point = ElementPoint;
  std::vector<Point> points;
  std::vector<double> values;  ///< [point][node]
  std::vector<double> by_xi;
  std::vector<double> by_eta;

  /// Of every quadrature point of every element: inverse of the Jacobian (entry (a, K): derivative
  /// of the a-th reference coordinate by the K-th place), and width times area.
  struct Map {
    std::array<double, 4> inverse;
    double volume = 0.0;

    double jacobian() const { return 1.0 / (inverse[0] * inverse[3] - inverse[1] * inverse[2]); }
  };
  std::vector<Map> maps;

  std::size_t nodes_per_element() const { return values.size() / points.size(); }
  /// Maps one more element, whose nodes are there; the depth is that at a quadrature point.
  template <class Place, class Depth>
  void map_element(const Place& place, const Depth& depth) {
    for (std::size_t g = 0; g < points.size(); ++g) {
      Vec2 xi, eta;
      const std::size_t per = nodes_per_element();
      for (std::size_t a = 0; a < per; ++a) {
        xi = xi + by_xi[g * per + a] * place(a);
        eta = eta + by_eta[g * per + a] * place(a);
      }
      const double area = cross(xi, eta);
      maps.push_back({{eta.y / area, -eta.x / area, -xi.y / area, xi.x / area},
                      area * points[g].weight * depth(points[g])});
    }
  }
};

/// A flexure's outline as quadrilaterals: `along` columns of elements from the base end to the
/// action end and `across` elements in each, of Gauss-Lobatto nodes. Node (column, row) is number
/// column * rows + row; columns ascend along the axis and rows along its normal. Places count from
/// the base end, axes as drawn.
struct StripMesh : ElementTables {
  std::size_t along = 0;
  std::size_t across = 0;
  LagrangeLine line{1};        ///< along
  LagrangeLine cross_line{1};  ///< across
  std::size_t columns = 0;     ///< of nodes
  std::size_t rows = 0;
  std::vector<double> stations;  ///< arc lengths between elements
  std::vector<Vec2> nodes;
  double length = 0.0;  ///< of the axis
  Vec2 chord;           ///< from base end to action end

  std::size_t node(std::size_t column, std::size_t row) const { return column * rows + row; }
  /// Node of an element, numbered column by column.
  std::size_t element_node(std::size_t ex, std::size_t ey, std::size_t a) const {
    const std::size_t per = cross_line.order() + 1;
    return node(ex * line.order() + a / per, ey * cross_line.order() + a % per);
  }
  std::size_t element(std::size_t ex, std::size_t ey) const { return ex * across + ey; }
  /// Arc length of a node column.
  double station(std::size_t column) const;
  /// Column of elements that an arc length lies in, and the reference coordinate there.
  std::size_t find(double s, double& xi) const;
};

/// Elements as the settings ask for them, evenly spaced between the breaks of the shape; where they
/// do not say, as many as the tolerance needs, with short ones at the ends, where faces held rigid
/// disturb a stretch about as long as the thickness.
StripMesh make_strip_mesh(const StripShape& shape, const ContinuumSettings& settings,
                          double tolerance);

}  // namespace flexura

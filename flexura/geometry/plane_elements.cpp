#include "flexura/geometry/plane_elements.hpp"

#include "flexura/core/quadrature.hpp"

namespace flexura {
namespace {

bool is_triangle(ElementKind kind) {
  return kind == ElementKind::triangle3 || kind == ElementKind::triangle6;
}

struct ShapeList {
  ShapeValues shape;
  void add(double value, double by_xi, double by_eta) {
    shape.values.push_back(value);
    shape.by_xi.push_back(by_xi);
    shape.by_eta.push_back(by_eta);
  }
};

ShapeValues triangle_values(ElementKind kind, Vec2 place) {
  const double area[3] = {1.0 - place.x - place.y, place.x, place.y};
  constexpr double by_xi[3] = {-1.0, 1.0, 0.0};
  constexpr double by_eta[3] = {-1.0, 0.0, 1.0};
  ShapeList list;
  const bool quadratic = kind == ElementKind::triangle6;
  for (std::size_t a = 0; a < 3; ++a) {
    const double slope = quadratic ? 4.0 * area[a] - 1.0 : 1.0;
    list.add(quadratic ? area[a] * (2.0 * area[a] - 1.0) : area[a], slope * by_xi[a],
             slope * by_eta[a]);
  }
  for (std::size_t a = 0; quadratic && a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    list.add(4.0 * area[a] * area[b], 4.0 * (by_xi[a] * area[b] + area[a] * by_xi[b]),
             4.0 * (by_eta[a] * area[b] + area[a] * by_eta[b]));
  }
  return list.shape;
}

/// Lagrange polynomials through -1, 1, and 0 if quadratic; at x, for the node at `node`.
struct LineValue {
  LineValue(bool quadratic, double node, double x) {
    if (!quadratic) {
      value = 0.5 * (1.0 + node * x);
      slope = 0.5 * node;
    } else if (node == 0.0) {
      value = 1.0 - x * x;
      slope = -2.0 * x;
    } else {
      value = 0.5 * x * (x + node);
      slope = x + 0.5 * node;
    }
  }
  double value;
  double slope;
};

/// The eight-node element of the serendipity family.
void add_serendipity(ShapeList& list, Vec2 node, Vec2 place) {
  const double x = place.x, y = place.y;
  if (node.x != 0.0 && node.y != 0.0) {
    const double u = 1.0 + node.x * x, v = 1.0 + node.y * y, w = node.x * x + node.y * y - 1.0;
    list.add(0.25 * u * v * w, 0.25 * node.x * v * (w + u), 0.25 * node.y * u * (w + v));
  } else if (node.x == 0.0) {
    const double v = 1.0 + node.y * y;
    list.add(0.5 * (1.0 - x * x) * v, -x * v, 0.5 * node.y * (1.0 - x * x));
  } else {
    const double u = 1.0 + node.x * x;
    list.add(0.5 * (1.0 - y * y) * u, 0.5 * node.x * (1.0 - y * y), -y * u);
  }
}

}  // namespace

std::size_t nodes_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::triangle3:
      return 3;
    case ElementKind::triangle6:
      return 6;
    case ElementKind::quad4:
      return 4;
    case ElementKind::quad8:
      return 8;
    case ElementKind::quad9:
      return 9;
  }
  return 0;
}

std::size_t corners_of(ElementKind kind) { return is_triangle(kind) ? 3 : 4; }

std::string name_of(ElementKind kind) {
  return std::to_string(nodes_of(kind)) + "-node " +
         (is_triangle(kind) ? "triangle" : "quadrilateral");
}

std::vector<Vec2> reference_nodes(ElementKind kind) {
  std::vector<Vec2> nodes =
      is_triangle(kind) ? std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}
                        : std::vector<Vec2>{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  const std::size_t corners = nodes.size();
  if (nodes_of(kind) > corners)
    for (std::size_t a = 0; a < corners; ++a)
      nodes.push_back(0.5 * (nodes[a] + nodes[(a + 1) % corners]));
  if (kind == ElementKind::quad9) nodes.push_back({});
  return nodes;
}

ShapeValues shape_values(ElementKind kind, Vec2 place) {
  if (is_triangle(kind)) return triangle_values(kind, place);
  ShapeList list;
  for (const Vec2 node : reference_nodes(kind)) {
    if (kind == ElementKind::quad8) {
      add_serendipity(list, node, place);
      continue;
    }
    const LineValue x(kind == ElementKind::quad9, node.x, place.x);
    const LineValue y(kind == ElementKind::quad9, node.y, place.y);
    list.add(x.value * y.value, x.slope * y.value, x.value * y.slope);
  }
  return list.shape;
}

std::vector<ElementPoint> quadrature_of(ElementKind kind) {
  constexpr double third = 1.0 / 3.0, sixth = 1.0 / 6.0;
  if (kind == ElementKind::triangle3) return {{third, third, 0.5}};
  if (kind == ElementKind::triangle6)
    return {{sixth, sixth, sixth}, {4.0 * sixth, sixth, sixth}, {sixth, 4.0 * sixth, sixth}};
  const QuadratureRule& rule = gauss_legendre(kind == ElementKind::quad4 ? 2 : 3);
  std::vector<ElementPoint> points;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j)
      points.push_back({rule.nodes[i], rule.nodes[j], rule.weights[i] * rule.weights[j]});
  return points;
}

std::vector<ElementPoint> mass_quadrature_of(ElementKind kind) {
  if (kind == ElementKind::triangle3) return quadrature_of(ElementKind::triangle6);
  if (kind != ElementKind::triangle6) return quadrature_of(kind);
  // of degree 4 (Dunavant, Int. J. Num. Meth. Eng. 21, 1985): two orbits of three points
  std::vector<ElementPoint> points;
  for (const double sign : {1.0, -1.0}) {
    const double root = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
    const double a = (8.0 - std::sqrt(10.0) + sign * root) / 18.0;
    const double weight = (620.0 + sign * std::sqrt(213125.0 - 53320.0 * std::sqrt(10.0))) / 7440.0;
    points.push_back({a, a, weight});
    points.push_back({1.0 - 2.0 * a, a, weight});
    points.push_back({a, 1.0 - 2.0 * a, weight});
  }
  return points;
}

}  // namespace flexura

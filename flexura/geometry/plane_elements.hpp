#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// Finite elements of a plane mesh. Nodes are numbered as mesh files do: the corners
/// counter-clockwise, then the middles of the sides from the first on, then the centre.
enum class ElementKind { triangle3, triangle6, quad4, quad8, quad9 };

std::size_t nodes_of(ElementKind kind);
std::size_t corners_of(ElementKind kind);
/// "4-node quadrilateral"
std::string name_of(ElementKind kind);

/// Where the nodes are in reference coordinates: triangles (0, 0), (1, 0), (0, 1), quadrilaterals
/// -1 to 1 both ways.
std::vector<Vec2> reference_nodes(ElementKind kind);

/// Shape functions of all nodes at a reference place, and their slopes.
struct ShapeValues {
  std::vector<double> values;
  std::vector<double> by_xi;
  std::vector<double> by_eta;
};
ShapeValues shape_values(ElementKind kind, Vec2 place);

/// Reference places and weights whose sum is the reference element's area.
struct ElementPoint {
  double xi = 0.0;
  double eta = 0.0;
  double weight = 0.0;
};
/// As many as integrate the stiffness of an undistorted element exactly.
std::vector<ElementPoint> quadrature_of(ElementKind kind);
/// As many as integrate its mass, the square of the shape functions, exactly.
std::vector<ElementPoint> mass_quadrature_of(ElementKind kind);

}  // namespace flexura

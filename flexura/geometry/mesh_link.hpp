#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/geometry/axis_curve.hpp"
#include "flexura/geometry/plane_elements.hpp"
#include "flexura/geometry/section.hpp"

namespace flexura {

/// Elements in the plane; places are global, as drawn.
struct PlaneMesh {
  struct Element {
    ElementKind kind = ElementKind::triangle3;
    std::size_t first = 0;  ///< of its nodes in `element_nodes`
    long label = 0;         ///< the number it has in its file
  };

  std::vector<Vec2> nodes;
  std::vector<Element> elements;
  std::vector<std::size_t> element_nodes;

  std::size_t node(const Element& element, std::size_t a) const {
    return element_nodes[element.first + a];
  }
  Vec2 place(const Element& element, std::size_t a) const { return nodes[node(element, a)]; }
  Vec2 middle(const Element& element) const;
  void add(ElementKind kind, const std::vector<std::size_t>& own, long label);
};

/// A flexure of any shape: a mesh, and the nodes of it that are fastened to its bodies.
struct MeshLink {
  PlaneMesh mesh;
  std::vector<std::size_t> base;
  std::vector<std::size_t> action;
  double depth = 0.0;  ///< across the plane
};

/// What is wrong with a mesh, in words that name an element and say where it is; nothing if a
/// flexure can be made of it: all nodes used, elements counter-clockwise and not folded, in one
/// piece, with two nodes or more at either end and none at both.
std::optional<std::string> find_mesh_fault(const MeshLink& link);

/// Numbers a mesh that is drawn clockwise throughout, from behind, the other way round.
void turn_clockwise_mesh(PlaneMesh& mesh);

/// From the centroid of the base nodes to that of the action nodes. Where the two fall together it
/// begins at the base node farthest from there: the axis only stands for the link.
LineAxis link_axis(const MeshLink& link);

double mesh_area(const PlaneMesh& mesh);

/// The rectangle along that axis of as much material.
Section link_section(const MeshLink& link);

/// The border of the mesh, through corners of elements: the longest closed line first, from any of
/// its nodes back to it, and the borders of holes, each by way of the shortest bridge and back.
std::vector<std::size_t> border_of(const PlaneMesh& mesh);

}  // namespace flexura

#pragma once

#include <Eigen/Sparse>
#include <cstddef>
#include <vector>

#include "flexura/geometry/mesh_link.hpp"
#include "flexura/modelings/continuum_mesh.hpp"

namespace flexura {

/// The elements of one kind in a link: their tables, and their nodes, one element after the other.
/// Four-node elements have theirs in the order of EnhancedStrains.
struct LinkBlock {
  ElementKind kind = ElementKind::triangle3;
  ElementTables tables;
  std::vector<std::size_t> nodes;
  std::size_t first_element = 0;  ///< of all elements of the link
  std::size_t first_point = 0;    ///< of all quadrature points

  std::size_t elements() const { return nodes.size() / tables.nodes_per_element(); }
};

/// Shape functions of elements of a kind at their quadrature points, nodes in the order of
/// LinkBlock.
ElementTables make_tables(ElementKind kind, std::vector<ElementPoint> points);
/// Where the nodes are in reference coordinates, in that order.
std::vector<Vec2> block_places(ElementKind kind);
/// Polynomials through the quadrature points of an element's stiffness, at a reference place.
std::vector<double> through_points(ElementKind kind, Vec2 place);

/// A link's mesh, its unknowns and the pattern of its tangent, all worked out before any load.
/// Places count from the base end. Unknowns: displacements of the nodes that are not attached, over
/// the length, then the pose of the action end (x and y over the length, rotation).
struct LinkMesh {
  explicit LinkMesh(const MeshLink& link) : LinkMesh(link, link_axis(link)) {}
  LinkMesh(const MeshLink& link, const LineAxis& axis);

  static constexpr std::size_t at_base = static_cast<std::size_t>(-1);
  static constexpr std::size_t at_action = static_cast<std::size_t>(-2);

  std::vector<Vec2> nodes;
  std::vector<std::size_t> unknown;  ///< first of a node, or at which end it is
  std::vector<LinkBlock> blocks;
  double depth = 0.0;  ///< across the plane
  double length = 0.0;
  Vec2 chord;            ///< from base end to action end
  std::size_t pose = 0;  ///< first unknown of the action end: the last three
  std::size_t elements = 0;
  std::size_t points = 0;
  std::size_t size() const { return pose + 3; }

  Eigen::SparseMatrix<double> pattern;  ///< lower triangle
  /// Where each element's lower triangle, row by row, goes in the values of `pattern`, one element
  /// after the other, by the unknowns of `element_unknowns`; `first_place` says where it begins.
  std::vector<std::size_t> first_place;
  std::vector<int> places;

  /// Unknowns of one element, the action end's pose behind those of its nodes.
  void element_unknowns(const LinkBlock& block, std::size_t element,
                        std::vector<std::size_t>& unknowns) const;
  /// Derivatives of the places of an element's nodes, x and y in turns, by the unknowns of
  /// `element_unknowns`, the pose's always behind them, where the action end has turned so far.
  Eigen::MatrixXd slopes(const LinkBlock& block, std::size_t element, double turn) const;
  /// Maps the elements of a block, whose shape functions the tables have.
  void map_elements(const LinkBlock& block, ElementTables& tables) const;

 private:
  void add_blocks(const PlaneMesh& mesh);
  void make_pattern();
};

/// A side of an element, material on its left.
struct LinkSide {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t from = 0;
  std::size_t middle = none;  ///< of quadratic elements
  std::size_t to = 0;
};
/// Where the mesh ends.
std::vector<LinkSide> border_sides(const LinkMesh& mesh);

}  // namespace flexura

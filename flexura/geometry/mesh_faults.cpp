#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "flexura/geometry/mesh_link.hpp"

namespace flexura {
namespace {

std::string describe(const PlaneMesh& mesh, const PlaneMesh::Element& element) {
  const Vec2 at = mesh.middle(element);
  return fmt::format("element {}, a {} at [{:.6g}, {:.6g}],", element.label, name_of(element.kind),
                     at.x, at.y);
}

std::optional<std::string> find_folded(const PlaneMesh& mesh, const PlaneMesh::Element& element) {
  std::vector<Vec2> places = reference_nodes(element.kind);
  places.resize(corners_of(element.kind));
  for (const ElementPoint& point : quadrature_of(element.kind))
    places.push_back({point.xi, point.eta});
  double size = 0.0;
  for (std::size_t a = 1; a < corners_of(element.kind); ++a)
    size = std::max(size, norm(mesh.place(element, a) - mesh.place(element, 0)));
  double least = INFINITY;
  double most = -INFINITY;
  for (const Vec2 place : places) {
    const ShapeValues shape = shape_values(element.kind, place);
    Vec2 by_xi, by_eta;
    for (std::size_t a = 0; a < shape.values.size(); ++a) {
      by_xi = by_xi + shape.by_xi[a] * mesh.place(element, a);
      by_eta = by_eta + shape.by_eta[a] * mesh.place(element, a);
    }
    least = std::min(least, cross(by_xi, by_eta));
    most = std::max(most, cross(by_xi, by_eta));
  }
  constexpr double flat = 1e-9;
  if (most < -flat * size * size)
    return fmt::format("{} is inverted: its nodes go round clockwise", describe(mesh, element));
  if (!(least > flat * size * size))
    return fmt::format("{} is folded or flat: its Jacobian is not positive everywhere",
                       describe(mesh, element));
  return {};
}

/// Nodes that elements join, each by the first of its piece.
class Pieces {
 public:
  explicit Pieces(const PlaneMesh& mesh) : first_(mesh.nodes.size()) {
    std::iota(first_.begin(), first_.end(), std::size_t{0});
    for (const PlaneMesh::Element& element : mesh.elements)
      for (std::size_t a = 1; a < nodes_of(element.kind); ++a) {
        const std::size_t i = of(mesh.node(element, 0)), j = of(mesh.node(element, a));
        first_[std::max(i, j)] = std::min(i, j);
      }
  }
  std::size_t of(std::size_t node) {
    while (first_[node] != node) node = first_[node] = first_[first_[node]];
    return node;
  }

 private:
  std::vector<std::size_t> first_;
};

std::optional<std::string> find_ends_fault(const MeshLink& link) {
  const PlaneMesh& mesh = link.mesh;
  const std::set<std::size_t> base(link.base.begin(), link.base.end());
  const std::set<std::size_t> action(link.action.begin(), link.action.end());
  for (const auto* nodes : {&base, &action}) {
    const char* name = nodes == &base ? "base" : "action";
    if (nodes->size() < 2)
      return fmt::format("the {} attachment has {}; it takes two or more to carry a moment", name,
                         nodes->empty() ? "no node of the elements" : "one node");
    if (*nodes->rbegin() >= mesh.nodes.size())
      return fmt::format("the {} attachment has no node number {}", name, *nodes->rbegin());
  }
  for (const std::size_t n : base)
    if (action.contains(n))
      return fmt::format(
          "both attachments have the node at [{:.6g}, {:.6g}]; a flexure lies "
          "between them",
          mesh.nodes[n].x, mesh.nodes[n].y);
  return {};
}

}  // namespace

std::optional<std::string> find_mesh_fault(const MeshLink& link) {
  const PlaneMesh& mesh = link.mesh;
  if (mesh.elements.empty()) return "there is no element";
  std::vector<bool> used(mesh.nodes.size(), false);
  for (const PlaneMesh::Element& element : mesh.elements)
    for (std::size_t a = 0; a < nodes_of(element.kind); ++a) {
      if (element.first + a >= mesh.element_nodes.size() ||
          mesh.node(element, a) >= mesh.nodes.size())
        return fmt::format("element {} has a node that is not there", element.label);
      used[mesh.node(element, a)] = true;
    }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (!used[n] || !std::isfinite(mesh.nodes[n].x) || !std::isfinite(mesh.nodes[n].y))
      return fmt::format("node {} is in no element, or nowhere", n);
  }
  if (auto fault = find_ends_fault(link)) return fault;
  for (const PlaneMesh::Element& element : mesh.elements)
    if (auto fault = find_folded(mesh, element)) return fault;
  Pieces pieces(mesh);
  const std::size_t piece = pieces.of(link.base.front());
  for (const PlaneMesh::Element& element : mesh.elements)
    if (pieces.of(mesh.node(element, 0)) != piece)
      return fmt::format(
          "the mesh is not in one piece: {} shares no nodes with those at the base "
          "attachment",
          describe(mesh, element));
  return {};
}

}  // namespace flexura

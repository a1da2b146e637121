#include "flexura/geometry/mesh_link.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace flexura {
namespace {

Vec2 centroid(const MeshLink& link, const std::vector<std::size_t>& nodes) {
  Vec2 sum;
  for (const std::size_t n : nodes) sum = sum + link.mesh.nodes[n];
  return (1.0 / static_cast<double>(std::max<std::size_t>(nodes.size(), 1))) * sum;
}

double area_of(const PlaneMesh& mesh, const PlaneMesh::Element& element) {
  double area = 0.0;
  for (const ElementPoint& point : quadrature_of(element.kind)) {
    const ShapeValues shape = shape_values(element.kind, {point.xi, point.eta});
    Vec2 by_xi, by_eta;
    for (std::size_t a = 0; a < shape.values.size(); ++a) {
      by_xi = by_xi + shape.by_xi[a] * mesh.place(element, a);
      by_eta = by_eta + shape.by_eta[a] * mesh.place(element, a);
    }
    area += point.weight * cross(by_xi, by_eta);
  }
  return area;
}

using Loop = std::vector<std::size_t>;

/// Lines along which a mesh ends, material on their left, each closed.
std::vector<Loop> border_loops(const PlaneMesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> sides;  // and how often
  for (const PlaneMesh::Element& element : mesh.elements) {
    const std::size_t corners = corners_of(element.kind);
    for (std::size_t a = 0; a < corners; ++a)
      ++sides[{mesh.node(element, a), mesh.node(element, (a + 1) % corners)}];
  }
  std::multimap<std::size_t, std::size_t> next;
  for (const auto& [side, count] : sides)
    if (!sides.contains({side.second, side.first})) next.insert(side);
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop{next.begin()->first};
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
      if (loop.back() == loop.front()) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

Vec2 PlaneMesh::middle(const Element& element) const {
  Vec2 sum;
  const std::size_t corners = corners_of(element.kind);
  for (std::size_t a = 0; a < corners; ++a) sum = sum + place(element, a);
  return (1.0 / static_cast<double>(corners)) * sum;
}

void PlaneMesh::add(ElementKind kind, const std::vector<std::size_t>& own, long label) {
  elements.push_back({kind, element_nodes.size(), label});
  element_nodes.insert(element_nodes.end(), own.begin(), own.end());
}

void turn_clockwise_mesh(PlaneMesh& mesh) {
  const auto is_clockwise = [&](const PlaneMesh::Element& e) { return area_of(mesh, e) < 0.0; };
  if (!std::all_of(mesh.elements.begin(), mesh.elements.end(), is_clockwise)) return;
  for (const PlaneMesh::Element& element : mesh.elements) {
    const auto first = mesh.element_nodes.begin() + static_cast<std::ptrdiff_t>(element.first);
    const auto corners = static_cast<std::ptrdiff_t>(corners_of(element.kind));
    std::reverse(first + 1, first + corners);
    if (nodes_of(element.kind) > corners_of(element.kind))
      std::reverse(first + corners, first + 2 * corners);
  }
}

LineAxis link_axis(const MeshLink& link) {
  constexpr double apart = 1e-3;  // of the size of the link
  LineAxis axis{centroid(link, link.base), centroid(link, link.action)};
  double farthest = 0.0;
  Vec2 place = axis.start;
  for (const std::size_t n : link.base) {
    const double distance = norm(link.mesh.nodes[n] - axis.end);
    if (distance > farthest) {
      farthest = distance;
      place = link.mesh.nodes[n];
    }
  }
  if (norm(axis.end - axis.start) < apart * farthest) axis.start = place;
  return axis;
}

double mesh_area(const PlaneMesh& mesh) {
  double area = 0.0;
  for (const PlaneMesh::Element& element : mesh.elements) area += area_of(mesh, element);
  return area;
}

Section link_section(const MeshLink& link) {
  const LineAxis axis = link_axis(link);
  RectangleSection section;
  section.thickness = mesh_area(link.mesh) / norm(axis.end - axis.start);
  section.width = link.depth;
  return section;
}

std::vector<std::size_t> border_of(const PlaneMesh& mesh) {
  std::vector<Loop> loops = border_loops(mesh);
  if (loops.empty()) return {};
  const auto length = [&](const Loop& loop) {
    double sum = 0.0;
    for (std::size_t k = 1; k < loop.size(); ++k)
      sum += norm(mesh.nodes[loop[k]] - mesh.nodes[loop[k - 1]]);
    return sum;
  };
  std::sort(loops.begin(), loops.end(),
            [&](const Loop& a, const Loop& b) { return length(a) > length(b); });
  Loop border = loops.front();
  for (std::size_t l = 1; l < loops.size(); ++l) {
    Loop& hole = loops[l];
    hole.pop_back();
    std::size_t from = 0, to = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < border.size(); ++i)
      for (std::size_t j = 0; j < hole.size(); ++j) {
        const double distance = norm(mesh.nodes[border[i]] - mesh.nodes[hole[j]]);
        if (distance >= nearest) continue;
        nearest = distance;
        from = i;
        to = j;
      }
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(to), hole.end());
    hole.push_back(hole.front());
    hole.push_back(border[from]);
    border.insert(border.begin() + static_cast<std::ptrdiff_t>(from) + 1, hole.begin(), hole.end());
  }
  return border;
}

}  // namespace flexura

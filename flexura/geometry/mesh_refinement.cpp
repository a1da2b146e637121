#include "flexura/geometry/mesh_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace flexura {
namespace {

/// Makes nodes where they are asked for, those on a side once for either element.
class Refiner {
 public:
  explicit Refiner(const MeshLink& link)
      : coarse_(link), index_(link.mesh.nodes.size(), none), border_(find_border(link.mesh)) {
    fine_.link.depth = link.depth;
  }

  MeshRefinement run();

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// Two corners and quarters of the way between them; or an element and quarters both ways.
  using Key = std::array<long, 4>;
  using Side = std::pair<std::size_t, std::size_t>;
  using Attached = std::set<std::size_t>;

  static std::set<Side> find_border(const PlaneMesh& mesh);
  std::size_t node(std::size_t element, Vec2 place);
  std::size_t add(std::size_t element, Vec2 place);
  void attach(const std::vector<std::size_t>& from, std::vector<std::size_t>& to) const;

  const MeshLink& coarse_;
  std::vector<std::size_t> index_;  // of the coarse nodes among the fine ones
  std::set<Side> border_;
  std::map<Key, std::size_t> made_;
  MeshRefinement fine_;
};

std::set<Refiner::Side> Refiner::find_border(const PlaneMesh& mesh) {
  std::set<Side> sides;
  for (const PlaneMesh::Element& element : mesh.elements) {
    const std::size_t corners = corners_of(element.kind);
    for (std::size_t a = 0; a < corners; ++a) {
      const Side side{mesh.node(element, a), mesh.node(element, (a + 1) % corners)};
      if (sides.erase({side.second, side.first}) == 0) sides.insert(side);
    }
  }
  return sides;
}

std::size_t Refiner::add(std::size_t element, Vec2 place) {
  const PlaneMesh& mesh = coarse_.mesh;
  const PlaneMesh::Element& own = mesh.elements[element];
  const ShapeValues shape = shape_values(own.kind, place);
  Vec2 sum;
  for (std::size_t a = 0; a < shape.values.size(); ++a)
    sum = sum + shape.values[a] * mesh.place(own, a);
  fine_.link.mesh.nodes.push_back(sum);
  fine_.origins.push_back({element, place});
  return fine_.link.mesh.nodes.size() - 1;
}

/// Reference coordinates are multiples of a quarter here, so comparisons are exact.
std::size_t Refiner::node(std::size_t element, Vec2 place) {
  const PlaneMesh& mesh = coarse_.mesh;
  const PlaneMesh::Element& own = mesh.elements[element];
  const std::vector<Vec2> nodes = reference_nodes(own.kind);
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    if (!(nodes[a] == place)) continue;
    std::size_t& index = index_[mesh.node(own, a)];
    if (index == none) {
      index = add(element, place);
      fine_.link.mesh.nodes[index] = mesh.nodes[mesh.node(own, a)];
    }
    return index;
  }
  Key key{-1, static_cast<long>(element), std::lround(8.0 * place.x), std::lround(8.0 * place.y)};
  const std::size_t corners = corners_of(own.kind);
  for (std::size_t a = 0; a < corners; ++a) {
    const Vec2 from = nodes[a], along = nodes[(a + 1) % corners] - from;
    if (cross(along, place - from) != 0.0) continue;
    const long quarters = std::lround(8.0 * dot(along, place - from) / dot(along, along));
    const auto i = static_cast<long>(mesh.node(own, a));
    const auto j = static_cast<long>(mesh.node(own, (a + 1) % corners));
    key = i < j ? Key{i, j, quarters, 0} : Key{j, i, 8 - quarters, 0};
  }
  const auto [at, is_new] = made_.try_emplace(key, none);
  if (is_new) at->second = add(element, place);
  return at->second;
}

/// Nodes that are attached, those on sides of the border whose nodes all are, and those of elements
/// whose nodes all are.
void Refiner::attach(const std::vector<std::size_t>& from, std::vector<std::size_t>& to) const {
  const Attached held(from.begin(), from.end());
  const PlaneMesh& mesh = coarse_.mesh;
  for (std::size_t n = 0; n < fine_.origins.size(); ++n) {
    const auto& [index, place] = fine_.origins[n];
    const PlaneMesh::Element& own = mesh.elements[index];
    const std::vector<Vec2> nodes = reference_nodes(own.kind);
    const std::size_t corners = corners_of(own.kind);
    const auto is_held = [&](std::size_t a) { return held.contains(mesh.node(own, a)); };
    bool all = true, at_node = false, on_side = false;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      all = all && is_held(a);
      at_node = at_node || (nodes[a] == place && is_held(a));
    }
    for (std::size_t a = 0; a < corners; ++a) {
      const std::size_t next = (a + 1) % corners;
      const bool whole =
          is_held(a) && is_held(next) && (nodes.size() == corners || is_held(corners + a));
      on_side = on_side || (whole && cross(nodes[next] - nodes[a], place - nodes[a]) == 0.0 &&
                            border_.contains({mesh.node(own, a), mesh.node(own, next)}));
    }
    if (all || at_node || on_side) to.push_back(n);
  }
}

MeshRefinement Refiner::run() {
  const PlaneMesh& mesh = coarse_.mesh;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementKind kind = mesh.elements[e].kind;
    for (std::size_t part = 0; part < 4; ++part) {
      std::vector<std::size_t> own;
      for (const Vec2 place : reference_nodes(kind))
        own.push_back(node(e, place_of_part(kind, part, place)));
      fine_.link.mesh.add(kind, own, mesh.elements[e].label);
    }
  }
  attach(coarse_.base, fine_.link.base);
  attach(coarse_.action, fine_.link.action);
  return std::move(fine_);
}

}  // namespace

Vec2 place_of_part(ElementKind kind, std::size_t part, Vec2 place) {
  if (part >= corners_of(kind)) return Vec2{0.5, 0.5} - 0.5 * place;
  return 0.5 * (place + reference_nodes(kind)[part]);
}

MeshRefinement refine_mesh(const MeshLink& link) { return Refiner(link).run(); }

}  // namespace flexura

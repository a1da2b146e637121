#include "flexura/geometry/outline_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "flexura/geometry/outline_triangles.hpp"

namespace flexura {
namespace {

using Side = std::pair<std::size_t, std::size_t>;
using Corners = std::vector<std::size_t>;

Side either_way(std::size_t a, std::size_t b) { return std::minmax(a, b); }

/// How far from right angles a quadrilateral's corners are: 1 where there are four of them, 0 or
/// less where one is flat or turned in.
double squareness(const std::vector<Vec2>& places, const Corners& corners) {
  double worst = 1.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 ahead = places[corners[(k + 1) % 4]] - places[corners[k]];
    const Vec2 behind = places[corners[(k + 3) % 4]] - places[corners[k]];
    const double sine = cross(ahead, behind) / (norm(ahead) * norm(behind));
    worst = std::min(worst, sine);
  }
  return worst;
}

/// Pairs of neighbouring triangles as quadrilaterals, the squarest first, and the triangles left.
std::vector<Corners> pair_triangles(const OutlineTriangles& from) {
  constexpr double least = 0.5;
  std::map<Side, std::pair<std::size_t, std::size_t>> left;  // of a side: triangle, corner across
  for (std::size_t t = 0; t < from.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      left[{from.triangles[t][i], from.triangles[t][(i + 1) % 3]}] = {
          t, from.triangles[t][(i + 2) % 3]};
  struct Pair {
    double squareness;
    std::size_t one, other;
    Corners corners;
  };
  std::vector<Pair> pairs;
  for (const auto& [side, at] : left) {
    const auto other = left.find({side.second, side.first});
    if (other == left.end() || side.first > side.second) continue;
    const Corners corners{side.first, other->second.second, side.second, at.second};
    const double value = squareness(from.places, corners);
    if (value > least) pairs.push_back({value, at.first, other->second.first, corners});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.squareness > b.squareness; });
  std::vector<bool> taken(from.triangles.size(), false);
  std::vector<Corners> faces;
  for (const Pair& pair : pairs) {
    if (taken[pair.one] || taken[pair.other]) continue;
    taken[pair.one] = taken[pair.other] = true;
    faces.push_back(pair.corners);
  }
  for (std::size_t t = 0; t < from.triangles.size(); ++t)
    if (!taken[t]) faces.push_back({from.triangles[t].begin(), from.triangles[t].end()});
  return faces;
}

/// Nodes, those in the middle of sides among them, once for either side's faces; on the border they
/// lie on the true side.
class Nodes {
 public:
  Nodes(std::vector<Vec2> places, const std::vector<OutlinePart>& border)
      : places_(std::move(places)) {
    for (const OutlinePart& part : border) border_[either_way(part.from, part.to)] = part;
  }

  std::size_t add(Vec2 place) {
    places_.push_back(place);
    return places_.size() - 1;
  }
  std::size_t middle(std::size_t a, std::size_t b) {
    const auto [at, is_new] = middles_.try_emplace(either_way(a, b), places_.size());
    if (!is_new) return at->second;
    const std::size_t made = at->second;
    const auto found = border_.find(either_way(a, b));
    if (found == border_.end()) return add(0.5 * (places_[a] + places_[b]));
    const OutlinePart part = found->second;
    const double share = 0.5 * (part.from_share + part.to_share);
    add(part.side->at(share));
    border_[either_way(part.from, made)] = {part.from, made, part.side, part.from_share, share};
    border_[either_way(made, part.to)] = {made, part.to, part.side, share, part.to_share};
    for (const std::size_t n : {part.from, made, part.to}) named_[part.side->name].insert(n);
    return made;
  }
  const std::vector<Vec2>& places() const { return places_; }
  const std::map<std::string, std::set<std::size_t>>& named() const { return named_; }
  bool is_on_border(std::size_t a, std::size_t b) const {
    return border_.contains(either_way(a, b));
  }
  void move(std::size_t node, Vec2 place) { places_[node] = place; }

 private:
  std::vector<Vec2> places_;
  std::map<Side, std::size_t> middles_;
  std::map<Side, OutlinePart> border_;
  std::map<std::string, std::set<std::size_t>> named_;
};

/// Every face into as many quadrilaterals as it has corners, from there to the middle.
std::vector<Corners> quarter(const std::vector<Corners>& faces, Nodes& nodes) {
  std::vector<Corners> quads;
  for (const Corners& face : faces) {
    const std::size_t n = face.size();
    Corners middles;
    for (std::size_t k = 0; k < n; ++k) middles.push_back(nodes.middle(face[k], face[(k + 1) % n]));
    Vec2 sum;
    for (const std::size_t m : middles) sum = sum + nodes.places()[m];
    const std::size_t centre = nodes.add((1.0 / static_cast<double>(n)) * sum);
    for (std::size_t k = 0; k < n; ++k)
      quads.push_back({face[k], middles[k], centre, middles[(k + n - 1) % n]});
  }
  return quads;
}

/// Nodes inside move to the middle of their neighbours where the worst corner about them gains.
void smooth(const std::vector<Corners>& quads, Nodes& nodes) {
  constexpr int rounds = 4;
  std::vector<std::vector<std::size_t>> around(nodes.places().size());
  std::vector<bool> fixed(around.size(), false);
  for (std::size_t q = 0; q < quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = quads[q][k], b = quads[q][(k + 1) % 4];
      around[a].push_back(q);
      if (nodes.is_on_border(a, b)) fixed[a] = fixed[b] = true;
    }
  const auto worst = [&](std::size_t v) {
    double least = 1.0;
    for (const std::size_t q : around[v])
      least = std::min(least, squareness(nodes.places(), quads[q]));
    return least;
  };
  for (int round = 0; round < rounds; ++round)
    for (std::size_t v = 0; v < around.size(); ++v) {
      if (fixed[v] || around[v].empty()) continue;
      const Vec2 old = nodes.places()[v];
      const double before = worst(v);
      Vec2 sum;
      for (const std::size_t q : around[v])
        for (std::size_t k = 0; k < 4; ++k)
          if (quads[q][k] == v)
            sum =
                sum + nodes.places()[quads[q][(k + 1) % 4]] + nodes.places()[quads[q][(k + 3) % 4]];
      nodes.move(v, (0.5 / static_cast<double>(around[v].size())) * sum);
      if (worst(v) < before) nodes.move(v, old);
    }
}

}  // namespace

double expected_elements(const Outline& outline, double size) {
  double twice = 0.0;
  for (const OutlineLoop& loop : outline.loops)
    for (const OutlineSide& side : loop) {
      // a side's triangle with the origin, and the arc's segment
      const double radius = side.sweep == 0.0 ? 0.0 : side.radius();
      twice += cross(side.from, side.to) + radius * radius * (side.sweep - std::sin(side.sweep));
    }
  return 0.5 * twice / (size * size);
}

OutlineMesh mesh_outline(const Outline& outline, double size, int order) {
  OutlineMesh made;
  // halved once more by the quadrilaterals; those of eight nodes follow an arc
  const double most_turn = std::numbers::pi / (order > 1 ? 4.0 : 6.0);
  const auto triangles = triangulate_outline(outline, 2.0 * size, most_turn);
  if (!triangles) return made;
  Nodes nodes(triangles->places, triangles->border);
  const std::vector<Corners> quads = quarter(pair_triangles(*triangles), nodes);
  smooth(quads, nodes);
  long label = 0;
  for (Corners quad : quads) {
    for (std::size_t k = 0; order > 1 && k < 4; ++k)
      quad.push_back(nodes.middle(quad[k], quad[(k + 1) % 4]));
    made.mesh.add(order > 1 ? ElementKind::quad8 : ElementKind::quad4, quad, ++label);
  }
  made.mesh.nodes = nodes.places();
  for (const auto& [name, own] : nodes.named())
    if (!name.empty()) made.named[name] = {own.begin(), own.end()};
  return made;
}

}  // namespace flexura

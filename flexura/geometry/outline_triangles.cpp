#include "flexura/geometry/outline_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace flexura {
namespace {

constexpr std::size_t none = Delaunay::none;

class Refinement {
 public:
  Refinement(const Outline& outline, double size, double most_turn);
  bool run();
  OutlineTriangles take();

 private:
  struct Box {
    Vec2 low, high;
  };
  static Box box_of(const Outline& outline);
  void divide(const OutlineSide& side, std::size_t first, std::size_t last);
  double size_at(Vec2 place) const;
  Vec2 middle_of(const OutlinePart& part) const {
    return part.side->at(0.5 * (part.from_share + part.to_share));
  }
  double length_of(const OutlinePart& part) const {
    return norm(places()[part.to] - places()[part.from]);
  }
  bool holds(const OutlinePart& part, Vec2 place) const {
    return dot(places()[part.from] - place, places()[part.to] - place) <
           -1e-9 * std::pow(length_of(part), 2);
  }
  bool is_crowded(const OutlinePart& part) const;
  bool split(std::size_t part);
  bool split_crowded();
  std::vector<std::size_t> inside() const;
  double badness(std::size_t triangle) const;
  bool improve(std::size_t triangle);
  void smooth();
  const std::vector<Vec2>& places() const { return delaunay_.places(); }

  double size_;
  double most_turn_;
  Delaunay delaunay_;
  std::vector<OutlinePart> parts_;
  std::vector<std::pair<Vec2, double>> curved_;  // places on arcs, and the size there
  std::size_t most_ = 0;                         // vertices
};

Refinement::Box Refinement::box_of(const Outline& outline) {
  Box box{outline.loops[0][0].from, outline.loops[0][0].from};
  for (const OutlineSide& side : outline.loops[0])
    for (int k = 0; k < 32; ++k) {
      const Vec2 p = side.at(k / 32.0);
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  return box;
}

Refinement::Refinement(const Outline& outline, double size, double most_turn)
    : size_(size), most_turn_(most_turn), delaunay_(box_of(outline).low, box_of(outline).high) {
  const Box box = box_of(outline);
  const Vec2 extent = box.high - box.low;
  most_ = 20000 + static_cast<std::size_t>(8.0 * extent.x * extent.y / (size * size));
  for (const OutlineLoop& loop : outline.loops) {
    std::vector<std::size_t> corners;
    for (const OutlineSide& side : loop) corners.push_back(delaunay_.insert(side.from));
    for (std::size_t k = 0; k < loop.size(); ++k)
      divide(loop[k], corners[k], corners[(k + 1) % loop.size()]);
  }
}

void Refinement::divide(const OutlineSide& side, std::size_t first, std::size_t last) {
  const double by_size = std::ceil(side.length() / size_ - 1e-9);
  const double by_turn = std::ceil(std::abs(side.sweep) / most_turn_ - 1e-9);
  const auto count = static_cast<std::size_t>(std::max({1.0, by_size, by_turn}));
  std::size_t before = first;
  for (std::size_t k = 1; k <= count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count);
    const std::size_t vertex = k == count ? last : delaunay_.insert(side.at(share));
    const double start = static_cast<double>(k - 1) / static_cast<double>(count);
    parts_.push_back({before, vertex, &side, start, share});
    before = vertex;
    const double own = side.length() / static_cast<double>(count);
    if (side.sweep != 0.0 && own < size_) curved_.push_back({side.at(share), own});
  }
}

double Refinement::size_at(Vec2 place) const {
  constexpr double growth = 0.5;
  double size = size_;
  for (const auto& [at, own] : curved_) size = std::min(size, own + growth * norm(place - at));
  return size;
}

/// Whether a part of the border is no side of the triangles, or has the vertex across in its
/// circle.
bool Refinement::is_crowded(const OutlinePart& part) const {
  const std::size_t triangle = delaunay_.left_of(part.from, part.to);
  if (triangle == none) return true;
  for (const std::size_t v : delaunay_.triangles()[triangle].vertices)
    if (v != part.from && v != part.to && holds(part, places()[v])) return true;
  return false;
}

bool Refinement::split(std::size_t index) {
  constexpr double least = 1e-4;
  OutlinePart& part = parts_[index];
  if (length_of(part) < least * size_) return false;
  const double share = 0.5 * (part.from_share + part.to_share);
  const std::size_t vertex = delaunay_.insert(middle_of(part));
  const OutlinePart second{vertex, part.to, part.side, share, part.to_share};
  part.to = vertex;
  part.to_share = share;
  parts_.push_back(second);
  return true;
}

/// False where one is left that is too short to split.
bool Refinement::split_crowded() {
  for (bool found = true; found;) {
    found = false;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (!is_crowded(parts_[k])) continue;
      if (!split(k)) return delaunay_.left_of(parts_[k].from, parts_[k].to) != none;
      if (places().size() > most_) return false;
      found = true;
    }
  }
  return true;
}

/// Triangles on the left of the border, and what is joined to them on this side of it.
std::vector<std::size_t> Refinement::inside() const {
  std::set<std::pair<std::size_t, std::size_t>> border;
  std::vector<std::size_t> found;
  std::vector<bool> seen(delaunay_.triangles().size(), false);
  const auto add = [&](std::size_t t) {
    if (t == none || seen[t]) return;
    seen[t] = true;
    found.push_back(t);
  };
  for (const OutlinePart& part : parts_) {
    border.insert({part.from, part.to});
    add(delaunay_.left_of(part.from, part.to));
  }
  std::size_t next = 0;
  while (next < found.size()) {  // which grows meanwhile
    const Delaunay::Triangle& triangle = delaunay_.triangles()[found[next++]];
    for (std::size_t i = 0; i < 3; ++i)
      if (!border.contains({triangle.vertices[i], triangle.vertices[(i + 1) % 3]}))
        add(triangle.across[i]);
  }
  return found;
}

/// Above 1 for a triangle that is too large, or narrower than 24 degrees at a corner.
double Refinement::badness(std::size_t t) const {
  constexpr double widest = 1.25;  // circle's radius by the shortest side
  const Vec2 a = delaunay_.place(t, 0), b = delaunay_.place(t, 1), c = delaunay_.place(t, 2);
  const double sides[3] = {norm(b - a), norm(c - b), norm(a - c)};
  const double shortest = *std::min_element(sides, sides + 3);
  const double radius = sides[0] * sides[1] * sides[2] / (2.0 * turn_of(a, b, c));
  // a triangle of equal sides of that size has the radius size / sqrt(3)
  const double large = radius / (0.8 * size_at((1.0 / 3.0) * (a + b + c)));
  const double narrow = shortest < 1e-3 * size_ ? 0.0 : radius / (widest * shortest);
  return std::max(large, narrow);
}

bool Refinement::improve(std::size_t triangle) {
  const Vec2 centre = delaunay_.circumcentre_of(triangle);
  bool held = false;
  for (std::size_t k = 0, count = parts_.size(); k < count; ++k)
    if (holds(parts_[k], centre)) {
      held = true;
      if (split(k)) return true;
    }
  if (!held) delaunay_.insert(centre);
  return !held;
}

bool Refinement::run() {
  for (int pass = 0; pass < 200; ++pass) {
    if (!split_crowded()) return false;
    std::vector<std::pair<double, std::size_t>> bad;
    for (const std::size_t t : inside()) {
      const double value = badness(t);
      if (value > 1.0) bad.push_back({value, t});
    }
    std::sort(bad.rbegin(), bad.rend());
    bool changed = false;
    for (const auto& [value, t] : bad)
      if (!delaunay_.triangles()[t].gone) changed = improve(t) || changed;
    if (places().size() > most_) return false;
    if (!changed) break;
  }
  if (!split_crowded()) return false;
  smooth();
  return true;
}

/// Least share of an equilateral triangle's area by its sides, over the triangles about a vertex.
double least_quality(const Delaunay& delaunay, const std::vector<std::size_t>& around) {
  double least = 1.0;
  for (const std::size_t t : around) {
    const Vec2 a = delaunay.place(t, 0), b = delaunay.place(t, 1), c = delaunay.place(t, 2);
    const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
    least = std::min(least, 2.0 * std::sqrt(3.0) * turn_of(a, b, c) / squares);
  }
  return least;
}

void Refinement::smooth() {
  constexpr int rounds = 6;
  std::vector<std::vector<std::size_t>> around(places().size());
  for (const std::size_t t : inside())
    for (const std::size_t v : delaunay_.triangles()[t].vertices) around[v].push_back(t);
  std::vector<bool> fixed(places().size(), false);
  for (const OutlinePart& part : parts_) fixed[part.from] = fixed[part.to] = true;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t v = 0; v < around.size(); ++v) {
      if (fixed[v] || around[v].empty()) continue;
      const Vec2 old = places()[v];
      const double before = least_quality(delaunay_, around[v]);
      Vec2 sum;
      for (const std::size_t t : around[v])
        for (const std::size_t w : delaunay_.triangles()[t].vertices)
          if (w != v) sum = sum + places()[w];
      delaunay_.move(v, (0.5 / static_cast<double>(around[v].size())) * sum);
      if (least_quality(delaunay_, around[v]) < before) delaunay_.move(v, old);
    }
}

OutlineTriangles Refinement::take() {
  OutlineTriangles made;
  std::vector<std::size_t> index(places().size(), none);
  const auto number = [&](std::size_t vertex) {
    if (index[vertex] == none) {
      index[vertex] = made.places.size();
      made.places.push_back(places()[vertex]);
    }
    return index[vertex];
  };
  for (const std::size_t t : inside()) {
    const auto& v = delaunay_.triangles()[t].vertices;
    made.triangles.push_back({number(v[0]), number(v[1]), number(v[2])});
  }
  for (OutlinePart part : parts_) {
    part.from = number(part.from);
    part.to = number(part.to);
    made.border.push_back(part);
  }
  return made;
}

}  // namespace

std::optional<OutlineTriangles> triangulate_outline(const Outline& outline, double size,
                                                    double most_turn) {
  Refinement refinement(outline, size, most_turn);
  if (!refinement.run()) return std::nullopt;
  return refinement.take();
}

}  // namespace flexura

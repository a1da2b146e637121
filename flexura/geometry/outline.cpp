#include "flexura/geometry/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexura {
namespace {

Vec2 centre_of(const OutlineSide& side) {
  const Vec2 chord = side.to - side.from;
  return 0.5 * (side.from + side.to) + (0.5 / std::tan(0.5 * side.sweep)) * perp(chord);
}

std::string shown(Vec2 p) { return fmt::format("[{:.6g}, {:.6g}]", p.x, p.y); }

/// Rounds the corner between two straight sides.
std::string round_corner(OutlineLoop& loop, std::size_t first, double radius) {
  OutlineSide& before = loop[first];
  OutlineSide& after = loop[(first + 1) % loop.size()];
  const Vec2 corner = before.to;
  if (before.sweep != 0.0 || after.sweep != 0.0)
    return fmt::format("the fillet at {} is not between straight sides", shown(corner));
  const Vec2 in = (1.0 / before.length()) * (corner - before.from);
  const Vec2 out = (1.0 / after.length()) * (after.to - corner);
  const double turn = std::atan2(cross(in, out), dot(in, out));
  const double reach = radius * std::abs(std::tan(0.5 * turn));
  if (!(reach > 0.0) || !(reach < before.length()) || !(reach < after.length()))
    return fmt::format("the fillet at {} does not fit its sides", shown(corner));
  before.to = corner - reach * in;
  after.from = corner + reach * out;
  return {};
}

/// A loop as a polygon of many sides.
struct Polygon {
  explicit Polygon(const OutlineLoop& loop) {
    constexpr double step = std::numbers::pi / 24.0;
    for (const OutlineSide& side : loop) {
      const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(side.sweep) / step)));
      for (int k = 0; k < pieces; ++k) corners.push_back(side.at(static_cast<double>(k) / pieces));
    }
  }
  Vec2 corner(std::size_t k) const { return corners[k % corners.size()]; }
  double area() const {
    double twice = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) twice += cross(corner(k), corner(k + 1));
    return 0.5 * twice;
  }
  /// By how often a ray from there along x meets the sides.
  bool encloses(Vec2 p) const {
    bool inside = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 a = corner(k), b = corner(k + 1);
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
  }
  std::vector<Vec2> corners;
};

/// Whether two lines meet, ends included.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side == 0.0 && d_side == 0.0) {  // on one line
    const auto share = [&](Vec2 p) { return dot(p - a, b - a) / dot(b - a, b - a); };
    return std::max(share(c), share(d)) >= 0.0 && std::min(share(c), share(d)) <= 1.0;
  }
  return c_side * d_side <= 0.0 && a_side * b_side <= 0.0;
}

std::optional<Vec2> find_crossing(const Polygon& one, const Polygon& other, bool same) {
  const std::size_t n = one.corners.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = same ? i + 1 : 0; j < other.corners.size(); ++j) {
      const Vec2 a = one.corner(i), b = one.corner(i + 1);
      const Vec2 c = other.corner(j), d = other.corner(j + 1);
      const bool follows = same && j == i + 1, precedes = same && (j + 1) % n == i;
      // neighbours share a corner, and must not turn back on each other
      if (follows || precedes) {
        const Vec2 ahead = follows ? b - a : d - c, then = follows ? d - c : b - a;
        if (cross(ahead, then) == 0.0 && dot(ahead, then) < 0.0) return follows ? b : d;
        continue;
      }
      if (meet(a, b, c, d)) return 0.25 * (a + b + c + d);
    }
  return {};
}

}  // namespace

double OutlineSide::radius() const {
  return 0.5 * norm(to - from) / std::abs(std::sin(0.5 * sweep));
}

double OutlineSide::length() const {
  return sweep == 0.0 ? norm(to - from) : radius() * std::abs(sweep);
}

Vec2 OutlineSide::at(double share) const {
  if (share <= 0.0) return from;
  if (share >= 1.0) return to;
  if (sweep == 0.0) return from + share * (to - from);
  const Vec2 centre = centre_of(*this);
  return centre + rotate(share * sweep, from - centre);
}

OutlineLoop make_loop(const std::vector<OutlineStep>& steps, std::string& fault) {
  OutlineLoop loop;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const OutlineStep& before = steps[(k + steps.size() - 1) % steps.size()];
    loop.push_back({before.to, steps[k].to, steps[k].sweep, steps[k].name});
    if (before.to == steps[k].to)
      fault = fmt::format("a side at {} has no length", shown(before.to));
    if (!(std::abs(steps[k].sweep) < 2.0 * std::numbers::pi))
      fault = fmt::format("the arc to {} sweeps a full turn or more", shown(steps[k].to));
  }
  const bool encloses =
      steps.size() > 2 || (steps.size() == 2 && (steps[0].sweep != 0.0 || steps[1].sweep != 0.0));
  if (!encloses) fault = "it takes three corners, or two and an arc, to enclose anything";
  std::size_t rounded = 0;
  for (std::size_t k = 0; k < steps.size() && fault.empty(); ++k) {
    if (!(steps[k].fillet > 0.0)) continue;
    const std::size_t side = k + rounded;
    const OutlineSide after = loop[(side + 1) % loop.size()];
    const Vec2 in = loop[side].to - loop[side].from, out = after.to - after.from;
    fault = round_corner(loop, side, steps[k].fillet);
    const OutlineSide arc{loop[side].to, loop[(side + 1) % loop.size()].from,
                          std::atan2(cross(in, out), dot(in, out)), ""};
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(side) + 1, arc);
    ++rounded;
  }
  return loop;
}

OutlineLoop make_circle(Vec2 centre, double radius, const std::string& name) {
  const Vec2 right = centre + Vec2{radius, 0.0}, left = centre - Vec2{radius, 0.0};
  return {{right, left, std::numbers::pi, name}, {left, right, std::numbers::pi, name}};
}

std::optional<std::string> find_outline_fault(const Outline& outline) {
  std::vector<Polygon> polygons(outline.loops.begin(), outline.loops.end());
  const auto name_of = [](std::size_t loop) {
    return loop == 0 ? std::string("the border") : fmt::format("hole {}", loop);
  };
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (std::size_t j = i; j < polygons.size(); ++j) {
      const auto crossing = find_crossing(polygons[i], polygons[j], i == j);
      if (crossing && i == j)
        return fmt::format("{} crosses itself near {}", name_of(i), shown(*crossing));
      if (crossing)
        return fmt::format("{} meets {} near {}", name_of(j), name_of(i), shown(*crossing));
    }
  for (std::size_t i = 1; i < polygons.size(); ++i) {
    const Vec2 corner = polygons[i].corners.front();
    if (!polygons[0].encloses(corner))
      return fmt::format("{}, at {}, is not inside the border", name_of(i), shown(corner));
    for (std::size_t j = 1; j < polygons.size(); ++j)
      if (i != j && polygons[j].encloses(corner))
        return fmt::format("{} is inside {}", name_of(i), name_of(j));
  }
  return {};
}

void orient(Outline& outline) {
  for (std::size_t k = 0; k < outline.loops.size(); ++k) {
    OutlineLoop& loop = outline.loops[k];
    if ((Polygon(loop).area() > 0.0) == (k == 0)) continue;
    std::reverse(loop.begin(), loop.end());
    for (OutlineSide& side : loop) side = side.reversed();
  }
}

}  // namespace flexura

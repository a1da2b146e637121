#include "flexura/pictures/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flexura::pictures {

std::vector<std::size_t> convex_hull(const std::vector<Vec2>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].x, points[a].y) < std::pair(points[b].x, points[b].y);
  };
  std::ranges::stable_sort(order, before);
  const auto same = [&](std::size_t a, std::size_t b) { return points[a] == points[b]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 3) return order;

  // Andrew's chains: the lower one to the right, the upper one back.
  std::vector<std::size_t> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t begin = hull.size();
    for (const std::size_t i : order) {
      while (hull.size() >= begin + 2) {
        const Vec2 b = points[hull.back()];
        const Vec2 a = points[hull[hull.size() - 2]];
        if (cross(b - a, points[i] - a) > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(i);
    }
    hull.pop_back();
    std::ranges::reverse(order);
  }
  return hull;
}

bool lies_inside(const std::vector<Vec2>& corners, Vec2 place, double margin) {
  if (corners.size() < 3) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 side = corners[(i + 1) % corners.size()] - corners[i];
    if (cross(side, place - corners[i]) <= margin * norm(side)) return false;
  }
  return true;
}

std::vector<std::size_t> needed_points(const std::vector<Vec2>& line, double tolerance,
                                       double longest) {
  std::vector<bool> needed(line.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> chords;
  if (!line.empty()) {
    needed.front() = needed.back() = true;
    chords.emplace_back(0, line.size() - 1);
  }
  // Douglas and Peucker's: what lies furthest from a chord divides it.
  while (!chords.empty()) {
    const auto [from, to] = chords.back();
    chords.pop_back();
    const Vec2 chord = line[to] - line[from];
    const double length = norm(chord);
    std::size_t furthest = from;
    double most = tolerance;
    for (std::size_t k = from + 1; k < to; ++k) {
      const Vec2 arm = line[k] - line[from];
      const double away = length > 0.0 ? std::abs(cross(chord, arm)) / length : norm(arm);
      if (away <= most) continue;
      most = away;
      furthest = k;
    }
    if (furthest == from) continue;
    needed[furthest] = true;
    chords.emplace_back(from, furthest);
    chords.emplace_back(furthest, to);
  }
  std::vector<std::size_t> kept;
  double way = 0.0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (k > 0) way += norm(line[k] - line[k - 1]);
    if (!needed[k] && way < longest) continue;
    kept.push_back(k);
    way = 0.0;
  }
  return kept;
}

std::vector<std::pair<std::size_t, std::size_t>> shortest_arms(const std::vector<Vec2>& points) {
  // Prim's: from the first point on, the nearest one that is not yet joined.
  std::vector<std::pair<std::size_t, std::size_t>> arms;
  std::vector<std::size_t> nearest(points.size(), 0);
  std::vector<bool> joined(points.size(), false);
  if (!points.empty()) joined[0] = true;
  for (std::size_t n = 1; n < points.size(); ++n) {
    std::size_t next = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d = norm(points[i] - points[nearest[i]]);
      if (joined[i] || d >= least) continue;
      next = i;
      least = d;
    }
    if (next == 0) break;
    joined[next] = true;
    arms.emplace_back(nearest[next], next);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (norm(points[i] - points[next]) < norm(points[i] - points[nearest[i]])) nearest[i] = next;
  }
  return arms;
}

}  // namespace flexura::pictures

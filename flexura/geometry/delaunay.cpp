#include "flexura/geometry/delaunay.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {

Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 p = b - a, q = c - a;
  const double twice = 2.0 * cross(p, q);
  const double pp = dot(p, p), qq = dot(q, q);
  return a + (1.0 / twice) * Vec2{q.y * pp - p.y * qq, p.x * qq - q.x * pp};
}

Delaunay::Delaunay(Vec2 low, Vec2 high) {
  const Vec2 middle = 0.5 * (low + high);
  const double reach = 10.0 * std::max(high.x - low.x, high.y - low.y);
  places_ = {middle + Vec2{-reach, -reach}, middle + Vec2{reach, -reach},
             middle + Vec2{reach, reach}, middle + Vec2{-reach, reach}};
  triangles_ = {{{0, 1, 2}, {none, none, 1}}, {{0, 2, 3}, {0, none, none}}};
  of_vertex_ = {0, 0, 0, 1};
}

/// Walks towards the point; sides are crossed where it lies beyond.
std::size_t Delaunay::find(Vec2 place) const {
  std::size_t at = last_;
  for (std::size_t steps = 0; steps < 4 * triangles_.size(); ++steps) {
    const Triangle& triangle = triangles_[at];
    std::size_t next = none;
    for (std::size_t k = 0; k < 3 && next == none; ++k) {
      const std::size_t i = (k + steps) % 3;  // no side comes first always: no walk goes in circles
      const Vec2 a = places_[triangle.vertices[i]];
      const Vec2 b = places_[triangle.vertices[(i + 1) % 3]];
      if (turn_of(a, b, place) < 0.0) next = triangle.across[i];
    }
    if (next == none) return at;
    at = next;
  }
  return at;
}

bool Delaunay::holds_in_circle(std::size_t triangle, Vec2 place) const {
  using Long = long double;
  Long m[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 corner = places_[triangles_[triangle].vertices[i]];
    m[i][0] = static_cast<Long>(corner.x) - static_cast<Long>(place.x);
    m[i][1] = static_cast<Long>(corner.y) - static_cast<Long>(place.y);
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  const Long parts[3] = {m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]),
                         m[1][2] * (m[2][0] * m[0][1] - m[2][1] * m[0][0]),
                         m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0])};
  const Long size = std::abs(parts[0]) + std::abs(parts[1]) + std::abs(parts[2]);
  return parts[0] + parts[1] + parts[2] > 1e-13L * size;
}

std::vector<std::size_t> Delaunay::cavity_of(std::size_t first, Vec2 place) const {
  std::vector<std::size_t> cavity{first};
  std::vector<bool> inside(triangles_.size(), false);
  inside[first] = true;
  for (std::size_t k = 0; k < cavity.size(); ++k) {
    const Triangle& triangle = triangles_[cavity[k]];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = triangle.across[i];
      if (next == none || inside[next]) continue;
      const Vec2 a = places_[triangle.vertices[i]];
      const Vec2 b = places_[triangle.vertices[(i + 1) % 3]];
      // a side that the point lies on, to rounding, would make a flat triangle
      const bool flat = turn_of(a, b, place) <= 1e-12 * dot(b - a, b - a);
      if (!flat && !holds_in_circle(next, place)) continue;
      inside[next] = true;
      cavity.push_back(next);
    }
  }
  return cavity;
}

void Delaunay::fill(const std::vector<std::size_t>& cavity, std::size_t vertex) {
  for (const std::size_t t : cavity) triangles_[t].gone = true;
  std::map<std::size_t, std::size_t> starting;  // new triangle by the start of its outer side
  std::vector<std::size_t> added;
  for (const std::size_t t : cavity)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = triangles_[t].across[i];
      if (next != none && triangles_[next].gone) continue;
      const std::size_t a = triangles_[t].vertices[i];
      const std::size_t b = triangles_[t].vertices[(i + 1) % 3];
      const std::size_t made = triangles_.size();
      triangles_.push_back({{a, b, vertex}, {next, none, none}});
      if (next != none)
        for (std::size_t j = 0; j < 3; ++j)
          if (triangles_[next].vertices[j] == b) triangles_[next].across[j] = made;
      starting[a] = made;
      of_vertex_[a] = of_vertex_[b] = made;
      added.push_back(made);
    }
  for (const std::size_t t : added) {
    const std::size_t next = starting.at(triangles_[t].vertices[1]);
    triangles_[t].across[1] = next;
    triangles_[next].across[2] = t;
  }
  of_vertex_[vertex] = last_ = added.front();
}

std::size_t Delaunay::insert(Vec2 place) {
  const std::size_t around = find(place);
  for (const std::size_t v : triangles_[around].vertices)
    if (places_[v] == place) return v;
  const std::size_t vertex = places_.size();
  places_.push_back(place);
  of_vertex_.push_back(around);
  fill(cavity_of(around, place), vertex);
  return vertex;
}

std::size_t Delaunay::left_of(std::size_t a, std::size_t b) const {
  // round a, both ways in case the border is met
  const std::size_t first = of_vertex_[a];
  std::size_t at = first;
  do {
    const Triangle& triangle = triangles_[at];
    const auto i =
        static_cast<std::size_t>(std::find(triangle.vertices.begin(), triangle.vertices.end(), a) -
                                 triangle.vertices.begin());
    if (triangle.vertices[(i + 1) % 3] == b) return at;
    at = triangle.across[(i + 2) % 3];
  } while (at != none && at != first);
  return none;
}

}  // namespace flexura

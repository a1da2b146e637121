#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// Positive where a, b, c go round counter-clockwise: twice the area.
inline double turn_of(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

/// Middle of the circle through three points.
Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c);

/// A Delaunay triangulation that grows point by point (Bowyer 1981, Watson 1981), within a square
/// far around the points: its corners are vertices 0 to 3.
class Delaunay {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// Vertices counter-clockwise, and the triangle across the side from each to the next.
  struct Triangle {
    std::array<std::size_t, 3> vertices;
    std::array<std::size_t, 3> across;
    bool gone = false;
  };

  /// Points to come lie between these corners.
  Delaunay(Vec2 low, Vec2 high);

  /// The new vertex; one that is there already where the point falls on it.
  std::size_t insert(Vec2 place);

  const std::vector<Vec2>& places() const { return places_; }
  /// Of a vertex that moves: nothing is triangulated anew.
  void move(std::size_t vertex, Vec2 place) { places_[vertex] = place; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  Vec2 place(std::size_t triangle, std::size_t corner) const {
    return places_[triangles_[triangle].vertices[corner]];
  }
  /// Triangle on the left of a side that goes from a to b, or none.
  std::size_t left_of(std::size_t a, std::size_t b) const;
  Vec2 circumcentre_of(std::size_t triangle) const {
    return circumcentre(place(triangle, 0), place(triangle, 1), place(triangle, 2));
  }

 private:
  std::size_t find(Vec2 place) const;
  bool holds_in_circle(std::size_t triangle, Vec2 place) const;
  /// Triangles whose circle holds the point, from that around it on.
  std::vector<std::size_t> cavity_of(std::size_t first, Vec2 place) const;
  void fill(const std::vector<std::size_t>& cavity, std::size_t vertex);

  std::vector<Vec2> places_;
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> of_vertex_;  // a triangle of each
  std::size_t last_ = 0;
};

}  // namespace flexura

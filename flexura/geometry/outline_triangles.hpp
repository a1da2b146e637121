#pragma once

#include <optional>
#include <vector>

#include "flexura/geometry/delaunay.hpp"
#include "flexura/geometry/outline.hpp"

namespace flexura {

/// A part of a side of an outline between two vertices.
struct OutlinePart {
  std::size_t from = 0;
  std::size_t to = 0;
  const OutlineSide* side = nullptr;
  double from_share = 0.0;  ///< of the side
  double to_share = 1.0;
};

/// An outline in triangles, counter-clockwise, with its border: no part of it is missing.
struct OutlineTriangles {
  std::vector<Vec2> places;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<OutlinePart> border;
};

/// Triangles with sides of about `size`, none of which turns with an arc by more than `most_turn`,
/// shorter where the outline is curved or thin and growing
/// from there (Ruppert, J. Algorithms 18, 1995): parts of the border are halved, on the true side,
/// until no vertex lies in the circle about one, and the middles of the circles about triangles
/// that are too large or too narrow become vertices. Vertices inside then move to the middle of
/// their neighbours. Nothing where that does not come to an end.
std::optional<OutlineTriangles> triangulate_outline(const Outline& outline, double size,
                                                    double most_turn);

}  // namespace flexura

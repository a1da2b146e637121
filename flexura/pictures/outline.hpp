#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura::pictures {

/// Indices of the corners of the convex hull, counter-clockwise; of points in a line the two ends,
/// of points in one place one.
std::vector<std::size_t> convex_hull(const std::vector<Vec2>& points);

/// Whether a place lies inside a convex polygon with counter-clockwise corners, by more than
/// `margin` from every side.
bool lies_inside(const std::vector<Vec2>& corners, Vec2 place, double margin);

/// Indices of the points that a line needs: none that is left out lies further than `tolerance`
/// from the chord over it, and none is further than about `longest` along the line from the last
/// before. The first and the last are among them.
std::vector<std::size_t> needed_points(const std::vector<Vec2>& line, double tolerance,
                                       double longest);

/// The shortest lines that join all points: pairs of indices.
std::vector<std::pair<std::size_t, std::size_t>> shortest_arms(const std::vector<Vec2>& points);

}  // namespace flexura::pictures

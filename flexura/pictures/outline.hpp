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

/// The shortest lines that join all points: pairs of indices.
std::vector<std::pair<std::size_t, std::size_t>> shortest_arms(const std::vector<Vec2>& points);

}  // namespace flexura::pictures

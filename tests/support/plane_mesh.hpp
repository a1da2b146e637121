#pragma once

#include <functional>

#include "flexura/geometry/mesh_link.hpp"

namespace flexura::testing {

/// A unit square in nx by ny quadrilaterals, or twice as many triangles, mapped to the plane. The
/// attachments are its left and its right edge; depth 1.
MeshLink mapped_link(ElementKind kind, int nx, int ny, const std::function<Vec2(Vec2)>& map);

/// Length by height from the origin, the left edge's middle.
MeshLink bar_link(ElementKind kind, int nx, int ny, double length, double height);

}  // namespace flexura::testing

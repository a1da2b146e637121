#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexura/geometry/mesh_link.hpp"
#include "flexura/geometry/outline.hpp"

namespace flexura {

/// An outline in quadrilaterals, and the nodes on its named sides.
struct OutlineMesh {
  PlaneMesh mesh;
  std::map<std::string, std::vector<std::size_t>> named;
};

/// About as many quadrilaterals of this size as the outline takes; what it takes where it is thin
/// or curved comes on top.
double expected_elements(const Outline& outline, double size);

/// Quadrilaterals whose sides are about `size` long, and shorter where the outline is curved or
/// thin, of four nodes (`order` 1) or eight (2); nodes of the border lie on it. Empty where the
/// outline has corners too sharp, or parts too thin for the size. Preconditions: no fault,
/// oriented.
OutlineMesh mesh_outline(const Outline& outline, double size, int order);

}  // namespace flexura

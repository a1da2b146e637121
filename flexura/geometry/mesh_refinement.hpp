#pragma once

#include <vector>

#include "flexura/geometry/mesh_link.hpp"

namespace flexura {

/// A link with every element divided into four of its kind: elements 4 e to 4 e + 3 are the parts
/// of element e. Sides keep their shape. What lies between attached nodes is attached.
struct MeshRefinement {
  /// Where a node lies in the coarse mesh.
  struct Origin {
    std::size_t element = 0;
    Vec2 place;  ///< in reference coordinates
  };

  MeshLink link;
  std::vector<Origin> origins;  ///< of the nodes
};

MeshRefinement refine_mesh(const MeshLink& link);

/// Where a place of an element's part lies in the element, in reference coordinates. Parts lie at
/// the corners; that of a triangle behind them is the one in the middle.
Vec2 place_of_part(ElementKind kind, std::size_t part, Vec2 place);

}  // namespace flexura

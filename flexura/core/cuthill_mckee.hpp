#pragma once

#include <cstddef>
#include <vector>

namespace flexura {

/// Neighbours of every vertex of a graph in one piece.
using Neighbours = std::vector<std::vector<std::size_t>>;

/// An order of the vertices in which neighbours are near: layer by layer from a vertex at the rim,
/// those with few neighbours first, and back to front (Cuthill and McKee 1969, reversed after
/// George 1971; the vertex at the rim by Gibbs, Poole and Stockmeyer 1976).
std::vector<std::size_t> reverse_cuthill_mckee(const Neighbours& neighbours);

}  // namespace flexura

#include "flexura/core/cuthill_mckee.hpp"

#include <algorithm>

namespace flexura {
namespace {

/// Vertices layer by layer from the first, and how many layers there are.
struct Layers {
  std::vector<std::size_t> order;
  std::size_t count = 0;
};

Layers layers_from(std::size_t first, const Neighbours& neighbours) {
  Layers layers;
  std::vector<char> seen(neighbours.size(), 0);
  seen[first] = 1;
  layers.order = {first};
  std::vector<std::size_t> next;
  for (std::size_t begin = 0; begin < layers.order.size(); ++layers.count) {
    const std::size_t end = layers.order.size();
    for (; begin < end; ++begin) {
      next.clear();
      for (const std::size_t v : neighbours[layers.order[begin]]) {
        if (seen[v]) continue;
        seen[v] = 1;
        next.push_back(v);
      }
      std::stable_sort(next.begin(), next.end(), [&](std::size_t a, std::size_t b) {
        return neighbours[a].size() < neighbours[b].size();
      });
      layers.order.insert(layers.order.end(), next.begin(), next.end());
    }
  }
  return layers;
}

}  // namespace

std::vector<std::size_t> reverse_cuthill_mckee(const Neighbours& neighbours) {
  if (neighbours.empty()) return {};
  Layers layers = layers_from(0, neighbours);
  for (;;) {
    Layers further = layers_from(layers.order.back(), neighbours);
    const bool done = further.count <= layers.count;
    layers = std::move(further);
    if (done) break;
  }
  std::reverse(layers.order.begin(), layers.order.end());
  return layers.order;
}

}  // namespace flexura

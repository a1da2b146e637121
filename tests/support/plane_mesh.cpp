#include "tests/support/plane_mesh.hpp"

#include <map>

namespace flexura::testing {
namespace {

/// Nodes of a lattice twice as fine as the quadrilaterals, made where they are asked for.
class Lattice {
 public:
  Lattice(MeshLink& link, int nx, int ny, const std::function<Vec2(Vec2)>& map)
      : link_(link), nx_(nx), ny_(ny), map_(map) {}

  std::size_t node(int i, int j) {
    const auto [at, is_new] = index_.try_emplace({i, j}, link_.mesh.nodes.size());
    if (!is_new) return at->second;
    link_.mesh.nodes.push_back(map_({0.5 * i / nx_, 0.5 * j / ny_}));
    if (i == 0) link_.base.push_back(at->second);
    if (i == 2 * nx_) link_.action.push_back(at->second);
    return at->second;
  }

 private:
  MeshLink& link_;
  int nx_;
  int ny_;
  const std::function<Vec2(Vec2)>& map_;
  std::map<std::pair<int, int>, std::size_t> index_;
};

struct Corner {
  int i, j;
};

}  // namespace

MeshLink mapped_link(ElementKind kind, int nx, int ny, const std::function<Vec2(Vec2)>& map) {
  MeshLink link;
  link.depth = 1.0;
  Lattice lattice(link, nx, ny, map);
  long label = 0;
  const auto add = [&](const std::vector<Corner>& corners) {
    std::vector<std::size_t> nodes;
    for (const Corner& c : corners) nodes.push_back(lattice.node(c.i, c.j));
    const std::size_t count = corners.size();
    if (nodes_of(kind) > count)
      for (std::size_t a = 0; a < count; ++a) {
        const Corner& p = corners[a];
        const Corner& q = corners[(a + 1) % count];
        nodes.push_back(lattice.node((p.i + q.i) / 2, (p.j + q.j) / 2));
      }
    if (kind == ElementKind::quad9)
      nodes.push_back(
          lattice.node((corners[0].i + corners[2].i) / 2, (corners[0].j + corners[2].j) / 2));
    link.mesh.add(kind, nodes, ++label);
  };
  for (int x = 0; x < 2 * nx; x += 2)
    for (int y = 0; y < 2 * ny; y += 2) {
      if (corners_of(kind) == 4) {
        add({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}});
      } else {
        add({{x, y}, {x + 2, y}, {x + 2, y + 2}});
        add({{x, y}, {x + 2, y + 2}, {x, y + 2}});
      }
    }
  return link;
}

MeshLink bar_link(ElementKind kind, int nx, int ny, double length, double height) {
  return mapped_link(kind, nx, ny, [&](Vec2 p) {
    return Vec2{length * p.x, height * (p.y - 0.5)};
  });
}

}  // namespace flexura::testing

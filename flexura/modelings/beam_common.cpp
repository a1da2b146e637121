#include "flexura/modelings/beam_common.hpp"

#include <cmath>
#include <vector>

namespace flexura {

double halving_error_ratio(const BeamMesh& mesh) {
  return 1.0 / (1.0 - std::pow(0.25, static_cast<double>(mesh.order)));
}

void prolong_nodes(const BeamMesh& mesh, const BeamMesh& finer, std::size_t components,
                   std::span<const double> coarse, std::span<double> fine) {
  std::vector<double> nodal(components, 0.0);
  nodal.insert(nodal.end(), coarse.begin(), coarse.end());
  const double h = finer.length / static_cast<double>(finer.elements);
  std::size_t k = 0;
  for (std::size_t e = 0; e < finer.elements; ++e)
    for (std::size_t a = 1; a <= finer.order; ++a, ++k)
      mesh.interpolate(h * (static_cast<double>(e) + finer.node_place(a)), nodal,
                       fine.subspan(k * components, components));
}

SectionState section_at(const StationGrid& grid, std::size_t station, const Pose& moved, Vec2 tip,
                        const Eigen::Vector3d& load) {
  const Vec2 f{load[0], load[1]};
  const Vec2 t = unit(grid.angles[station] + moved.rotation);
  return {moved, dot(f, t), dot(f, perp(t)), load[2] + cross(tip - moved.position, f)};
}

}  // namespace flexura

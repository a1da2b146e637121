#include "flexura/modelings/continuum_link_refined.hpp"

namespace flexura {

const LinkRefinement::Made& LinkRefinement::made() const {
  std::call_once(once_, [this] {
    MeshRefinement refinement = refine_mesh(coarse_);
    LinkMesh mesh(refinement.link, axis_);
    made_ = std::make_unique<Made>(Made{std::move(refinement), std::move(mesh)});
  });
  return *made_;
}

void LinkRefinement::prolong_nodes(const std::vector<Vec2>& moved,
                                   const std::vector<std::size_t>* order, double* fine) const {
  const Made& to = made();
  for (std::size_t n = 0; n < to.of.origins.size(); ++n) {
    const std::size_t first = to.mesh.unknown[n];
    if (first >= LinkMesh::at_action) continue;
    const auto& [index, place] = to.of.origins[n];
    const PlaneMesh::Element& element = coarse_.mesh.elements[index];
    const ShapeValues shape = shape_values(element.kind, place);
    Vec2 sum;
    for (std::size_t a = 0; a < shape.values.size(); ++a)
      sum = sum + shape.values[a] * moved[coarse_.mesh.node(element, a)];
    fine[order ? (*order)[first] : first] = sum.x / to.mesh.length;
    fine[order ? (*order)[first + 1] : first + 1] = sum.y / to.mesh.length;
  }
}

/// Blocks keep the order of the elements, so that the parts of each lie together.
void LinkRefinement::prolong_strains(const LinkMesh& mesh, const double* strains,
                                     double* fine) const {
  const LinkMesh& to = made().mesh;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const LinkBlock& block = mesh.blocks[b];
    const std::size_t count = block.tables.points.size();
    for (std::size_t e = 0; e < to.blocks[b].elements(); ++e)
      for (std::size_t g = 0; g < count; ++g) {
        const ElementPoint& point = block.tables.points[g];
        const auto values =
            through_points(block.kind, place_of_part(block.kind, e % 4, {point.xi, point.eta}));
        const double* own = strains + 3 * (block.first_point + e / 4 * count);
        double* out = fine + 3 * (to.blocks[b].first_point + e * count + g);
        for (std::size_t i = 0; i < 3; ++i) {
          out[i] = 0.0;
          for (std::size_t k = 0; k < count; ++k) out[i] += values[k] * own[3 * k + i];
        }
      }
  }
}

}  // namespace flexura

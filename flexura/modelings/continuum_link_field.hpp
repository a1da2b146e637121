#pragma once

#include "flexura/core/stress_field.hpp"
#include "flexura/model/model.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"

namespace flexura {

/// Stresses of a link from the places of all its nodes and the strains of its quadrature points,
/// three each.
StressField recover_link_stress(const LinkMesh& mesh, const Material& material,
                                const ContinuumSettings& settings, const std::vector<Vec2>& places,
                                const double* strains);

}  // namespace flexura

#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/geometry/mesh_link.hpp"
#include "flexura/model/model.hpp"
#include "flexura/model/modeling_settings.hpp"

namespace flexura {

/// A link of any shape as a continuum: the elements of its mesh with the energy, the independent
/// and the enhanced strains of continuum_element.hpp, its attachments rigid with their bodies. Base
/// and action end are those of link_axis. Tangents are factorized sparsely, in an order that is
/// found once. Precondition: the mesh has no fault.
std::shared_ptr<const TwoPort> make_link_port(const MeshLink& link, const Material& material,
                                              const ContinuumSettings& settings);

}  // namespace flexura

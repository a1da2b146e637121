#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Geometrically exact beam elements: Lagrange interpolation of displacement and rotation on
/// Gauss-Lobatto nodes over the arc length of the true axis, with as many Gauss points as the order
/// (reduced integration: no locking), in axes fixed to the base body. Where axial or shear strain
/// is switched off, or both, the same elements with the forces as unknowns instead, which give the
/// same answers and stay regular without those strains.
std::shared_ptr<const TwoPort> make_beam_port(const FlexureProperties& flexure,
                                              const BeamSettings& settings);

}  // namespace flexura

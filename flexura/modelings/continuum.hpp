#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/model/model.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/continuum_mesh.hpp"

namespace flexura {

/// The flexure as a continuum in its plane at large displacement and rotation: quadrilaterals of
/// Gauss-Lobatto nodes (continuum_mesh.hpp) with an energy density of the deformation gradient
/// (energy/continuum.hpp). Its end faces move with the bodies. Strains are unknowns too
/// (continuum_element.hpp), eliminated at every quadrature point; node columns are eliminated from
/// both ends to the middle. Preconditions: two elements along or more; the outline does not fold.
std::shared_ptr<const TwoPort> make_continuum_port(const StripShape& shape,
                                                   const Material& material,
                                                   const ContinuumSettings& settings,
                                                   double tolerance);

}  // namespace flexura

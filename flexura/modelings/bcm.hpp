#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// The beam constraint model, chained where there are several elements: each in the frame of its
/// own start, joined by balance of the loads (Ma, Chen, J. Mech. Rob. 8(2), 2016). Without shear
/// strain. Precondition: the flexure is straight.
std::shared_ptr<const TwoPort> make_bcm_port(const FlexureProperties& flexure,
                                             const BcmSettings& settings);

}  // namespace flexura

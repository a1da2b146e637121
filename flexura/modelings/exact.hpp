#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Modes of a flexure that turns by `turning` that the tolerance makes likely.
int likely_exact_modes(double turning, double tolerance);

/// The exact flexure: a planar Reissner beam in Hellinger-Reissner form, its bending moment in
/// Legendre modes over the arc length of each smooth piece of the axis,
///     M(s) = EI/L sum_i y_i P_i,   theta(s) = theta0(s) + sum_i y_i (1/L) int_0^s P_i,
/// its axial and shear strain eliminated point by point. The number of modes is the setting's, or
/// that which the tolerance makes likely; `refined()` has a few more.
std::shared_ptr<const TwoPort> make_exact_port(const FlexureProperties& flexure,
                                               const ExactSettings& settings, double tolerance);

}  // namespace flexura

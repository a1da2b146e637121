#pragma once

#include "flexura/assembly/system_layout.hpp"
#include "flexura/core/jet2.hpp"

namespace flexura {

/// A spring's length, or its turn if it is torsional, by the six unknowns x, y and rotation of both
/// bodies, base body first. To first order in the kinematics, the length is along the line as
/// drawn.
Jet2<6> spring_length(const SystemLayout& layout, const SystemLayout::Spring& spring,
                      const Pose& base, const Pose& action);

/// Its energy, likewise; `assembly` is the share of its misfit that is there.
Jet2<6> spring_potential(const SystemLayout& layout, const SystemLayout::Spring& spring,
                         const Pose& base, const Pose& action, double assembly);

}  // namespace flexura

#pragma once

#include <array>

#include "flexura/assembly/system_layout.hpp"
#include "flexura/core/jet2.hpp"

namespace flexura {

/// What is left open of a joint: its places' distance x, y; or the distance across a slide's
/// direction and the relative rotation. By the six unknowns x, y and rotation of both bodies, base
/// body first.
std::array<Jet2<6>, 2> joint_gaps(const SystemLayout& layout, const SystemLayout::Joint& joint,
                                  const Pose& base, const Pose& action);

/// The same to first order about the drawn state.
std::array<Jet2<6>, 2> linearised_joint_gaps(const SystemLayout& layout,
                                             const SystemLayout::Joint& joint, const Pose& base,
                                             const Pose& action);

}  // namespace flexura

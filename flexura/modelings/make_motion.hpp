#pragma once

#include "flexura/assembly/motion_system.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// What acts on a mechanism in motion, besides what is prescribed.
struct MotionLoads {
  std::vector<Load> loads;
  FieldLoads fields;
  DampingSettings damping;  ///< but for the modal part, which belongs to a state
};

/// One flexure of it.
std::shared_ptr<const MotionPort> make_motion_port(const Model& model, std::size_t flexure,
                                                   const FieldLoads& fields,
                                                   const ModelingSettings& settings,
                                                   const InertiaSettings& inertia);

/// A modeling applied to a model that moves in time. Bodies keep their indices, flexures become
/// members in the same order. Driven bodies move: their drivers' motion is still to be prescribed.
MotionLayout make_motion_layout(const Model& model, const MotionLoads& acting,
                                const ModelingSettings& settings, const InertiaSettings& inertia);

}  // namespace flexura

#pragma once

#include <memory>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/continuum_mesh.hpp"
#include "flexura/modelings/flexure_inertia.hpp"
#include "flexura/modelings/flexure_properties.hpp"
#include "flexura/modelings/prbm.hpp"

namespace flexura {

// The modelings' flexures in motion. Loads along a flexure and its temperature, in its properties'
// field, act in full.

/// Modes of moment, axial and shear force; `tolerance` decides how many where the settings do not.
std::shared_ptr<const MotionPort> make_exact_motion_port(const FlexureProperties& flexure,
                                                         const FlexureInertia& inertia,
                                                         const ExactSettings& settings,
                                                         double tolerance);

/// Sections move with the joint that stands for their part of the flexure.
std::shared_ptr<const MotionPort> make_prbm_motion_port(const FlexureProperties& flexure,
                                                        const FlexureInertia& inertia,
                                                        const PseudoRigidChain& chain);

std::shared_ptr<const MotionPort> make_beam_motion_port(const FlexureProperties& flexure,
                                                        const FlexureInertia& inertia,
                                                        const BeamSettings& settings);

/// Sections move as a load on the tip alone would move them there. `at`: see CompliantPort.
std::shared_ptr<const MotionPort> make_compliant_motion_port(const FlexureProperties& flexure,
                                                             const FlexureInertia& inertia,
                                                             Vec2 at);

std::shared_ptr<const MotionPort> make_bcm_motion_port(const FlexureProperties& flexure,
                                                       const FlexureInertia& inertia,
                                                       const BcmSettings& settings);

/// Masses at the quadrature points. Preconditions: those of make_continuum_port; no lumped masses.
std::shared_ptr<const MotionPort> make_continuum_motion_port(const StripShape& shape,
                                                             const Material& material,
                                                             double density,
                                                             const ContinuumSettings& settings,
                                                             double tolerance);

/// A link of any shape. Preconditions: those of make_link_port.
std::shared_ptr<const MotionPort> make_link_motion_port(const MeshLink& link,
                                                        const Material& material, double density,
                                                        const ContinuumSettings& settings);

}  // namespace flexura

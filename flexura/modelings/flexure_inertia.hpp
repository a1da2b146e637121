#pragma once

#include "flexura/energy/kinetic.hpp"
#include "flexura/model/model.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Which inertia a flexure has, and where.
struct FlexureInertia {
  double density = 0.0;
  Section shape;
  double length = 0.0;
  bool translation = true;
  bool rotary = true;
  bool shear_rotary = true;  ///< sections turn with the shear strain; otherwise with the axis
  bool lumped = false;

  /// Second derivatives of the kinetic energies per length by a velocity: rho A and rho I, or zero.
  SectionInertia at(double s) const;
};

FlexureInertia flexure_inertia(const Model& model, const Flexure& flexure,
                               const InertiaSettings& settings, bool shear);

}  // namespace flexura

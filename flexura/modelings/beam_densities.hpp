#pragma once

#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// The geometrically exact beam (energy/reissner.hpp).
struct ReissnerDensity {
  SectionStiffness section;

  template <class Scalar, class Stretch>
  Scalar operator()(const Scalar& dx, const Scalar& dy, const Scalar& theta, const Scalar& kappa,
                    const Stretch& stretch) const {
    return reissner_strain_energy(dx, dy, theta, kappa, section, stretch);
  }
};

/// The same with a section that varies.
struct VaryingReissnerDensity {
  FlexureProperties flexure;

  ReissnerDensity at(double s) const {
    const FlexureProperties::Local local = flexure.at(s);
    return {{1.0 / local.axial_compliance, 1.0 / local.shear_compliance, local.bending_stiffness}};
  }
};

/// Of a constant section. Preconditions: axial and shear compliance > 0.
inline ReissnerDensity reissner_density(const FlexureProperties& flexure) {
  return {
      {1.0 / flexure.axial_compliance, 1.0 / flexure.shear_compliance, flexure.bending_stiffness}};
}

}  // namespace flexura

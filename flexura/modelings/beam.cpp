#include "flexura/modelings/beam.hpp"

#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/lagrange_beam.hpp"

namespace flexura {
namespace {

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

}  // namespace

std::shared_ptr<const TwoPort> make_beam_port(const FlexureProperties& flexure,
                                              const BeamSettings& settings) {
  if (settings.theory == BeamSettings::Theory::printed)
    return make_printed_beam_port(flexure, settings.elements);
  if (settings.theory != BeamSettings::Theory::exact)
    return make_hermite_beam_port(flexure, settings);
  if (flexure.axial_compliance > 0.0 && flexure.shear_compliance > 0.0) {
    if (flexure.varying) {
      const VaryingReissnerDensity density{flexure};
      return std::make_shared<LagrangeBeamPort<VaryingReissnerDensity>>(flexure, settings, density);
    }
    const ReissnerDensity density{{1.0 / flexure.axial_compliance, 1.0 / flexure.shear_compliance,
                                   flexure.bending_stiffness}};
    return std::make_shared<LagrangeBeamPort<ReissnerDensity>>(flexure, settings, density);
  }
  return make_force_beam_port(flexure, settings);
}

}  // namespace flexura

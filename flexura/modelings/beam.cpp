#include "flexura/modelings/beam.hpp"

#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/beam_densities.hpp"
#include "flexura/modelings/lagrange_beam.hpp"

namespace flexura {
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
    return std::make_shared<LagrangeBeamPort<ReissnerDensity>>(flexure, settings,
                                                               reissner_density(flexure));
  }
  return make_force_beam_port(flexure, settings);
}

}  // namespace flexura

#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/beam_densities.hpp"
#include "flexura/modelings/lagrange_motion.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {

std::shared_ptr<const MotionPort> make_beam_motion_port(const FlexureProperties& flexure,
                                                        const FlexureInertia& inertia,
                                                        const BeamSettings& settings) {
  if (settings.theory != BeamSettings::Theory::exact)
    return make_hermite_motion_port(flexure, inertia, settings);
  if (flexure.axial_compliance == 0.0 || flexure.shear_compliance == 0.0)
    return make_force_beam_motion_port(flexure, inertia, settings);
  if (flexure.varying)
    return std::make_shared<LagrangeMotionPort<VaryingReissnerDensity>>(
        flexure, inertia, settings, VaryingReissnerDensity{flexure});
  return std::make_shared<LagrangeMotionPort<ReissnerDensity>>(flexure, inertia, settings,
                                                               reissner_density(flexure));
}

}  // namespace flexura

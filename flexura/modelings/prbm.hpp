#pragma once

#include <memory>

#include "flexura/assembly/two_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// A chain of rigid segments and torsion springs in place of a flexure, as drawn, global axes.
struct PseudoRigidChain {
  std::vector<Vec2> joints;       ///< from base to action end
  std::vector<double> stiffness;  ///< moment per radian
};

/// Howell's 1R model by the load ratio n = (axial compression)/(transverse force): characteristic
/// radius factor gamma and stiffness coefficient K_theta (Howell, Compliant Mechanisms, 2001).
struct HowellParameters {
  double radius = 0.0;
  double stiffness = 0.0;
};
/// n is clamped to the range of the fits, -5 to 10.
HowellParameters howell_parameters(double load_ratio);
/// For a moment at the end alone. The usual 1.5164 is the spring in EI/L, gamma K_theta, not
/// K_theta as some write: only so does the end turn by M L/EI, at c_theta = 1.5164.
HowellParameters howell_end_moment();

/// The chain of the settings. `load_ratio` is used where Howell's model follows the load; absent,
/// the load is a pure moment.
PseudoRigidChain pseudo_rigid_chain(const FlexureProperties& flexure, const PrbmSettings& settings,
                                    std::optional<double> load_ratio);

std::shared_ptr<const TwoPort> make_prbm_port(const FlexureProperties& flexure,
                                              const PseudoRigidChain& chain);

}  // namespace flexura

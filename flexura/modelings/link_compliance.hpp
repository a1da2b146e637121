#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/assembly/two_port.hpp"
#include "flexura/geometry/mesh_link.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// The 3x3 compliance matrix of a link of any shape held at its base, in plane stress: displacement
/// (x, y, rotation) of its action end per load (force x, force y, moment) there.
Eigen::Matrix3d link_compliance(const MeshLink& link, const Material& material);

/// Stations of a link, which has no axis to show: a cubic from the base end to the moved action end
/// that leaves both as they turned, or to first order in the displacement, and the forces that hold
/// the load on the tip. `drawn` is the action end and `tip` its pose, both from the base end.
std::vector<SectionState> link_sections(Vec2 drawn, const Pose& tip, const Eigen::Vector3d& load,
                                        bool first_order);

}  // namespace flexura

#include "flexura/assembly/system.hpp"

namespace flexura {

std::array<Jet2<6>, 2> System::gaps_of(std::size_t joint, const std::vector<double>& z) const {
  const SystemLayout::Joint& j = layout_.joints[joint];
  const Pose a = pose(j.base, z);
  const Pose b = pose(j.action, z);
  return layout_.linearised ? linearised_joint_gaps(layout_, j, a, b)
                            : joint_gaps(layout_, j, a, b);
}

void System::add_joint(std::size_t i, const std::vector<double>& z) {
  const SystemLayout::Joint& joint = layout_.joints[i];
  const BodyIndex& a = bodies_[joint.base];
  const BodyIndex& b = bodies_[joint.action];
  const int unknowns[6] = {a.position, a.position < 0 ? -1 : a.position + 1, a.rotation,
                           b.position, b.position < 0 ? -1 : b.position + 1, b.rotation};
  const auto gaps = gaps_of(i, z);
  for (std::size_t c = 0; c < 2; ++c) {
    const Jet2<6>& gap = gaps[c];
    const auto row = static_cast<Eigen::Index>(joint_index(i) + c);
    const double force = z[joint_index(i) + c];
    residual_[row] -= gap.value;
    for (std::size_t j = 0; j < 6; ++j) {
      if (unknowns[j] < 0) continue;
      residual_[unknowns[j]] -= force * gap.gradient[j];
      tangent_(row, unknowns[j]) -= gap.gradient[j];
      tangent_(unknowns[j], row) -= gap.gradient[j];
      for (std::size_t k = 0; k < 6; ++k)
        if (unknowns[k] >= 0) tangent_(unknowns[j], unknowns[k]) -= force * gap.second(j, k);
    }
  }
}

/// What the joints on a body take from it.
Eigen::Vector3d System::joint_reaction(std::size_t body, const std::vector<double>& z) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < layout_.joints.size(); ++i) {
    const SystemLayout::Joint& joint = layout_.joints[i];
    if (joint.base != body && joint.action != body) continue;
    const auto gaps = gaps_of(i, z);
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t j = 0; j < 3; ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const double force = z[joint_index(i) + c];
        if (joint.base == body) sum[row] -= force * gaps[c].gradient[j];
        if (joint.action == body) sum[row] -= force * gaps[c].gradient[3 + j];
      }
  }
  return sum;
}

}  // namespace flexura

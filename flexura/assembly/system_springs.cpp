#include "flexura/assembly/spring_potential.hpp"
#include "flexura/assembly/system.hpp"

namespace flexura {

Jet2<6> System::spring_length(const SystemLayout::Spring& spring,
                              const std::vector<double>& z) const {
  return flexura::spring_length(layout_, spring, pose(spring.base, z), pose(spring.action, z));
}

Jet2<6> System::spring_potential(const SystemLayout::Spring& spring,
                                 const std::vector<double>& z) const {
  return flexura::spring_potential(layout_, spring, pose(spring.base, z), pose(spring.action, z),
                                   assembly_);
}

void System::add_spring(const SystemLayout::Spring& spring, const std::vector<double>& z) {
  const Jet2<6> energy = spring_potential(spring, z);
  strain_energy_ += energy.value;
  const BodyIndex& a = bodies_[spring.base];
  const BodyIndex& b = bodies_[spring.action];
  const int unknowns[6] = {a.position, a.position < 0 ? -1 : a.position + 1, a.rotation,
                           b.position, b.position < 0 ? -1 : b.position + 1, b.rotation};
  const bool grows = assembling_ && spring.misfit != 0.0;
  const Jet2<6> length = grows ? spring_length(spring, z) : Jet2<6>{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (unknowns[i] < 0) continue;
    residual_[unknowns[i]] += energy.gradient[i];
    load_vector_[unknowns[i]] += spring.stiffness * spring.misfit * length.gradient[i];
    for (std::size_t j = 0; j < 6; ++j)
      if (unknowns[j] >= 0) tangent_(unknowns[i], unknowns[j]) += energy.second(i, j);
  }
}

Eigen::Vector3d System::spring_reaction(std::size_t body, const std::vector<double>& z) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SystemLayout::Spring& spring : layout_.springs) {
    if (spring.base != body && spring.action != body) continue;
    const auto force = spring_potential(spring, z).gradient;
    if (spring.base == body) sum += Eigen::Vector3d(force[0], force[1], force[2]);
    if (spring.action == body) sum += Eigen::Vector3d(force[3], force[4], force[5]);
  }
  return sum;
}

}  // namespace flexura

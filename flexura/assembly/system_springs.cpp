#include "flexura/assembly/spring.hpp"
#include "flexura/assembly/system.hpp"
#include "flexura/core/jet2.hpp"

namespace flexura {

/// Length (or turn) by the six unknowns x, y and rotation of both bodies. To first order in the
/// kinematics, the length is along the line as drawn.
Jet2<6> System::spring_length(const SystemLayout::Spring& spring,
                              const std::vector<double>& z) const {
  if (spring.torsional)
    return Jet2<6>::variable(5, pose(spring.action, z).rotation) -
           Jet2<6>::variable(2, pose(spring.base, z).rotation);
  const SpringVector v = spring_vector(spring, z);
  if (!layout_.linearised) return sqrt(v.x * v.x + v.y * v.y);
  const Vec2 drawn = layout_.bodies[spring.action].centre + spring.action_arm -
                     layout_.bodies[spring.base].centre - spring.base_arm;
  const Vec2 along = (1.0 / norm(drawn)) * drawn;
  return v.x * along.x + v.y * along.y;
}

/// From one point to the other.
auto System::spring_vector(const SystemLayout::Spring& spring, const std::vector<double>& z) const
    -> SpringVector {
  using Jet = Jet2<6>;
  const Pose a = pose(spring.base, z);
  const Pose b = pose(spring.action, z);
  const Jet turn_a = Jet::variable(2, a.rotation);
  const Jet turn_b = Jet::variable(5, b.rotation);
  // Positions count from the base body's drawn centre: differences of small numbers stay exact.
  const Vec2 origin = layout_.bodies[spring.base].centre;
  const Jet dx =
      Jet::variable(3, b.position.x - origin.x) - Jet::variable(0, a.position.x - origin.x);
  const Jet dy =
      Jet::variable(4, b.position.y - origin.y) - Jet::variable(1, a.position.y - origin.y);
  const Vec2 ra = spring.base_arm;
  const Vec2 rb = spring.action_arm;
  if (layout_.linearised)
    return {dx - turn_b * rb.y + turn_a * ra.y + (rb.x - ra.x),
            dy + turn_b * rb.x - turn_a * ra.x + (rb.y - ra.y)};
  return {dx + cos(turn_b) * rb.x - sin(turn_b) * rb.y - cos(turn_a) * ra.x + sin(turn_a) * ra.y,
          dy + sin(turn_b) * rb.x + cos(turn_b) * rb.y - sin(turn_a) * ra.x - cos(turn_a) * ra.y};
}

Jet2<6> System::spring_potential(const SystemLayout::Spring& spring,
                                 const std::vector<double>& z) const {
  const double free = spring.free - (1.0 - assembly_) * spring.misfit;
  if (spring.torsional)
    return torsion_spring_energy(spring_length(spring, z), spring.stiffness, free);
  if (layout_.linearised && free != 0.0) {
    const Jet2<6> elongation = spring_length(spring, z) - free;
    return (0.5 * spring.stiffness) * (elongation * elongation);
  }
  const SpringVector v = spring_vector(spring, z);
  return spring_energy(v.x, v.y, spring.stiffness, free);
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

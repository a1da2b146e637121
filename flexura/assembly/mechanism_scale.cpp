#include "flexura/assembly/mechanism_scale.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

MechanismScale scale_without_flexures(const SystemLayout& layout) {
  MechanismScale scale{0.0, 1.0};
  for (const auto& body : layout.bodies)
    scale.length = std::max(scale.length, norm(body.centre - layout.bodies.front().centre));
  if (scale.length == 0.0) scale.length = 1.0;
  double energies = 0.0, count = 0.0;
  for (const auto& spring : layout.springs) {
    if (!(spring.stiffness > 0.0)) continue;
    const double square = spring.torsional ? 1.0 : scale.length * scale.length;
    energies += std::log(spring.stiffness * square);
    count += 1.0;
  }
  if (count > 0.0) scale.energy = std::exp(energies / count);
  return scale;
}

}  // namespace

MechanismScale scale_of(const SystemLayout& layout) {
  if (layout.members.empty()) return scale_without_flexures(layout);
  const auto count = static_cast<double>(layout.members.size());
  MechanismScale scale{0.0, 0.0};
  double energies = 0.0;
  for (const auto& member : layout.members) {
    scale.length += member.length / count;
    energies += std::log(member.bending_stiffness / member.length) / count;
  }
  scale.energy = std::exp(energies);
  return scale;
}

}  // namespace flexura

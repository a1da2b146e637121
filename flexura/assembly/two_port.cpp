#include "flexura/assembly/two_port.hpp"

#include <algorithm>

namespace flexura {

std::vector<Vec2> TwoPort::drawn_axis(std::span<const SectionState> sections,
                                      std::span<const double> /*internal*/) const {
  std::vector<Vec2> axis;
  for (const SectionState& section : sections) axis.push_back(section.pose.position);
  return axis;
}

void TwoPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  std::copy(internal.begin(), internal.end(), refined.begin());
}

}  // namespace flexura

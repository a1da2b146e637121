#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// A section quantity where its absolute value is largest.
struct Extreme {
  double value = 0.0;  ///< with its sign
  std::size_t flexure = 0;
  double s = 0.0;  ///< arc length of the undeformed axis from the base end
};

/// Over the stations of all flexures at the last state of a ModelingPath or a ModelingMotion, the
/// first of equals; absent without any.
template <class Modeling>
std::optional<Extreme> find_extreme(const Modeling& modeling, double MemberStation::*quantity) {
  std::optional<Extreme> extreme;
  for (std::size_t f = 0; f < modeling.members.size(); ++f)
    for (const MemberStation& station : modeling.members[f]) {
      const double value = station.*quantity;
      if (!extreme || std::abs(value) > std::abs(extreme->value))
        extreme = Extreme{value, f, station.s};
    }
  return extreme;
}

}  // namespace flexura

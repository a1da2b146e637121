#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flexura/pictures/parts.hpp"

namespace flexura::pictures {
namespace {

/// Curvature at the inner points of a line: the turn from one chord to the next over half of both.
std::vector<double> curvatures(const std::vector<Vec2>& axis) {
  std::vector<double> values(axis.size(), 0.0);
  for (std::size_t k = 1; k + 1 < axis.size(); ++k) {
    const Vec2 before = axis[k] - axis[k - 1];
    const Vec2 after = axis[k + 1] - axis[k];
    const double length = 0.5 * (norm(before) + norm(after));
    if (length > 0.0) values[k] = std::atan2(cross(before, after), dot(before, after)) / length;
  }
  return values;
}

}  // namespace

std::vector<double> bending_strains(const DrawnFlexure& flexure, const std::vector<Vec2>& axis,
                                    const std::vector<Vec2>& ghost) {
  std::vector<double> strains = curvatures(axis);
  if (axis.size() != ghost.size() || axis.size() < 4) return std::vector(axis.size(), 0.0);
  const std::vector<double> start = curvatures(ghost);
  for (std::size_t k = 0; k < strains.size(); ++k) {
    double depth = flexure.depth;
    if (!flexure.depths.empty())
      depth = flexure.depths[k * (flexure.depths.size() - 1) / (strains.size() - 1)];
    strains[k] = 0.5 * depth * (strains[k] - start[k]);
  }
  // The ends have one chord only.
  const std::size_t last = strains.size() - 1;
  strains[0] = 2.0 * strains[1] - strains[2];
  strains[last] = 2.0 * strains[last - 1] - strains[last - 2];
  if (flexure.pinned_base) strains[0] = 0.0;
  if (flexure.pinned_action) strains[last] = 0.0;
  for (double& strain : strains) strain = std::abs(strain);
  return strains;
}

std::string heat_colour(double share) {
  struct Colour {
    double red, green, blue;
  };
  constexpr std::array<Colour, 5> stops = {Colour{2.2, 5.2, 9.6},
                                           {2.0, 9.6, 9.4},
                                           {13.4, 10.6, 2.4},
                                           {14.4, 6.8, 1.6},
                                           {12.4, 1.6, 2.0}};
  const double level = std::round(std::clamp(share, 0.0, 1.0) * heat_levels) / heat_levels;
  const double at = level * (stops.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double t = at - static_cast<double>(k);
  const auto digit = [&](double Colour::*part) {
    return static_cast<int>(std::lround((1.0 - t) * stops[k].*part + t * stops[k + 1].*part));
  };
  return fmt::format("#{:x}{:x}{:x}", digit(&Colour::red), digit(&Colour::green),
                     digit(&Colour::blue));
}

}  // namespace flexura::pictures

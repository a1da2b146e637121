#include "flexura/geometry/section.hpp"

#include <cmath>
#include <numbers>

namespace flexura {
namespace {

SectionProperties properties(const RectangleSection& r) {
  const double area = r.thickness * r.width;
  return {area, area * r.thickness * r.thickness / 12.0, 5.0 / 6.0 * area, r.thickness};
}

SectionProperties properties(const CircleSection& c) {
  const double d2 = c.diameter * c.diameter;
  const double area = std::numbers::pi / 4.0 * d2;
  return {area, std::numbers::pi / 64.0 * d2 * d2, 0.9 * area, c.diameter};
}

SectionProperties properties(const GeneralSection& g) {
  return {g.area, g.second_moment, g.shear_area.value_or(5.0 / 6.0 * g.area),
          g.depth.value_or(std::sqrt(12.0 * g.second_moment / g.area))};
}

}  // namespace

SectionProperties section_properties(const Section& section) {
  return std::visit([](const auto& s) { return properties(s); }, section);
}

}  // namespace flexura

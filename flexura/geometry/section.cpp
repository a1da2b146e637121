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

SectionProperties section_properties(const Section& section, double s, double length) {
  Section local = section;
  if (auto* r = std::get_if<RectangleSection>(&local))
    r->thickness = profile_height(r->profile, r->thickness, s, length);
  if (auto* c = std::get_if<CircleSection>(&local))
    c->diameter = profile_height(c->profile, c->diameter, s, length);
  return section_properties(local);
}

const Profile* varying_profile(const Section& section) {
  const Profile* profile = nullptr;
  if (const auto* r = std::get_if<RectangleSection>(&section)) profile = &r->profile;
  if (const auto* c = std::get_if<CircleSection>(&section)) profile = &c->profile;
  return profile && !std::holds_alternative<LeafProfile>(*profile) ? profile : nullptr;
}

}  // namespace flexura

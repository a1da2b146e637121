#include "flexura/geometry/section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexura {
namespace {

SectionProperties properties(const RectangleSection& r) {
  const double area = r.thickness * r.width;
  const double second_moment = area * r.thickness * r.thickness / 12.0;
  return {area, second_moment, 5.0 / 6.0 * area, r.thickness, second_moment};
}

SectionProperties properties(const CircleSection& c) {
  const double d2 = c.diameter * c.diameter;
  const double area = std::numbers::pi / 4.0 * d2;
  const double second_moment = std::numbers::pi / 64.0 * d2 * d2;
  return {area, second_moment, 0.9 * area, c.diameter, second_moment};
}

SectionProperties properties(const GeneralSection& g) {
  return {g.area, g.second_moment, g.shear_area.value_or(5.0 / 6.0 * g.area),
          g.depth.value_or(std::sqrt(12.0 * g.second_moment / g.area)),
          g.rotary_second_moment.value_or(g.second_moment)};
}

}  // namespace

SectionProperties section_properties(const Section& section) {
  return std::visit([](const auto& s) { return properties(s); }, section);
}

SectionProperties section_properties(const Section& section, double s, double length) {
  Section local = section;
  if (auto* r = std::get_if<RectangleSection>(&local)) {
    r->thickness = profile_size(r->profile, r->thickness, s, length);
    r->width = profile_size(r->width_profile, r->width, s, length);
  }
  if (auto* c = std::get_if<CircleSection>(&local))
    c->diameter = profile_size(c->profile, c->diameter, s, length);
  return section_properties(local);
}

std::vector<const Profile*> varying_profiles(const Section& section) {
  std::vector<const Profile*> profiles;
  if (const auto* r = std::get_if<RectangleSection>(&section))
    profiles = {&r->profile, &r->width_profile};
  if (const auto* c = std::get_if<CircleSection>(&section)) profiles = {&c->profile};
  std::erase_if(profiles, [](const Profile* p) { return std::holds_alternative<LeafProfile>(*p); });
  return profiles;
}

bool section_varies(const Section& section) { return !varying_profiles(section).empty(); }

std::vector<double> section_breaks(const Section& section, double length) {
  std::vector<double> all{0.0, length};
  for (const Profile* profile : varying_profiles(section)) {
    const std::vector<double> own = profile_breaks(*profile, length);
    all.insert(all.end(), own.begin(), own.end());
  }
  std::sort(all.begin(), all.end());
  const double same = 1e-12 * length;  // two profiles may break at one place, but for rounding
  std::vector<double> breaks{0.0};
  for (const double s : all)
    if (s > breaks.back() + same && s < length - same) breaks.push_back(s);
  breaks.push_back(length);
  return breaks;
}

}  // namespace flexura

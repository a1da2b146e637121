#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// The profiles of a section with the keys they stand under.
std::vector<std::pair<KeyPath, const Profile*>> stated_profiles(const NamedSection& section) {
  const KeyPath path = {"sections", section.name};
  if (const auto* r = std::get_if<RectangleSection>(&section.shape))
    return {{path / "rectangle" / "profile", &r->profile},
            {path / "rectangle" / "width_profile", &r->width_profile}};
  if (const auto* c = std::get_if<CircleSection>(&section.shape))
    return {{path / "circle" / "profile", &c->profile}};
  return {};
}

struct ProfileRules {
  const KeyPath path;
  Mistakes& mistakes;

  void operator()(const LeafProfile&) const {}
  void operator()(const TaperProfile& taper) const {
    mistakes.require_positive(path / "taper" / "end", taper.end);
  }
  void operator()(const PiecewiseProfile& table) const {
    const KeyPath here = path / "piecewise";
    if (table.points.size() < 2) {
      mistakes.add(here, fmt::format("needs two points or more, has {}", table.points.size()));
      return;
    }
    if (table.points.front().x != 0.0 || table.points.back().x != 1.0)
      mistakes.add(here, "must begin at 0 and end at 1, the ends of the flexure");
    for (std::size_t k = 0; k < table.points.size(); ++k) {
      mistakes.require_positive(here / k / std::size_t{1}, table.points[k].y);
      if (k > 0 && !(table.points[k].x > table.points[k - 1].x))
        mistakes.add(here / k, "must lie beyond the point before it");
    }
  }
  void operator()(const NotchProfile& notch) const {
    if (notch.stated_by_radius) {
      mistakes.require_positive(path / "circular" / "radius", notch.a);
      return;
    }
    mistakes.require_positive(path / "elliptic" / "a", notch.a);
    mistakes.require_positive(path / "elliptic" / "b", notch.b);
  }
  void operator()(const FilletProfile& fillet) const {
    mistakes.require_positive(path / "corner_filleted" / "radius", fillet.radius);
  }
};

/// How much of a flexure's length a profile takes, if it takes any.
double length_needed(const Profile& profile) {
  if (const auto* notch = std::get_if<NotchProfile>(&profile)) return 2.0 * notch->a;
  if (const auto* fillet = std::get_if<FilletProfile>(&profile)) return 2.0 * fillet->radius;
  return 0.0;
}

void check_room(const Model& model, const Flexure& flexure, Mistakes& mistakes) {
  if (flexure.section >= model.sections.size()) return;
  const NamedSection& section = model.sections[flexure.section];
  double needed = 0.0;
  for (const Profile* profile : varying_profiles(section.shape))
    needed = std::max(needed, length_needed(*profile));
  if (!(needed > 0.0) || !has_length(flexure.axis)) return;
  const double length = AxisCurve(flexure.axis).length();
  if (needed > length * (1.0 + 1e-9))
    mistakes.add(KeyPath{"flexures", flexure.name} / "section",
                 fmt::format("the profile of '{}' takes a length of {}, the flexure has {}",
                             section.name, needed, length));
}

}  // namespace

bool has_length(const AxisShape& axis) {
  const auto* line = std::get_if<LineAxis>(&axis);
  const auto* arc = std::get_if<ArcAxis>(&axis);
  const auto* spline = std::get_if<SplineAxis>(&axis);
  return (line && norm(line->end - line->start) > 0.0) ||
         (arc && arc->radius > 0.0 && arc->sweep != 0.0) || (spline && spline->points.size() >= 2);
}

void check_profiles(const Model& model, Mistakes& mistakes) {
  for (const NamedSection& section : model.sections)
    for (const auto& [path, profile] : stated_profiles(section))
      std::visit(ProfileRules{path, mistakes}, *profile);
  for (const Flexure& flexure : model.flexures) check_room(model, flexure, mistakes);
}

}  // namespace flexura

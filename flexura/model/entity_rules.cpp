#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

void check_material(const Material& material, Mistakes& mistakes) {
  const KeyPath path = {"materials", material.name};
  mistakes.require_positive(path / "youngs_modulus", material.youngs_modulus);
  const double nu = material.poissons_ratio;
  if (!(nu > -1.0 && nu <= 0.5)) {
    mistakes.add(path / "poissons_ratio",
                 fmt::format("must be greater than -1 and at most 0.5, is {}", nu));
  }
  if (material.density) mistakes.require_positive(path / "density", *material.density);
  if (material.thermal_expansion)
    mistakes.require_finite(path / "thermal_expansion", *material.thermal_expansion);
  if (material.strength) mistakes.require_positive(path / "strength", *material.strength);
}

struct SectionRules {
  const KeyPath path;
  Mistakes& mistakes;

  void operator()(const RectangleSection& r) const {
    mistakes.require_positive(path / "rectangle" / "thickness", r.thickness);
    mistakes.require_positive(path / "rectangle" / "width", r.width);
  }
  void operator()(const CircleSection& c) const {
    mistakes.require_positive(path / "circle" / "diameter", c.diameter);
  }
  void operator()(const GeneralSection& g) const {
    mistakes.require_positive(path / "general" / "area", g.area);
    mistakes.require_positive(path / "general" / "second_moment", g.second_moment);
    if (g.shear_area) mistakes.require_positive(path / "general" / "shear_area", *g.shear_area);
    if (g.depth) mistakes.require_positive(path / "general" / "depth", *g.depth);
    if (g.rotary_second_moment)
      mistakes.require_positive(path / "general" / "rotary_second_moment", *g.rotary_second_moment);
  }
};

void check_body(const Body& body, Mistakes& mistakes) {
  const KeyPath path = {"bodies", body.name};
  for (const Point& point : body.points) {
    mistakes.require_finite(path / "points" / point.name, point.position);
  }
  if (body.centre) mistakes.require_finite(path / "centre", *body.centre);
  mistakes.require_not_negative(path / "mass", body.mass);
  mistakes.require_not_negative(path / "inertia", body.inertia);
  if (body.free && body.fixed)
    mistakes.add(path / "free", "this body is fixed: it cannot be free as well");
}

/// Two places that only rounding tells apart.
bool coincide(Vec2 a, Vec2 b) {
  constexpr double rounding = 1e-12;
  return norm(a - b) <= rounding * std::max(norm(a), norm(b));
}

struct AxisRules {
  const KeyPath path;
  Mistakes& mistakes;

  void operator()(const LineAxis& line) const {
    mistakes.require_finite(path / "line" / std::size_t{0}, line.start);
    mistakes.require_finite(path / "line" / std::size_t{1}, line.end);
    if (coincide(line.start, line.end)) {
      mistakes.add(path / "line", fmt::format("the axis has no length: it begins and ends at "
                                              "[{}, {}]",
                                              line.start.x, line.start.y));
    }
  }

  void operator()(const ArcAxis& arc) const {
    mistakes.require_finite(path / "arc" / "centre", arc.centre);
    mistakes.require_positive(path / "arc" / "radius", arc.radius);
    check_angle(path / "arc" / "start", arc.start, 2.0);
    check_angle(path / "arc" / "sweep", arc.sweep, 1.0);
    if (arc.sweep == 0.0) mistakes.add(path / "arc" / "sweep", "must not be 0");
  }

  void operator()(const SplineAxis& spline) const {
    if (spline.points.size() < 2) {
      mistakes.add(path / "spline",
                   fmt::format("a spline needs two points or more, has {}", spline.points.size()));
    }
    for (std::size_t i = 0; i < spline.points.size(); ++i) {
      mistakes.require_finite(path / "spline" / i, spline.points[i]);
      if (i > 0 && coincide(spline.points[i - 1], spline.points[i])) {
        mistakes.add(path / "spline" / i,
                     fmt::format("coincides with the point before it, [{}, {}]", spline.points[i].x,
                                 spline.points[i].y));
      }
    }
    check_tangent(path / "start_tangent", spline.start_tangent);
    check_tangent(path / "end_tangent", spline.end_tangent);
  }

 private:
  /// Larger angles are degrees that lack their unit.
  void check_angle(const KeyPath& angle_path, double angle, double most_turns) const {
    const double most = 2.0 * std::numbers::pi * most_turns * (1.0 + 1e-9);
    if (!(std::abs(angle) <= most)) {
      mistakes.add(angle_path, fmt::format("{} rad is more than {}; if degrees are meant, write "
                                           "them with their unit, e.g. \"-240 deg\"",
                                           angle, most_turns > 1.0 ? "two turns" : "a full turn"));
    }
  }

  void check_tangent(const KeyPath& tangent_path, const std::optional<Vec2>& tangent) const {
    if (!tangent) return;
    mistakes.require_finite(tangent_path, *tangent);
    if (norm(*tangent) == 0.0) mistakes.add(tangent_path, "must have a direction, is [0, 0]");
  }
};

void check_link(const MeshLink& link, const KeyPath& path, Mistakes& mistakes) {
  mistakes.require_positive(path / "depth", link.depth);
  if (const auto fault = find_mesh_fault(link)) mistakes.add(path / "file", *fault);
}

void check_flexure(const Model& model, const Flexure& flexure, Mistakes& mistakes) {
  const KeyPath path = {"flexures", flexure.name};
  const auto check_index = [&](const char* key, std::size_t index, std::size_t size) {
    if (index >= size) mistakes.add(path / key, fmt::format("there is no number {}", index));
  };
  check_index("between", flexure.base, model.bodies.size());
  check_index("between", flexure.action, model.bodies.size());
  check_index("material", flexure.material, model.materials.size());
  if (!flexure.link) check_index("section", flexure.section, model.sections.size());
  if (flexure.base == flexure.action && flexure.base < model.bodies.size()) {
    mistakes.add(path / "between",
                 fmt::format("a flexure joins two different bodies, here both are '{}'",
                             model.bodies[flexure.base].name));
  }
  if (flexure.link)
    check_link(*flexure.link, path / "mesh", mistakes);
  else
    std::visit(AxisRules{path / "axis", mistakes}, flexure.axis);
  mistakes.require_finite(path / "misfit", flexure.misfit);
  mistakes.require_finite(path / "misfit_rotation", flexure.misfit_rotation);
  if (flexure.pinned_action && flexure.misfit_rotation != 0.0)
    mistakes.add(path / "misfit_rotation",
                 "this end is hinged: it fits at any rotation. A hinged end that does not come to "
                 "its place has a misfit");
}

}  // namespace

void check_entities(const Model& model, Mistakes& mistakes) {
  for (const Material& material : model.materials) check_material(material, mistakes);
  for (const NamedSection& section : model.sections) {
    std::visit(SectionRules{{"sections", section.name}, mistakes}, section.shape);
  }
  check_profiles(model, mistakes);
  for (const Body& body : model.bodies) check_body(body, mistakes);
  for (const Flexure& flexure : model.flexures) check_flexure(model, flexure, mistakes);
}

}  // namespace flexura

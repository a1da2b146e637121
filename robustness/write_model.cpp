#include <fmt/format.h>

#include "robustness/random_mechanism.hpp"

namespace flexura::robustness {
namespace {

std::string vector(Vec2 v) { return fmt::format("[{:.17g}, {:.17g}]", v.x, v.y); }

std::string axis_text(const AxisShape& axis) {
  if (const auto* line = std::get_if<LineAxis>(&axis))
    return fmt::format("line = [{}, {}]", vector(line->start), vector(line->end));
  if (const auto* arc = std::get_if<ArcAxis>(&axis))
    return fmt::format(
        "arc = {{ centre = {}, radius = {:.17g}, start = {:.17g}, sweep = {:.17g} }}",
        vector(arc->centre), arc->radius, arc->start, arc->sweep);
  std::string points;
  for (const Vec2& point : std::get<SplineAxis>(axis).points)
    points += (points.empty() ? "" : ", ") + vector(point);
  return fmt::format("spline = [{}]", points);
}

std::string section_text(const Section& section) {
  if (const auto* circle = std::get_if<CircleSection>(&section))
    return fmt::format("circle = {{ diameter = {:.17g} }}", circle->diameter);
  const auto& rectangle = std::get<RectangleSection>(section);
  std::string profile;
  if (const auto* taper = std::get_if<TaperProfile>(&rectangle.profile))
    profile = fmt::format(", profile = {{ taper = {{ end = {:.17g} }} }}", taper->end);
  return fmt::format("rectangle = {{ thickness = {:.17g}, width = {:.17g}{} }}",
                     rectangle.thickness, rectangle.width, profile);
}

std::string body_text(const Body& body) {
  std::string text = fmt::format("[bodies.{}]\n", body.name);
  if (body.fixed) text += "fixed = true\n";
  for (const Point& point : body.points)
    text += fmt::format("points = {{ {} = {} }}\n", point.name, vector(point.position));
  return text;
}

std::string flexure_text(const Model& model, const Flexure& flexure) {
  const std::string& base = model.bodies[flexure.base].name;
  std::string text = fmt::format("[flexures.{}]\nbetween = [\"{}\", \"{}\"]\n", flexure.name, base,
                                 model.bodies[flexure.action].name);
  if (flexure.pinned_base) text += fmt::format("pinned = [\"{}\"]\n", base);
  return text + fmt::format("axis = {{ {} }}\nmaterial = \"{}\"\nsection = \"{}\"\n",
                            axis_text(flexure.axis), model.materials[flexure.material].name,
                            model.sections[flexure.section].name);
}

std::string load_text(const Model& model, const Load& load) {
  const Body& body = model.bodies[load.body];
  std::string text = fmt::format("  {{ on = \"{}{}\", force = {}, moment = {:.17g}", body.name,
                                 load.point ? "." + body.points[*load.point].name : std::string(),
                                 vector(load.force), load.moment);
  if (load.follower) text += ", follower = true";
  return text + " },\n";
}

}  // namespace

std::string write_model(const RandomMechanism& mechanism) {
  const Model& model = mechanism.model;
  std::string text = fmt::format(
      "flexura = 1\ntitle = \"{}\"\n\n[units]\nlength = \"{}\"\nforce = \"{}\"\ntime = \"{}\"\n\n",
      model.title, model.units.length, model.units.force, model.units.time);
  for (const Material& material : model.materials)
    text += fmt::format("[materials.{}]\nyoungs_modulus = {:.17g}\npoissons_ratio = {:.17g}\n\n",
                        material.name, material.youngs_modulus, material.poissons_ratio);
  for (const NamedSection& section : model.sections)
    text += fmt::format("[sections.{}]\n{}\n\n", section.name, section_text(section.shape));
  for (const Body& body : model.bodies) text += body_text(body) + "\n";
  for (const Flexure& flexure : model.flexures) text += flexure_text(model, flexure) + "\n";
  const auto& study = std::get<PathStudy>(model.studies.front().kind);
  text += fmt::format("[studies.{}]\nkind = \"path\"\nloads = [\n", model.studies.front().name);
  for (const Load& load : study.loads) text += load_text(model, load);
  return text + fmt::format("]\nsteps = {}\nmodelings = [\"exact\"]\n", study.steps);
}

}  // namespace flexura::robustness

#include "flexura/io/read_entities.hpp"

#include <fmt/format.h>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

Profile read_profile(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::profile());
  const auto kind = table.exactly_one_of(vocabulary::profile().keys);
  if (!kind) return LeafProfile{};
  const Place inside = *table.find(*kind);
  if (*kind == "piecewise") {
    PiecewiseProfile piecewise;
    for (const Place& point : read_list(reading, inside, "points [share of the length, factor]"))
      piecewise.points.push_back(read_vector(reading, point, dimensions::number).value_or(Vec2{}));
    return piecewise;
  }
  if (*kind == "taper") {
    TableReader taper(reading, inside, vocabulary::taper());
    return TaperProfile{taper.required_quantity("end", dimensions::length)};
  }
  if (*kind == "elliptic") {
    TableReader notch(reading, inside, vocabulary::elliptic());
    return NotchProfile{notch.required_quantity("a", dimensions::length),
                        notch.required_quantity("b", dimensions::length)};
  }
  if (*kind == "leaf") {
    TableReader leaf(reading, inside, vocabulary::no_keys());
    return LeafProfile{};
  }
  TableReader round(reading, inside, vocabulary::round());
  const double radius = round.required_quantity("radius", dimensions::length);
  if (*kind == "circular") return NotchProfile{radius, radius, true};
  return FilletProfile{radius};
}

Profile read_optional_profile(Reading& reading, const TableReader& table, const std::string& key) {
  const auto place = table.find(key);
  return place ? read_profile(reading, *place) : LeafProfile{};
}

Section read_section(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::section());
  const auto shape = table.exactly_one_of(vocabulary::section().keys);
  if (!shape) return {};
  const Place shape_place = *table.find(*shape);
  if (*shape == "rectangle") {
    TableReader rectangle(reading, shape_place, vocabulary::rectangle());
    return RectangleSection{rectangle.required_quantity("thickness", dimensions::length),
                            rectangle.required_quantity("width", dimensions::length),
                            read_optional_profile(reading, rectangle, "profile"),
                            read_optional_profile(reading, rectangle, "width_profile")};
  }
  if (*shape == "circle") {
    TableReader circle(reading, shape_place, vocabulary::circle());
    return CircleSection{circle.required_quantity("diameter", dimensions::length),
                         read_optional_profile(reading, circle, "profile")};
  }
  TableReader general(reading, shape_place, vocabulary::general());
  return GeneralSection{
      general.required_quantity("area", dimensions::area),
      general.required_quantity("second_moment", dimensions::second_moment),
      general.optional_quantity("shear_area", dimensions::area),
      general.optional_quantity("depth", dimensions::length),
      general.optional_quantity("rotary_second_moment", dimensions::second_moment)};
}

}  // namespace

std::vector<Material> read_materials(Reading& reading, const Place& place) {
  std::vector<Material> materials;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::material());
    Material material;
    material.name = entry.name;
    material.source = entry.position;
    material.youngs_modulus = table.required_quantity("youngs_modulus", dimensions::stress);
    material.poissons_ratio = table.required_quantity("poissons_ratio", dimensions::number);
    material.density = table.optional_quantity("density", dimensions::density);
    material.strength = table.optional_quantity("strength", dimensions::stress);
    material.thermal_expansion = table.optional_quantity("thermal_expansion", dimensions::number);
    materials.push_back(std::move(material));
  }
  return materials;
}

std::vector<NamedSection> read_sections(Reading& reading, const Place& place) {
  std::vector<NamedSection> sections;
  for (const NamedPlace& entry : read_names(reading, place)) {
    sections.push_back({entry.name, read_section(reading, entry.place), entry.position});
  }
  return sections;
}

std::vector<Body> read_bodies(Reading& reading, const Place& place) {
  std::vector<Body> bodies;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::body());
    Body body;
    body.name = entry.name;
    body.source = entry.position;
    body.fixed = table.boolean("fixed", false);
    body.free = table.boolean("free", false);
    if (const auto points = table.find("points")) {
      for (const NamedPlace& point : read_names(reading, *points)) {
        const auto position = read_vector(reading, point.place, dimensions::length);
        body.points.push_back({point.name, position.value_or(Vec2{})});
      }
    }
    if (table.has("centre")) body.centre = table.vector("centre", dimensions::length, {});
    body.mass = table.quantity("mass", dimensions::mass, 0.0);
    body.inertia = table.quantity("inertia", dimensions::inertia, 0.0);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::size_t NameIndex::resolve(Reading& reading, const Place& place,
                               const std::string& name) const {
  if (const auto at = index_.find(name); at != index_.end()) return at->second;
  if (complete_) {
    const std::string hint = names_.empty() ? "; there is none" : suggestion(name, names_);
    reading.report(place.path, place.node->position,
                   fmt::format("unknown {} '{}'{}{}", what_, name, where_, hint));
  } else {
    reading.spoil(place.path);
  }
  return none;
}

}  // namespace flexura

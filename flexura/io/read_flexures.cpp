#include <fmt/format.h>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/read_entities.hpp"
#include "flexura/io/read_link.hpp"
#include "flexura/io/read_outline.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

std::vector<Vec2> read_points(Reading& reading, const Place& place) {
  std::vector<Vec2> points;
  for (const Place& point : read_list(reading, place, "points [x, y]")) {
    points.push_back(read_vector(reading, point, dimensions::length).value_or(Vec2{}));
  }
  return points;
}

AxisShape read_line(Reading& reading, const Place& place) {
  const TomlNode::Array* ends = place.node->array();
  if (!ends || ends->size() != 2) {
    report_unexpected(reading, place, "two ends [[x0, y0], [x1, y1]]");
    return LineAxis{};
  }
  const std::vector<Vec2> points = read_points(reading, place);
  return LineAxis{points[0], points[1]};
}

AxisShape read_arc(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::arc());
  ArcAxis arc;
  table.require("centre");
  arc.centre = table.vector("centre", dimensions::length, {});
  arc.radius = table.required_quantity("radius", dimensions::length);
  arc.start = table.required_quantity("start", dimensions::angle);
  arc.sweep = table.required_quantity("sweep", dimensions::angle);
  return arc;
}

/// `pinned` repeats one or both of the names in `between`.
void read_pinned(Reading& reading, const Place& place, const std::vector<std::string>& between,
                 Flexure& flexure) {
  for (const Place& name_place : read_list(reading, place, "the flexure's bodies")) {
    const auto name = read_text(reading, name_place);
    if (!name || between.size() != 2) continue;
    if (*name != between[0] && *name != between[1]) {
      reading.report(
          name_place.path, name_place.node->position,
          fmt::format("the flexure does not join '{}'{}", *name, suggestion(*name, between)));
      continue;
    }
    bool& pinned = *name == between[0] ? flexure.pinned_base : flexure.pinned_action;
    if (pinned) {
      reading.report(name_place.path, name_place.node->position,
                     fmt::format("'{}' is named twice", *name));
    }
    pinned = true;
  }
}

std::vector<std::string> texts_in(const TomlNode& node) {
  std::vector<std::string> texts;
  if (const TomlNode::Array* elements = node.array()) {
    for (const TomlNode& element : *elements) {
      if (const std::string* text = element.string()) texts.push_back(*text);
    }
  }
  return texts;
}

std::size_t read_reference(Reading& reading, TableReader& table, const char* key,
                           const NameIndex& index) {
  const auto place = table.require(key);
  if (!place) return NameIndex::none;
  const auto name = read_text(reading, *place);
  return name ? index.resolve(reading, *place, *name) : NameIndex::none;
}

bool is_link(const TableReader& table) { return table.has("mesh") || table.has("outline"); }

/// A `mesh` or an `outline`. Without one after a mistake the flexure stays a strip, which no rule
/// looks at.
void read_link(Reading& reading, TableReader& table, Flexure& flexure) {
  for (const char* key : {"axis", "section"})
    if (table.has(key))
      reading.report_key(table.path(), key, table.position(key),
                         "a flexure is a mesh or an outline, or has an axis and a section");
  if (table.has("mesh") && table.has("outline"))
    reading.report_key(table.path(), "outline", table.position("outline"),
                       "a flexure is a mesh or an outline, not both");
  flexure.section = NameIndex::none;
  flexure.link = table.has("mesh") ? read_mesh_link(reading, *table.find("mesh"))
                                   : read_outline_link(reading, *table.find("outline"));
  if (flexure.link && !find_mesh_fault(*flexure.link)) {
    flexure.axis = link_axis(*flexure.link);
    return;
  }
  for (const char* key : {"axis", "section"}) reading.spoil(table.path(key));
}

}  // namespace

void read_body_pair(Reading& reading, const Place& place, const std::string& what,
                    const NameIndex& bodies, std::size_t& first, std::size_t& second) {
  const TomlNode::Array* pair = place.node->array();
  if (!pair || pair->size() != 2) {
    report_unexpected(reading, place, what);
    return;
  }
  const auto read = [&](std::size_t i) {
    const Place name_place{&(*pair)[i], place.path / i};
    const auto name = read_text(reading, name_place);
    return name ? bodies.resolve(reading, name_place, *name) : NameIndex::none;
  };
  first = read(0);
  second = read(1);
}

AxisShape read_axis(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::axis());
  const std::vector<std::string> shapes = {"line", "arc", "spline"};
  const auto shape = table.exactly_one_of(shapes);
  if (!shape) return LineAxis{};
  if (*shape != "spline") {
    for (const char* key : {"start_tangent", "end_tangent"}) {
      if (!table.has(key)) continue;
      reading.report(table.path(key), table.position(key),
                     fmt::format("only a spline has tangents to choose, this is a {}", *shape));
    }
  }
  const Place shape_place = *table.find(*shape);
  if (*shape == "line") return read_line(reading, shape_place);
  if (*shape == "arc") return read_arc(reading, shape_place);
  SplineAxis spline;
  spline.points = read_points(reading, shape_place);
  const auto read_tangent = [&](const char* key) -> std::optional<Vec2> {
    const auto tangent = table.find(key);
    return tangent ? read_vector(reading, *tangent, dimensions::number) : std::nullopt;
  };
  spline.start_tangent = read_tangent("start_tangent");
  spline.end_tangent = read_tangent("end_tangent");
  return spline;
}

std::vector<Flexure> read_flexures(Reading& reading, const Place& place, const Names& names) {
  std::vector<Flexure> flexures;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::flexure());
    Flexure flexure;
    flexure.name = entry.name;
    flexure.source = entry.position;
    flexure.base = flexure.action = NameIndex::none;
    const auto between = table.require("between");
    if (between)
      read_body_pair(reading, *between, "two bodies [\"base\", \"action\"]", names.bodies,
                     flexure.base, flexure.action);
    if (const auto pinned = table.find("pinned")) {
      read_pinned(reading, *pinned, between ? texts_in(*between->node) : std::vector<std::string>{},
                  flexure);
    }
    if (!is_link(table)) {
      if (const auto axis = table.require("axis")) flexure.axis = read_axis(reading, *axis);
    }
    flexure.material = read_reference(reading, table, "material", names.materials);
    if (is_link(table))
      read_link(reading, table, flexure);
    else
      flexure.section = read_reference(reading, table, "section", names.sections);
    flexure.misfit = table.vector("misfit", dimensions::length, {});
    flexure.misfit_rotation = table.quantity("misfit_rotation", dimensions::angle, 0.0);
    flexures.push_back(std::move(flexure));
  }
  return flexures;
}

}  // namespace flexura

#include "flexura/io/read_outline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "flexura/core/nearest_word.hpp"
#include "flexura/geometry/outline_mesh.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

constexpr double most_elements = 50000.0;

/// Greater than 0, or nothing after a report.
std::optional<double> read_positive(Reading& reading, TableReader& table, const char* key,
                                    const Dimension& dimension) {
  const double value = table.required_quantity(key, dimension);
  if (value > 0.0) return value;
  if (table.has(key) && !reading.has_mistake(table.path(key)))
    reading.report(table.path(key), table.find(key)->node->position,
                   fmt::format("must be greater than 0, is {}", value));
  return std::nullopt;
}

std::string read_edge(Reading& reading, TableReader& table) {
  const auto edge = table.find("edge");
  return edge ? read_text(reading, *edge).value_or("") : std::string();
}

OutlineStep read_step(Reading& reading, const Place& place) {
  OutlineStep step;
  if (!place.node->table()) {
    step.to = read_vector(reading, place, dimensions::length).value_or(Vec2{});
    return step;
  }
  TableReader table(reading, place, vocabulary::outline_side());
  table.require("to");
  step.to = table.vector("to", dimensions::length, {});
  step.sweep = table.quantity("sweep", dimensions::angle, 0.0);
  if (table.has("fillet"))
    step.fillet = read_positive(reading, table, "fillet", dimensions::length).value_or(0.0);
  step.name = read_edge(reading, table);
  return step;
}

OutlineLoop read_loop(Reading& reading, const Place& place) {
  std::vector<OutlineStep> steps;
  for (const Place& step :
       read_list(reading, place, "corners [x, y] and sides { to = [x, y], .. }"))
    steps.push_back(read_step(reading, step));
  if (reading.has_mistake(place.path)) return {};
  std::string fault;
  OutlineLoop loop = make_loop(steps, fault);
  if (!fault.empty()) reading.report(place.path, place.node->position, fault);
  return loop;
}

OutlineLoop read_hole(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::outline_hole());
  const std::vector<std::string> kinds = {"radius", "border"};
  const auto kind = table.exactly_one_of(kinds);
  if (!kind) return {};
  if (*kind == "border") {
    for (const char* key : {"centre", "edge"})
      if (table.has(key))
        reading.report_key(table.path(), key, table.position(key),
                           "belongs to a round hole, with a radius; sides have edges of their own");
    return read_loop(reading, *table.find("border"));
  }
  table.require("centre");
  const Vec2 centre = table.vector("centre", dimensions::length, {});
  const auto radius = read_positive(reading, table, "radius", dimensions::length);
  const std::string edge = read_edge(reading, table);
  return radius ? make_circle(centre, *radius, edge) : OutlineLoop{};
}

/// Reports a name that no edge has.
bool check_edge(Reading& reading, const Place& place, const std::string& name,
                const Outline& outline) {
  std::vector<std::string> names;
  for (const OutlineLoop& loop : outline.loops)
    for (const OutlineSide& side : loop)
      if (!side.name.empty() && std::find(names.begin(), names.end(), side.name) == names.end())
        names.push_back(side.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  reading.report(place.path, place.node->position,
                 names.empty() ? fmt::format("no side and no hole has an edge = \"{}\"", name)
                               : fmt::format("no side and no hole has the edge '{}'{}", name,
                                             suggestion(name, names)));
  return false;
}

/// Keys of an outline besides its lines.
struct MeshKeys {
  double depth = 0.0;
  double size = 0.0;
  int order = 2;
  std::string base;
  std::string action;
};

std::optional<MeshKeys> read_mesh_keys(Reading& reading, TableReader& table) {
  MeshKeys keys;
  const auto read_name = [&](const char* key) {
    const auto place = table.require(key);
    return place ? read_text(reading, *place).value_or("") : std::string();
  };
  keys.base = read_name("base");
  keys.action = read_name("action");
  keys.depth = read_positive(reading, table, "depth", dimensions::length).value_or(0.0);
  keys.size = read_positive(reading, table, "size", dimensions::length).value_or(0.0);
  keys.order = table.integer("order", 2);
  if (keys.order != 1 && keys.order != 2)
    reading.report(
        table.path("order"), table.find("order")->node->position,
        fmt::format("must be 1, for elements of four nodes, or 2, of eight; is {}", keys.order));
  if (reading.has_mistake(table.path())) return std::nullopt;
  return keys;
}

/// Meshes what has no mistake so far.
std::shared_ptr<const MeshLink> mesh_link(Reading& reading, TableReader& table, Outline outline,
                                          const MeshKeys& keys) {
  const auto report = [&](const char* key, const std::string& message) {
    reading.report(table.path(key), table.find(key)->node->position, message);
    return nullptr;
  };
  if (const auto fault = find_outline_fault(outline)) return report("border", *fault);
  const bool known = check_edge(reading, *table.find("base"), keys.base, outline);
  if (!check_edge(reading, *table.find("action"), keys.action, outline) || !known) return nullptr;
  orient(outline);
  const double expected = expected_elements(outline, keys.size);
  if (expected > most_elements)
    return report("size", fmt::format("makes about {:.3g} elements; {} are the most", expected,
                                      most_elements));
  OutlineMesh meshed = mesh_outline(outline, keys.size, keys.order);
  if (meshed.mesh.elements.empty())
    return report("border", "cannot be meshed: a corner is too sharp, or a part too thin");
  auto link = std::make_shared<MeshLink>();
  link->depth = keys.depth;
  link->base = meshed.named[keys.base];
  link->action = meshed.named[keys.action];
  link->mesh = std::move(meshed.mesh);
  if (const auto fault = find_mesh_fault(*link)) return report("action", *fault);
  return link;
}

}  // namespace

std::shared_ptr<const MeshLink> read_outline_link(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::outline());
  Outline outline;
  if (const auto border = table.require("border"))
    outline.loops.push_back(read_loop(reading, *border));
  if (const auto holes = table.find("holes"))
    for (const Place& hole : read_list(reading, *holes, "holes { centre = [x, y], radius = r }"))
      outline.loops.push_back(read_hole(reading, hole));
  const auto keys = read_mesh_keys(reading, table);
  if (!keys) return nullptr;
  return mesh_link(reading, table, std::move(outline), *keys);
}

}  // namespace flexura

#include "flexura/io/read_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/mesh_file.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

/// "link.msh has no edge 'lefft'; did you mean 'left'?"
const MeshGroup* find_group(Reading& reading, const Place& place, const std::string& name,
                            const MeshFileReading& file, const std::string& shown) {
  std::vector<std::string> names;
  for (const MeshGroup& group : file.groups) {
    if (group.name == name) return &group;
    names.push_back(group.name);
  }
  reading.report(place.path, place.node->position,
                 names.empty() ? fmt::format("'{}' names no edges and no surfaces", shown)
                               : fmt::format("'{}' has nothing named '{}'{}", shown, name,
                                             suggestion(name, names)));
  return nullptr;
}

/// The elements of a group, or all, and the nodes they have.
class Excerpt {
 public:
  Excerpt(const PlaneMesh& whole, const MeshGroup* part, double unit)
      : unit_(unit), index_(whole.nodes.size(), none) {
    if (!part) {
      for (const PlaneMesh::Element& element : whole.elements) add(whole, element);
      return;
    }
    for (const std::size_t e : std::set<std::size_t>(part->elements.begin(), part->elements.end()))
      add(whole, whole.elements[e]);
  }

  /// Those of the nodes that the elements have, once each.
  std::vector<std::size_t> nodes_of(const MeshGroup& group) const {
    std::set<std::size_t> own;
    for (const std::size_t n : group.nodes)
      if (index_[n] != none) own.insert(index_[n]);
    return {own.begin(), own.end()};
  }
  PlaneMesh take() && { return std::move(mesh_); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void add(const PlaneMesh& whole, const PlaneMesh::Element& element) {
    std::vector<std::size_t> own;
    for (std::size_t a = 0; a < nodes_of_kind(element); ++a) {
      std::size_t& index = index_[whole.node(element, a)];
      if (index == none) {
        index = mesh_.nodes.size();
        mesh_.nodes.push_back(unit_ * whole.place(element, a));
      }
      own.push_back(index);
    }
    mesh_.add(element.kind, own, element.label);
  }
  static std::size_t nodes_of_kind(const PlaneMesh::Element& element) {
    return flexura::nodes_of(element.kind);
  }

  double unit_;
  PlaneMesh mesh_;
  std::vector<std::size_t> index_;
};

/// How long the unit of the file's coordinates is: the model's own unless it is named.
double read_length_unit(Reading& reading, TableReader& table) {
  const auto place = table.find("unit");
  const auto word = place ? read_text(reading, *place) : std::nullopt;
  if (!word) return 1.0;
  const UnitReading unit = read_unit(*word);
  if (unit.unit && unit.unit->dimension == dimensions::length)
    return reading.units.value_of({"1", *unit.unit});
  reading.report(place->path, place->node->position,
                 fmt::format("expected a unit of length ({}), got \"{}\"",
                             common_units(dimensions::length), *word));
  return 1.0;
}

}  // namespace

std::shared_ptr<const MeshLink> read_mesh_link(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::mesh());
  const auto read_key = [&](const std::optional<Place>& at) {
    return at ? read_text(reading, *at) : std::nullopt;
  };
  const auto file_place = table.require("file");
  const auto shown = read_key(file_place);
  const auto base = read_key(table.require("base"));
  const auto action = read_key(table.require("action"));
  const auto part = read_key(table.find("part"));
  auto link = std::make_shared<MeshLink>();
  link->depth = table.required_quantity("depth", dimensions::length);
  const double unit = read_length_unit(reading, table);
  if (!shown || !base || !action) return nullptr;
  const MeshFileReading file = read_mesh_file(reading.folder / *shown, *shown);
  if (!file.error.empty()) {
    reading.report(file_place->path, file_place->node->position, file.error);
    return nullptr;
  }
  const auto group = [&](const char* key, const std::string& name) {
    return find_group(reading, *table.find(key), name, file, *shown);
  };
  const MeshGroup* of_part = part ? group("part", *part) : nullptr;
  const MeshGroup* at_base = group("base", *base);
  const MeshGroup* at_action = group("action", *action);
  if ((part && !of_part) || !at_base || !at_action) return nullptr;
  Excerpt excerpt(file.mesh, of_part, unit);
  link->base = excerpt.nodes_of(*at_base);
  link->action = excerpt.nodes_of(*at_action);
  link->mesh = std::move(excerpt).take();
  turn_clockwise_mesh(link->mesh);
  return link;
}

}  // namespace flexura

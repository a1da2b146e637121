#include "flexura/io/read_target.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

void read_ends(Reading& reading, TableReader& table, const StudyNames& names, Spring& spring) {
  spring.base.body = spring.action.body = NameIndex::none;
  const auto between = table.require("between");
  if (!between) return;
  const TomlNode::Array* pair = between->node->array();
  if (pair && pair->size() == 2) {
    read_target(reading, {&(*pair)[0], between->path / 0}, names, spring.base);
    read_target(reading, {&(*pair)[1], between->path / 1}, names, spring.action);
  } else {
    report_unexpected(reading, *between, "two bodies or points [\"a.P\", \"b.Q\"]");
  }
}

/// Its kind and stiffness; what damps alone needs neither.
void read_stiffness(TableReader& table, Spring& spring) {
  std::vector<std::string> kinds = {"stiffness", "torsional"};
  if (!table.has("stiffness") && !table.has("torsional")) kinds.emplace_back("damping");
  const auto kind = table.exactly_one_of(kinds);
  if (!kind || kind == "damping") return;
  spring.torsional = *kind == "torsional";
  spring.stiffness = table.required_quantity(
      *kind, spring.torsional ? dimensions::torsional_stiffness : dimensions::force_per_length);
}

void read_damping(Reading& reading, TableReader& table, Spring& spring) {
  constexpr Dimension without_radian{2, 1, -1, 0};
  const auto place = table.find("damping");
  if (!place) return;
  const std::string* text = place->node->string();
  const QuantityReading quantity = text ? read_quantity(*text) : QuantityReading{};
  const Dimension found = quantity.quantity ? quantity.quantity->unit.dimension : Dimension{};
  const bool of_rotation = found == dimensions::torsional_damping || found == without_radian;
  if (of_rotation && !spring.torsional) {
    reading.report(place->path, place->node->position,
                   "this damps a rotation: give the torsional stiffness, or torsional = 0");
    spring.damping = 1.0;
    return;
  }
  Dimension dimension = spring.torsional ? dimensions::torsional_damping : dimensions::damping;
  if (found == without_radian) dimension = found;
  spring.damping = read_quantity(reading, *place, dimension).value_or(1.0);
}

void read_free_state(Reading& reading, TableReader& table, Spring& spring) {
  const auto refuse = [&](const char* key, const char* why) {
    if (table.has(key)) reading.report_key(table.path(), key, table.position(key), why);
  };
  if (spring.torsional) {
    refuse("free_length", "a torsional spring has a free_angle");
    refuse("preload", "a torsional spring has a free_angle");
  } else {
    refuse("free_angle", "a spring between points has a free_length");
  }
  if (table.has("free_length") && table.has("preload"))
    reading.report_key(table.path(), "preload", table.position("preload"),
                       "the free length says it all: give one of the two");
  spring.free = spring.torsional ? table.optional_quantity("free_angle", dimensions::angle)
                                 : table.optional_quantity("free_length", dimensions::length);
  if (!spring.torsional) spring.preload = table.optional_quantity("preload", dimensions::force);
}

}  // namespace

std::vector<Spring> read_springs(Reading& reading, const Place& place, const StudyNames& names) {
  std::vector<Spring> springs;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::spring());
    Spring spring;
    spring.name = entry.name;
    spring.source = entry.position;
    read_ends(reading, table, names, spring);
    read_stiffness(table, spring);
    read_damping(reading, table, spring);
    read_free_state(reading, table, spring);
    springs.push_back(std::move(spring));
  }
  return springs;
}

}  // namespace flexura

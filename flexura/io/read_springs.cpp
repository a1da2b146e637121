#include "flexura/io/read_target.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {

std::vector<Spring> read_springs(Reading& reading, const Place& place, const StudyNames& names) {
  constexpr Dimension stiffness{0, 1, -2, 0};
  constexpr Dimension torsional{2, 1, -2, -1};
  std::vector<Spring> springs;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::spring());
    Spring spring;
    spring.name = entry.name;
    spring.source = entry.position;
    spring.base.body = spring.action.body = NameIndex::none;
    if (const auto between = table.require("between")) {
      const TomlNode::Array* pair = between->node->array();
      if (pair && pair->size() == 2) {
        read_target(reading, {&(*pair)[0], between->path / 0}, names, spring.base);
        read_target(reading, {&(*pair)[1], between->path / 1}, names, spring.action);
      } else {
        report_unexpected(reading, *between, "two bodies or points [\"a.P\", \"b.Q\"]");
      }
    }
    const std::vector<std::string> kinds = {"stiffness", "torsional"};
    if (const auto kind = table.exactly_one_of(kinds)) {
      spring.torsional = *kind == "torsional";
      spring.stiffness = table.required_quantity(*kind, spring.torsional ? torsional : stiffness);
    }
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
    springs.push_back(std::move(spring));
  }
  return springs;
}

}  // namespace flexura

#include <fmt/format.h>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/read_parameters.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

std::optional<Unit> read_declared_unit(Reading& reading, const Place& place,
                                       const Dimension& dimension) {
  const auto word = read_text(reading, place);
  if (!word) return {};
  const UnitReading result = read_unit(*word);
  // "lbf s2/in" has its uses, but the results need one word for each declared unit.
  const bool one_word = word->find_first_of(" *^/-0123456789") == std::string::npos;
  if (result.unit && result.unit->dimension == dimension && one_word) return result.unit;
  std::string why = result.error.empty() ? "" : ": " + result.error;
  if (dimension == dimensions::force && *word == "lb") {
    why = ", which is a mass; the force is 'lbf'";
  }
  const std::string name = describe(dimension);
  reading.report(place.path, place.node->position,
                 fmt::format("expected a unit of {} ({}), got \"{}\"{}",
                             name.substr(name.find(' ') + 1), common_units(dimension), *word, why));
  return {};
}

}  // namespace

UnitNames read_units(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::units());
  UnitNames names;
  const auto read = [&](const char* key, const Dimension& dimension, bool required,
                        std::string& name) -> std::optional<Unit> {
    const auto unit_place = required ? table.require(key) : table.find(key);
    if (!unit_place) return {};
    const auto unit = read_declared_unit(reading, *unit_place, dimension);
    if (unit) name = *unit_place->node->string();
    return unit;
  };
  const auto length = read("length", dimensions::length, true, names.length);
  const auto force = read("force", dimensions::force, true, names.force);
  const auto time = read("time", dimensions::time, true, names.time);
  const auto angle = read("angle", dimensions::angle, false, names.angle);
  if (angle && names.angle != "rad" && names.angle != "deg") {
    reading.report(table.path("angle"), table.find("angle")->node->position,
                   fmt::format("expected \"rad\" or \"deg\", got \"{}\"", names.angle));
  }
  // Without its units a file is no model; SI lets the rest of it be checked all the same.
  if (length && force && time) {
    reading.units = UnitSystem(*length, *force, *time, angle.value_or(Unit{dimensions::angle, {}}));
  }
  return names;
}

}  // namespace flexura

#include <fmt/format.h>

#include "flexura/io/read_studies.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

std::vector<double> read_numbers(Reading& reading, const Place& place) {
  std::vector<double> numbers;
  for (const Place& number : read_list(reading, place, "numbers")) {
    numbers.push_back(read_quantity(reading, number, dimensions::number).value_or(0.0));
  }
  return numbers;
}

std::vector<Vec2> read_joints(Reading& reading, const Place& place) {
  std::vector<Vec2> joints;
  for (const Place& joint : read_list(reading, place, "joints [x, y]")) {
    joints.push_back(read_vector(reading, joint, dimensions::number).value_or(Vec2{}));
  }
  return joints;
}

PrbmSettings parameter_set(const std::string& name, std::optional<double> load_ratio) {
  if (name == "su") return {PrbmSu{}};
  if (name == "howell") return {PrbmHowell{load_ratio}};
  return {PrbmEqualSprings{}};
}

/// Reports keys that have no meaning beside the one that says what kind of parameters these are.
void refuse_beside(Reading& reading, TableReader& table, const std::string& kind,
                   std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (!table.has(key)) continue;
    reading.report(table.path(key), table.position(key),
                   fmt::format("'{}' has no meaning beside '{}'", key, kind));
  }
}

PrbmSettings read_named_set(Reading& reading, TableReader& table) {
  refuse_beside(reading, table, "model", {"stiffness"});
  const auto name =
      read_word(reading, *table.find("model"), "parameter set", vocabulary::parameter_sets());
  const auto load_ratio = table.optional_quantity("load_ratio", dimensions::number);
  if (!name) return {};
  if (*name != "howell") refuse_beside(reading, table, *name, {"load_ratio"});
  return parameter_set(*name, load_ratio);
}

}  // namespace

PrbmSettings read_prbm_parameters(Reading& reading, const Place& place) {
  if (place.node->string()) {
    const auto name = read_word(reading, place, "parameter set", vocabulary::parameter_sets());
    return parameter_set(name.value_or("equal_springs"), {});
  }
  if (!place.node->table()) {
    report_unexpected(reading, place,
                      "\"equal_springs\", \"su\", \"howell\" or a table of parameters");
    return {};
  }
  TableReader table(reading, place, vocabulary::prbm_parameters());
  const std::vector<std::string> kinds = {"model", "lengths", "joints"};
  const auto kind = table.exactly_one_of(kinds);
  if (!kind) return {};
  if (*kind == "model") return read_named_set(reading, table);
  refuse_beside(reading, table, *kind, {"load_ratio"});
  const auto stiffness = table.require("stiffness");
  const auto springs = stiffness ? read_numbers(reading, *stiffness) : std::vector<double>{};
  const Place list = *table.find(*kind);
  if (!stiffness) reading.spoil(list.path);  // nothing to count its entries against
  if (*kind == "joints") return {PrbmJoints{read_joints(reading, list), springs}};
  return {PrbmSegments{read_numbers(reading, list), springs}};
}

}  // namespace flexura

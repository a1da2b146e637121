#include "flexura/io/read_study_parts.hpp"

#include <fmt/format.h>

#include "flexura/io/read_history.hpp"
#include "flexura/io/read_target.hpp"

namespace flexura {
namespace {

/// Absent without a `history`: the load, or what is prescribed, then keeps its default.
std::optional<TimeHistory> read_history_in(Reading& reading, const TableReader& table,
                                           const LoadPlace& where) {
  const auto angle = table.find("angle");
  if (angle && where.over_angle) return read_history(reading, *angle, HistoryVariable::angle);
  if (angle)
    reading.report_key(table.path(), "angle", table.position("angle"),
                       fmt::format("a study of kind {} has no drive whose angle loads could "
                                   "follow; this is for linkages",
                                   where.kind));
  const auto place = table.find("history");
  if (!place) return {};
  if (where.in_time) return read_history(reading, *place);
  reading.report_key(
      table.path(), "history", table.position("history"),
      fmt::format("a study of kind {} has no time; histories are for transient ones", where.kind));
  return {};
}

Load read_load(Reading& reading, const Place& place, const StudyNames& names,
               const LoadPlace& where) {
  Load load;
  load.body = NameIndex::none;
  TableReader table(reading, place, vocabulary::load());
  if (table.has("distributed")) {
    reading.report_key(place.path, "distributed", table.position("distributed"),
                       "distributed loads belong to studies of kind path and transient");
    reading.spoil(place.path / "on");
    return load;
  }
  if (const auto target = table.require("on")) read_target(reading, *target, names, load);
  const bool mistaken = reading.has_mistake(place.path);
  if (place.node->table() && !table.has("force") && !table.has("moment") && !mistaken) {
    reading.report(place.path, place.node->position,
                   "a load needs force = [x, y] or moment = .. (or both)");
  }
  load.force = table.vector("force", dimensions::force, {});
  load.moment = table.quantity("moment", dimensions::moment, 0.0);
  load.follower = table.boolean("follower", false);
  load.constant = table.boolean("constant", false);
  if (auto history = read_history_in(reading, table, where)) load.history = std::move(*history);
  return load;
}

/// A load whose `distributed` force acts along a flexure.
SpreadLoad read_spread(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::load());
  SpreadLoad load{NameIndex::none, {}};
  if (const auto on = table.require("on")) {
    const auto name = read_text(reading, *on);
    if (name) load.flexure = names.flexure_names.resolve(reading, *on, *name);
  }
  for (const char* key : {"force", "moment", "follower", "constant"}) {
    if (const auto other = table.find(key))
      reading.report_key(place.path, key, other->node->position,
                         "a distributed load acts along a flexure and keeps its direction: give "
                         "other loads an entry of their own");
  }
  if (table.has("history"))
    reading.report_key(place.path, "history", table.position("history"),
                       "a distributed load has no history: in time, it is there from the start");
  load.per_length = table.vector("distributed", dimensions::force_per_length, {});
  return load;
}

Prescribed read_prescribed(Reading& reading, const Place& place, const StudyNames& names,
                           const LoadPlace& where) {
  Prescribed prescribed;
  prescribed.body = NameIndex::none;
  TableReader table(reading, place, vocabulary::prescribed());
  if (const auto target = table.require("on")) read_target(reading, *target, names, prescribed);
  const bool any = table.has("x") || table.has("y") || table.has("rotation");
  if (place.node->table() && !any && !reading.has_mistake(place.path)) {
    reading.report(place.path, place.node->position,
                   "what is prescribed needs x = .., y = .. or rotation = .. (or several)");
  }
  prescribed.x = table.optional_quantity("x", dimensions::length);
  prescribed.y = table.optional_quantity("y", dimensions::length);
  prescribed.rotation = table.optional_quantity("rotation", dimensions::angle);
  if (auto history = read_history_in(reading, table, where))
    prescribed.history = std::move(*history);
  return prescribed;
}

}  // namespace

std::vector<Load> read_loads(Reading& reading, const Place& place, const StudyNames& names,
                             const LoadPlace& where) {
  std::vector<Load> loads;
  for (const Place& entry : read_list(reading, place, "loads")) {
    if (where.fields && entry.node->find("distributed"))
      where.fields->spread.push_back(read_spread(reading, entry, names));
    else
      loads.push_back(read_load(reading, entry, names, where));
  }
  return loads;
}

std::vector<Prescribed> read_prescribe(Reading& reading, const Place& place,
                                       const StudyNames& names, const LoadPlace& where) {
  std::vector<Prescribed> prescribe;
  for (const Place& entry : read_list(reading, place, "prescribed displacements"))
    prescribe.push_back(read_prescribed(reading, entry, names, where));
  return prescribe;
}

void read_surroundings(TableReader& table, FieldLoads& fields) {
  fields.gravity = table.vector("gravity", dimensions::acceleration, {});
  fields.temperature = table.quantity("temperature", dimensions::number, 0.0);
}

std::size_t read_reference(Reading& reading, const TableReader& table,
                           const std::vector<ModelingSettings>& modelings, bool complete) {
  const auto reference = table.find("reference");
  const auto label = reference ? read_text(reading, *reference) : std::nullopt;
  if (!label) return default_reference(modelings);
  NameIndex labels("label", complete, " among the modelings");
  for (const ModelingSettings& settings : modelings) labels.add(settings.label);
  return labels.resolve(reading, *reference, *label);
}

}  // namespace flexura

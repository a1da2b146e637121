#include "flexura/io/read_studies.hpp"

#include <fmt/format.h>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/read_target.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

Load read_load(Reading& reading, const Place& place, const StudyNames& names) {
  Load load;
  load.body = NameIndex::none;
  TableReader table(reading, place, vocabulary::load());
  if (const auto target = table.require("on")) read_target(reading, *target, names, load);
  const bool mistaken = reading.has_mistake(place.path);
  if (place.node->table() && !table.has("force") && !table.has("moment") && !mistaken) {
    reading.report(place.path, place.node->position,
                   "a load needs force = [x, y] or moment = .. (or both)");
  }
  if (const auto spread = table.find("distributed"))
    reading.report_key(place.path, "distributed", spread->node->position,
                       "distributed loads belong to studies of kind path");
  load.force = table.vector("force", dimensions::force, {});
  load.moment = table.quantity("moment", dimensions::moment, 0.0);
  load.follower = table.boolean("follower", false);
  load.constant = table.boolean("constant", false);
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
  load.per_length = table.vector("distributed", dimensions::force_per_length, {});
  return load;
}

/// Loads on bodies, and the distributed ones among them on flexures.
std::vector<Load> read_path_loads(Reading& reading, const Place& place, const StudyNames& names,
                                  FieldLoads& fields) {
  std::vector<Load> loads;
  for (const Place& entry : read_list(reading, place, "loads")) {
    if (entry.node->find("distributed"))
      fields.spread.push_back(read_spread(reading, entry, names));
    else
      loads.push_back(read_load(reading, entry, names));
  }
  return loads;
}

std::vector<Load> read_loads(Reading& reading, const Place& place, const StudyNames& names) {
  std::vector<Load> loads;
  for (const Place& entry : read_list(reading, place, "loads")) {
    loads.push_back(read_load(reading, entry, names));
  }
  return loads;
}

Prescribed read_prescribed(Reading& reading, const Place& place, const StudyNames& names) {
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
  return prescribed;
}

RelativeDisplacement read_relative(Reading& reading, const Place& place,
                                   const NameIndex& flexures) {
  static const Vocabulary places{{"end", "centre"}, {}};
  TableReader table(reading, place, vocabulary::relative());
  RelativeDisplacement relative;
  relative.flexure = NameIndex::none;
  if (const auto name_place = table.require("flexure")) {
    const auto name = read_text(reading, *name_place);
    if (name) relative.flexure = flexures.resolve(reading, *name_place, *name);
  }
  relative.displacement = {table.quantity("x", dimensions::length, 0.0),
                           table.quantity("y", dimensions::length, 0.0)};
  relative.rotation = table.quantity("rotation", dimensions::angle, 0.0);
  if (const auto at = table.find("at")) {
    const bool centre = read_word(reading, *at, "point", places) == "centre";
    relative.at = centre ? RelativeDisplacement::At::centre : RelativeDisplacement::At::end;
  }
  return relative;
}

/// `modelings` and `reference`, of whichever study has them.
template <typename StudyKind>
void read_modelings_of(Reading& reading, TableReader& table, StudyKind& study) {
  const auto modelings = table.require("modelings");
  if (modelings) study.modelings = read_modelings(reading, *modelings);
  study.reference = default_reference(study.modelings);
  const auto reference = table.find("reference");
  if (!reference) return;
  const auto label = read_text(reading, *reference);
  if (!label) return;
  NameIndex labels("label", modelings && modelings->node->array(), " among the modelings");
  for (const ModelingSettings& settings : study.modelings) labels.add(settings.label);
  study.reference = labels.resolve(reading, *reference, *label);
}

LinearStudy read_linear(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::linear_study());
  LinearStudy study;
  if (const auto loads = table.find("loads")) study.loads = read_loads(reading, *loads, names);
  study.axial = table.boolean("axial", true);
  study.shear = table.boolean("shear", true);
  return study;
}

PathEnd read_until(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::until());
  PathEnd until;
  until.load_factor = table.quantity("load_factor", dimensions::number, until.load_factor);
  if (table.has("limit_points")) until.limit_points = table.integer("limit_points", 1);
  if (table.has("steps")) until.steps = table.integer("steps", 1);
  return until;
}

/// How a path is followed; `until` and `branch` belong to arc length alone.
void read_control(Reading& reading, TableReader& table, PathStudy& study) {
  const auto control = table.find("control");
  const auto word =
      control ? read_word(reading, *control, "control", vocabulary::controls()) : std::nullopt;
  study.arc_length = word == "arc_length";
  for (const char* key : {"until", "branch"}) {
    const auto place = table.find(key);
    if (!place || study.arc_length || (control && !word)) continue;
    reading.report_key(table.path(), key, place->node->position,
                       "this needs control = \"arc_length\"");
  }
  if (const auto until = table.find("until")) study.until = read_until(reading, *until);
  if (const auto place = table.find("branch")) {
    TableReader branch(reading, *place, vocabulary::branch());
    study.branch = BranchSwitch{branch.integer("at", 1), branch.integer("side", 1)};
  }
}

StageSettings read_stage(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::stage());
  StageSettings stage;
  stage.output.body = NameIndex::none;
  if (const auto on = table.require("on")) read_target(reading, *on, names, stage.output);
  if (table.has("along")) stage.output.along = table.vector("along", dimensions::number, {});
  if (const auto input = table.find("input")) {
    stage.input = DirectedPlace{NameIndex::none, {}, {}};
    read_target(reading, *input, names, *stage.input);
    if (table.has("input_along"))
      stage.input->along = table.vector("input_along", dimensions::number, {});
  } else if (const auto along = table.find("input_along")) {
    reading.report_key(place.path, "input_along", along->node->position, "this needs an input");
  }
  return stage;
}

std::vector<std::size_t> read_condense(Reading& reading, const Place& place,
                                       const StudyNames& names) {
  std::vector<std::size_t> bodies;
  for (const Place& entry : read_list(reading, place, "bodies")) {
    const auto name = read_text(reading, entry);
    bodies.push_back(name ? names.body_names.resolve(reading, entry, *name) : NameIndex::none);
  }
  return bodies;
}

PathStudy read_path(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::path_study());
  PathStudy study;
  const auto prescribe = table.find("prescribe");
  if (prescribe) {
    for (const Place& entry : read_list(reading, *prescribe, "prescribed displacements")) {
      study.prescribe.push_back(read_prescribed(reading, entry, names));
    }
  }
  const bool other = prescribe || table.has("gravity") || table.has("temperature");
  const auto loads = other ? table.find("loads") : table.require("loads");
  if (loads) study.loads = read_path_loads(reading, *loads, names, study.fields);
  if (const auto surroundings = table.find("surroundings")) {
    static const Vocabulary ways{{"growing", "constant"}, {}};
    study.fields.constant = read_word(reading, *surroundings, "way of acting", ways) == "constant";
  }
  study.fields.gravity = table.vector("gravity", dimensions::acceleration, {});
  study.fields.temperature = table.quantity("temperature", dimensions::number, 0.0);
  study.steps = table.integer("steps", study.steps);
  read_control(reading, table, study);
  if (const auto stage = table.find("stage")) study.stage = read_stage(reading, *stage, names);
  if (const auto condense = table.find("condense"))
    study.condense = read_condense(reading, *condense, names);
  read_modelings_of(reading, table, study);
  return study;
}

BucklingStudy read_buckling(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::buckling_study());
  BucklingStudy study;
  if (const auto loads = table.require("loads")) study.loads = read_loads(reading, *loads, names);
  study.linearised = table.boolean("linearised", false);
  study.count = table.integer("count", study.count);
  read_modelings_of(reading, table, study);
  return study;
}

InverseStudy read_inverse(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::inverse_study());
  InverseStudy study;
  if (const auto relative = table.require("relative")) {
    for (const Place& entry : read_list(reading, *relative, "relative displacements")) {
      study.relative.push_back(read_relative(reading, entry, names.flexure_names));
    }
  }
  study.steps = table.integer("steps", study.steps);
  read_modelings_of(reading, table, study);
  return study;
}

}  // namespace

std::vector<Study> read_studies(Reading& reading, const Place& place, const StudyNames& names) {
  std::vector<Study> studies;
  for (const NamedPlace& entry : read_names(reading, place)) {
    Study study{entry.name, LinearStudy{}, entry.position};
    const TomlEntry* kind_entry = entry.place.node->find("kind");
    if (!entry.place.node->table()) {
      report_unexpected(reading, entry.place, "a table");
    } else if (!kind_entry) {
      reading.report_key(entry.place.path, "kind", entry.place.node->position,
                         "missing key 'kind': linear, path, buckling or inverse");
    } else {
      // Which other keys may be there depends on the kind: without it they are left alone.
      const auto kind = read_word(reading, {&kind_entry->node, entry.place.path / "kind"},
                                  "study kind", vocabulary::study_kinds());
      if (kind == "linear") study.kind = read_linear(reading, entry.place, names);
      if (kind == "path") study.kind = read_path(reading, entry.place, names);
      if (kind == "buckling") study.kind = read_buckling(reading, entry.place, names);
      if (kind == "inverse") study.kind = read_inverse(reading, entry.place, names);
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace flexura

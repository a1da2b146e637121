#include "flexura/io/read_studies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexura/io/read_study_parts.hpp"
#include "flexura/io/read_target.hpp"

namespace flexura {
namespace {

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

LinearStudy read_linear(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::linear_study());
  LinearStudy study;
  if (const auto loads = table.find("loads"))
    study.loads = read_loads(reading, *loads, names, {"linear"});
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

PathStudy::KeptFields read_kept_fields(Reading& reading, const Place& place) {
  static const Vocabulary choices{{"none", "last", "every_step"}, {}};
  const auto word = read_word(reading, place, "choice of fields", choices);
  if (word == "none") return PathStudy::KeptFields::none;
  if (word == "every_step") return PathStudy::KeptFields::every_step;
  return PathStudy::KeptFields::last;
}

PathStudy read_path(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::path_study());
  PathStudy study;
  const LoadPlace where{"path", false, &study.fields};
  const auto prescribe = table.find("prescribe");
  if (prescribe) study.prescribe = read_prescribe(reading, *prescribe, names, where);
  const bool other = prescribe || table.has("gravity") || table.has("temperature");
  const auto loads = other ? table.find("loads") : table.require("loads");
  if (loads) study.loads = read_loads(reading, *loads, names, where);
  if (const auto surroundings = table.find("surroundings")) {
    static const Vocabulary ways{{"growing", "constant"}, {}};
    study.fields.constant = read_word(reading, *surroundings, "way of acting", ways) == "constant";
  }
  read_surroundings(table, study.fields);
  study.steps = table.integer("steps", study.steps);
  study.estimate = table.boolean("estimate", study.estimate);
  read_control(reading, table, study);
  if (const auto stage = table.find("stage")) study.stage = read_stage(reading, *stage, names);
  if (const auto condense = table.find("condense"))
    study.condense = read_condense(reading, *condense, names);
  if (const auto fields = table.find("fields"))
    study.stress_fields = read_kept_fields(reading, *fields);
  read_modelings_of(reading, table, study);
  return study;
}

BucklingStudy read_buckling(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::buckling_study());
  BucklingStudy study;
  if (const auto loads = table.require("loads"))
    study.loads = read_loads(reading, *loads, names, {"buckling"});
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

/// What a study of the kind is; nothing if that cannot be read.
decltype(Study::kind) read_kind(Reading& reading, const Place& place, const std::string& kind,
                                const StudyNames& names) {
  if (kind == "path") return read_path(reading, place, names);
  if (kind == "buckling") return read_buckling(reading, place, names);
  if (kind == "inverse") return read_inverse(reading, place, names);
  if (kind == "modes") return read_modes(reading, place, names);
  if (kind == "transient") return read_transient(reading, place, names);
  if (kind == "response") return read_response(reading, place, names);
  if (kind == "linkage") return read_linkage(reading, place, names);
  return read_linear(reading, place, names);
}

Study read_study(Reading& reading, const NamedPlace& entry, const StudyNames& names) {
  Study study{entry.name, LinearStudy{}, entry.position};
  const TomlEntry* kind_entry = entry.place.node->find("kind");
  if (!entry.place.node->table()) {
    report_unexpected(reading, entry.place, "a table");
  } else if (!kind_entry) {
    reading.report_key(entry.place.path, "kind", entry.place.node->position,
                       fmt::format("missing key 'kind': one of {}",
                                   fmt::join(vocabulary::study_kinds().keys, ", ")));
  } else {
    // Which other keys may be there depends on the kind: without it they are left alone.
    const auto kind = read_word(reading, {&kind_entry->node, entry.place.path / "kind"},
                                "study kind", vocabulary::study_kinds());
    if (kind) study.kind = read_kind(reading, entry.place, *kind, names);
  }
  return study;
}

/// The state of another study that a study of motion starts from, and under which key.
struct StartingState {
  std::optional<StudyState> state;
  const char* key = "about";

  void operator()(const ModesStudy& study) { state = study.about; }
  void operator()(const ResponseStudy& study) { state = study.about; }
  void operator()(const TransientStudy& study) {
    state = study.from;
    key = "from";
  }
  template <typename Other>
  void operator()(const Other&) {}
};

/// What can be said of a state only once all studies are known.
void check_state(Reading& reading, const NamedPlace& entry, const Study& study,
                 const std::vector<Study>& studies) {
  StartingState start;
  std::visit([&start](const auto& kind) { start(kind); }, study.kind);
  if (!start.state || start.state->study >= studies.size()) return;
  const Study& other = studies[start.state->study];
  const KeyPath path = entry.place.path / start.key;
  if (reading.has_mistake({"studies", other.name, "kind"})) reading.spoil(path / "study");
  if (!std::holds_alternative<TransientStudy>(study.kind) ||
      !std::holds_alternative<TransientStudy>(other.kind))
    return;
  if (const TomlEntry* factor = entry.place.node->find(start.key)->node.find("load_factor"))
    reading.report_key(path, "load_factor", factor->position,
                       fmt::format("study '{}' is a transient: it is taken up at its end, and has "
                                   "no load factor",
                                   other.name));
}

}  // namespace

std::vector<Study> read_studies(Reading& reading, const Place& place, StudyNames names) {
  const std::vector<NamedPlace> places = read_names(reading, place);
  for (const NamedPlace& entry : places) names.study_names.add(entry.name);
  std::vector<Study> studies;
  studies.reserve(places.size());
  for (const NamedPlace& entry : places) studies.push_back(read_study(reading, entry, names));
  for (std::size_t i = 0; i < studies.size(); ++i)
    check_state(reading, places[i], studies[i], studies);
  return studies;
}

}  // namespace flexura

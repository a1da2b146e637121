#include <fmt/format.h>

#include <numbers>

#include "flexura/io/read_study_parts.hpp"

namespace flexura {
namespace {

/// `study` and `load_factor` of a state to start from.
StudyState read_state(Reading& reading, TableReader& table, const StudyNames& names) {
  StudyState state{NameIndex::none, 1.0};
  if (const auto study = table.require("study")) {
    const auto name = read_text(reading, *study);
    if (name) state.study = names.study_names.resolve(reading, *study, *name);
  }
  state.load_factor = table.quantity("load_factor", dimensions::number, 1.0);
  return state;
}

std::optional<StudyState> read_optional_state(Reading& reading, const std::optional<Place>& place,
                                              const StudyNames& names) {
  if (!place) return {};
  TableReader table(reading, *place, vocabulary::study_state());
  return read_state(reading, table, names);
}

InertiaSettings read_inertia(Reading& reading, TableReader& table) {
  InertiaSettings inertia;
  inertia.translation = table.boolean("translation_inertia", true);
  if (table.has("rotary_inertia")) inertia.rotary = table.boolean("rotary_inertia", true);
  inertia.shear_rotary = table.boolean("shear_rotary_inertia", true);
  if (const auto mass = table.find("mass"))
    inertia.lumped = read_word(reading, *mass, "kind of mass", vocabulary::masses()) == "lumped";
  return inertia;
}

TransientStudy::Method read_method(Reading& reading, TableReader& table) {
  using Method = TransientStudy::Method;
  const auto place = table.find("method");
  const auto word =
      place ? read_word(reading, *place, "method", vocabulary::methods()) : std::nullopt;
  if (table.has("spectral_radius") && word != "generalized_alpha" && (word || !place))
    reading.report_key(table.path(), "spectral_radius", table.position("spectral_radius"),
                       "only method = \"generalized_alpha\" has a spectral radius");
  if (word == "generalized_alpha") return Method::generalized_alpha;
  return word == "energy_momentum" ? Method::energy_momentum : Method::radau;
}

/// How a transient goes on in time.
void read_steps(Reading& reading, TableReader& table, TransientStudy& study) {
  study.duration = table.required_quantity("duration", dimensions::time);
  study.step = table.optional_quantity("step", dimensions::time);
  study.tolerance = table.quantity("tolerance", dimensions::number, study.tolerance);
  study.method = read_method(reading, table);
  study.spectral_radius =
      table.quantity("spectral_radius", dimensions::number, study.spectral_radius);
  study.outputs = table.integer("outputs", study.outputs);
  study.estimate = table.boolean("estimate", study.estimate);
}

/// Cycles per time in the file are angular frequencies in the model.
void read_frequencies(Reading& reading, const Place& place, ResponseStudy& study) {
  constexpr double turn = 2.0 * std::numbers::pi;
  TableReader table(reading, place, vocabulary::frequencies());
  study.from = turn * table.required_quantity("from", dimensions::frequency);
  study.to = turn * table.required_quantity("to", dimensions::frequency);
  study.count = table.integer("count", study.count);
  study.logarithmic = table.boolean("logarithmic", study.logarithmic);
}

}  // namespace

DampingSettings read_damping(Reading& reading, const Place& place) {
  TableReader table(reading, place, vocabulary::damping());
  DampingSettings damping;
  for (const char* key : {"mass", "stiffness"})
    if (table.has("modal") && table.has(key))
      reading.report_key(place.path, key, table.position(key),
                         "damping is either modal, or by mass and stiffness");
  const bool mistaken = reading.has_mistake(place.path);
  if (place.node->table() && place.node->table()->empty() && !mistaken)
    reading.report(place.path, place.node->position, "one of modal, mass, stiffness is missing");
  damping.modal = table.quantity("modal", dimensions::number, 0.0);
  damping.mass = table.quantity("mass", dimensions::frequency, 0.0);
  damping.stiffness = table.quantity("stiffness", dimensions::time, 0.0);
  return damping;
}

ModesStudy read_modes(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::modes_study());
  ModesStudy study;
  if (const auto about = table.find("about")) {
    TableReader state(reading, *about, vocabulary::modes_about());
    study.about = read_state(reading, state, names);
    study.curve = state.boolean("curve", false);
  }
  study.count = table.integer("count", study.count);
  if (const auto solver = table.find("solver")) {
    const auto word = read_word(reading, *solver, "solver", vocabulary::mode_solvers());
    if (word == "dense") study.solver = ModesStudy::Solver::dense;
    if (word == "sparse") study.solver = ModesStudy::Solver::sparse;
  }
  study.inertia = read_inertia(reading, table);
  read_modelings_of(reading, table, study);
  return study;
}

TransientStudy read_transient(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::transient_study());
  TransientStudy study;
  const LoadPlace where{"transient", true, &study.fields};
  if (const auto loads = table.find("loads"))
    study.loads = read_loads(reading, *loads, names, where);
  if (const auto prescribe = table.find("prescribe"))
    study.prescribe = read_prescribe(reading, *prescribe, names, where);
  read_surroundings(table, study.fields);
  study.fields.constant = true;
  study.from = read_optional_state(reading, table.find("from"), names);
  read_steps(reading, table, study);
  if (const auto damping = table.find("damping")) study.damping = read_damping(reading, *damping);
  study.inertia = read_inertia(reading, table);
  read_modelings_of(reading, table, study);
  return study;
}

ResponseStudy read_response(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::response_study());
  ResponseStudy study;
  if (const auto loads = table.require("loads"))
    study.loads = read_loads(reading, *loads, names, {"response"});
  study.about = read_optional_state(reading, table.find("about"), names);
  if (const auto frequencies = table.require("frequencies"))
    read_frequencies(reading, *frequencies, study);
  if (const auto damping = table.find("damping")) study.damping = read_damping(reading, *damping);
  study.inertia = read_inertia(reading, table);
  read_modelings_of(reading, table, study);
  return study;
}

}  // namespace flexura

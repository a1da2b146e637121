#include "flexura/io/read_study_parts.hpp"

namespace flexura {
namespace {

/// `elements`: a number for all flexures, or a table with one for some.
void read_elements(Reading& reading, TableReader& table, const StudyNames& names,
                   LinkageStudy& study) {
  const auto place = table.find("elements");
  if (!place) return;
  if (!place->node->table()) {
    study.elements = table.integer("elements", study.elements);
    return;
  }
  for (const NamedPlace& entry : read_names(reading, *place)) {
    const auto number = read_integer(reading, entry.place);
    const std::size_t flexure = names.flexure_names.resolve(reading, entry.place, entry.name);
    if (number) study.flexure_elements.push_back({flexure, *number});
  }
}

/// Beams of a linkage are Euler and Bernoulli's unless they are told more.
ModelingSettings read_linkage_modeling(Reading& reading, const Place& place, LinkageStudy& study) {
  ModelingSettings settings = read_modeling(reading, place);
  auto* beam = std::get_if<BeamSettings>(&settings.kind);
  if (!beam) return settings;
  const auto has = [&](const char* key) {
    return place.node->table() && place.node->find(key) != nullptr;
  };
  if (has("elements")) study.elements = beam->elements;
  if (has("theory")) return settings;
  if (!has("order")) beam->theory = BeamSettings::Theory::linear;
  if (!has("shear")) settings.shear = false;
  return settings;
}

void read_methods(Reading& reading, const Place& place, LinkageStudy& study) {
  using Method = LinkageStudy::Method;
  static const std::vector<std::pair<std::string, Method>> known = {
      {"quasi_static", Method::quasi_static},
      {"periodic", Method::periodic},
      {"midha", Method::midha},
      {"transient", Method::transient},
      {"nonlinear", Method::nonlinear}};
  study.methods.clear();
  for (const Place& entry : read_list(reading, place, "methods")) {
    const auto word = read_word(reading, entry, "method", vocabulary::linkage_methods());
    for (const auto& [name, method] : known)
      if (word == name) study.methods.push_back(method);
  }
}

LinkageStudy::GeometricStiffness read_geometric(Reading& reading, const Place& place) {
  using Kind = LinkageStudy::GeometricStiffness;
  const auto word =
      read_word(reading, place, "geometric stiffness", vocabulary::geometric_stiffness());
  return word == "none" ? Kind::none : word == "dynamic" ? Kind::dynamic : Kind::quasi_static;
}

void read_speeds(Reading& reading, TableReader& table, LinkageStudy& study) {
  if (const auto place = table.find("speed_fluctuation"))
    for (const Place& entry : read_list(reading, *place, "harmonics of the speed")) {
      TableReader harmonic(reading, entry, vocabulary::speed_harmonic());
      study.fluctuation.push_back({harmonic.integer("order", 1),
                                   harmonic.required_quantity("amplitude", dimensions::number),
                                   harmonic.quantity("phase", dimensions::angle, 0.0)});
    }
  if (const auto place = table.find("speeds")) {
    TableReader range(reading, *place, vocabulary::speeds());
    SpeedRange speeds;
    speeds.from = range.required_quantity("from", dimensions::angular_speed);
    speeds.to = range.required_quantity("to", dimensions::angular_speed);
    speeds.count = range.integer("count", speeds.count);
    study.speeds = speeds;
  }
}

void read_midha(Reading& reading, const Place& place, LinkageStudy& study) {
  TableReader table(reading, place, vocabulary::midha());
  if (table.has("modes")) study.midha_modes = table.integer("modes", 1);
  if (const auto continuity = table.find("continuity"))
    if (read_word(reading, *continuity, "continuity", vocabulary::continuities()) == "modal")
      study.continuity = LinkageStudy::Continuity::modal;
}

}  // namespace

LinkageStudy read_linkage(Reading& reading, const Place& place, const StudyNames& names) {
  TableReader table(reading, place, vocabulary::linkage_study());
  LinkageStudy study;
  study.driver = NameIndex::none;
  if (const auto driver = table.require("driver")) {
    const auto name = read_text(reading, *driver);
    if (name) study.driver = names.driver_names.resolve(reading, *driver, *name);
  }
  if (const auto loads = table.find("loads"))
    study.loads = read_loads(reading, *loads, names, {"linkage", false, nullptr, true});
  study.gravity = table.vector("gravity", dimensions::acceleration, {});
  study.positions = table.integer("positions", study.positions);
  study.modeling.kind = BeamSettings{study.elements, 1, BeamSettings::Theory::linear};
  study.modeling.label = "beam";
  study.modeling.shear = false;
  if (const auto modeling = table.find("modeling"))
    study.modeling = read_linkage_modeling(reading, *modeling, study);
  read_elements(reading, table, names, study);
  if (const auto methods = table.find("methods")) read_methods(reading, *methods, study);
  study.coupling = table.boolean("coupling", study.coupling);
  if (const auto geometric = table.find("geometric_stiffness"))
    study.geometric_stiffness = read_geometric(reading, *geometric);
  if (const auto damping = table.find("damping")) study.damping = read_damping(reading, *damping);
  if (table.has("rotary_inertia")) study.rotary_inertia = table.boolean("rotary_inertia", true);
  study.inertia_correction = table.boolean("inertia_correction", study.inertia_correction);
  read_speeds(reading, table, study);
  study.modes = table.integer("modes", study.modes);
  if (const auto midha = table.find("midha")) read_midha(reading, *midha, study);
  study.turns = table.integer("turns", study.turns);
  if (table.has("turn_from_rest")) study.turn_from_rest = table.integer("turn_from_rest", 1);
  return study;
}

}  // namespace flexura

#include <fmt/format.h>

#include "flexura/core/nearest_word.hpp"
#include "flexura/io/read_studies.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

ScmbmSettings read_scmbm(Reading& reading, TableReader& table) {
  static const Vocabulary places{{"centre", "end"}, {}};
  const auto place = table.find("at");
  const auto at = place ? read_word(reading, *place, "point", places) : std::nullopt;
  return {at == "end" ? ScmbmSettings::At::end : ScmbmSettings::At::centre};
}

ExactSettings read_exact(TableReader& table) {
  if (!table.has("modes")) return {};
  return {table.integer("modes", 2)};
}

BeamSettings read_beam(Reading& reading, TableReader& table) {
  BeamSettings beam;
  if (const auto place = table.find("theory")) {
    const auto theory = read_word(reading, *place, "beam theory", vocabulary::theories());
    if (theory == "von_karman") beam.theory = BeamSettings::Theory::von_karman;
    if (theory == "printed") beam.theory = BeamSettings::Theory::printed;
    if (theory == "linear" || theory == "euler_bernoulli" || theory == "timoshenko")
      beam.theory = BeamSettings::Theory::linear;
  }
  beam.elements = table.integer("elements", beam.elements);
  beam.order = table.integer("order", beam.order);
  if (beam.theory != BeamSettings::Theory::exact && table.has("order")) {
    reading.report_key(table.path(), "order", table.position("order"),
                       "these elements have two nodes and a quintic deflection; only exact ones "
                       "have an order");
  }
  return beam;
}

ContinuumSettings read_continuum(Reading& reading, TableReader& table) {
  ContinuumSettings continuum;
  const auto count = [&](const char* key, std::optional<int>& value) {
    if (table.has(key)) value = table.integer(key, 1);
  };
  count("elements", continuum.elements);
  count("across", continuum.across);
  count("order", continuum.order);
  count("order_across", continuum.order_across);
  const auto is = [&](const char* key, const Vocabulary& words, const char* second) {
    const auto place = table.find(key);
    return place && read_word(reading, *place, key, words) == second;
  };
  if (is("plane", vocabulary::planes(), "strain")) continuum.plane = PlaneKind::strain;
  if (is("law", vocabulary::laws(), "neo_hookean"))
    continuum.law = ContinuumSettings::Law::neo_hookean;
  continuum.contracting = is("ends", vocabulary::face_ends(), "contracting");
  continuum.enhanced = table.boolean("enhanced", continuum.enhanced);
  for (const char* key : {"axial", "shear"})
    if (!table.boolean(key, true))
      reading.report_key(table.path(), key, table.position(key),
                         "a continuum has all strains there are; beams can leave them out");
  return continuum;
}

/// Euler and Bernoulli's beam does not shear: that is what its name says.
void settle_shear(Reading& reading, TableReader& table, ModelingSettings& settings) {
  const TomlNode* theory = nullptr;
  if (const auto place = table.find("theory")) theory = place->node;
  const std::string* word = theory ? theory->string() : nullptr;
  if (!word || (*word != "euler_bernoulli" && *word != "timoshenko")) return;
  const bool shears = *word == "timoshenko";
  if (table.has("shear") && settings.shear != shears) {
    reading.report_key(table.path(), "shear", table.position("shear"),
                       fmt::format("the theory '{}' {} shear", *word, shears ? "has" : "has no"));
  }
  settings.shear = shears;
}

ModelingSettings::Kind default_kind(const std::string& name) {
  if (name == "scmbm") return ScmbmSettings{};
  if (name == "prbm") return PrbmSettings{};
  if (name == "exact") return ExactSettings{};
  if (name == "beam") return BeamSettings{};
  if (name == "bcm") return BcmSettings{};
  if (name == "continuum") return ContinuumSettings{};
  return LinearSettings{};
}

ModelingSettings::Kind read_kind(Reading& reading, TableReader& table, const std::string& name) {
  if (name == "scmbm") return read_scmbm(reading, table);
  if (name == "exact") return read_exact(table);
  if (name == "beam") return read_beam(reading, table);
  if (name == "bcm") return BcmSettings{table.integer("elements", BcmSettings{}.elements)};
  if (name == "continuum") return read_continuum(reading, table);
  const auto parameters = name == "prbm" ? table.find("parameters") : std::nullopt;
  if (parameters) return read_prbm_parameters(reading, *parameters);
  return default_kind(name);
}

/// Keeps the label of a modeling that cannot be read, so that a `reference` to it is understood.
ModelingSettings read_modeling_name(Reading& reading, const Place& place) {
  ModelingSettings settings;
  settings.label = *place.node->string();
  const auto name = read_word(reading, place, "modeling", vocabulary::modelings());
  if (name) settings.kind = default_kind(*name);
  return settings;
}

ModelingSettings read_modeling_table(Reading& reading, const Place& place) {
  ModelingSettings settings;
  const TomlEntry* name_entry = place.node->find("name");
  if (!name_entry) {
    // Which other keys may be there depends on the name.
    reading.report(place.path, place.node->position, "missing key 'name': which modeling is it?");
    return settings;
  }
  const auto name = read_word(reading, {&name_entry->node, place.path / "name"}, "modeling",
                              vocabulary::modelings());
  if (!name) {
    reading.spoil(place.path);
    const TomlEntry* label = place.node->find("label");
    const std::string* text = (label ? label : name_entry)->node.string();
    settings.label = text ? *text : "";
    return settings;
  }
  TableReader table(reading, place, vocabulary::modeling(*name));
  settings.kind = read_kind(reading, table, *name);
  const auto label = table.find("label");
  settings.label = label ? read_text(reading, *label).value_or(*name) : *name;
  settings.axial = table.boolean("axial", true);
  settings.shear = table.boolean("shear", true);
  settle_shear(reading, table, settings);
  settings.tolerance = table.quantity("tolerance", dimensions::number, settings.tolerance);
  return settings;
}

}  // namespace

ModelingSettings read_modeling(Reading& reading, const Place& place) {
  ModelingSettings settings;
  if (place.node->string()) {
    settings = read_modeling_name(reading, place);
  } else if (place.node->table()) {
    settings = read_modeling_table(reading, place);
  } else {
    report_unexpected(reading, place, "a modeling's name or a table with its settings");
  }
  settings.source = place.node->position;
  return settings;
}

std::vector<ModelingSettings> read_modelings(Reading& reading, const Place& place) {
  std::vector<ModelingSettings> modelings;
  for (const Place& entry : read_list(reading, place, "modelings"))
    modelings.push_back(read_modeling(reading, entry));
  return modelings;
}

std::size_t default_reference(const std::vector<ModelingSettings>& modelings) {
  for (const char* preferred : {"continuum", "exact"}) {
    for (std::size_t i = 0; i < modelings.size(); ++i) {
      if (modeling_name(modelings[i]) == preferred) return i;
    }
  }
  return modelings.empty() ? 0 : modelings.size() - 1;
}

}  // namespace flexura

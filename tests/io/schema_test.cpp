// The schema that editors use names the same keys as the reader.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flexura/io/vocabulary.hpp"

namespace flexura {
namespace {

using nlohmann::json;

const json& schema() {
  static const json document = [] {
    std::ifstream file(FLEXURA_SOURCE_DIR "/schema/flexura-model.schema.json");
    return json::parse(file);
  }();
  return document;
}

void expect_keys(const json& object, const Vocabulary& vocabulary, const std::string& what) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.at("properties").items()) keys.push_back(key);
  std::vector<std::string> expected = vocabulary.keys;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(keys, expected) << what;  // nlohmann sorts by name
  EXPECT_FALSE(object.at("additionalProperties").get<bool>()) << what;
}

TEST(Schema, NamesTheReadersKeys) {
  const json& definitions = schema().at("definitions");
  expect_keys(schema(), vocabulary::model(), "model");
  const std::vector<std::pair<std::string, const Vocabulary&>> tables = {
      {"units", vocabulary::units()},
      {"material", vocabulary::material()},
      {"section", vocabulary::section()},
      {"rectangle", vocabulary::rectangle()},
      {"circle", vocabulary::circle()},
      {"general", vocabulary::general()},
      {"body", vocabulary::body()},
      {"flexure", vocabulary::flexure()},
      {"mesh", vocabulary::mesh()},
      {"outline", vocabulary::outline()},
      {"outline_side", vocabulary::outline_side()},
      {"outline_hole", vocabulary::outline_hole()},
      {"spring", vocabulary::spring()},
      {"joint", vocabulary::joint()},
      {"prismatic", vocabulary::prismatic()},
      {"driver", vocabulary::driver()},
      {"history_table", vocabulary::history()},
      {"half_sine", vocabulary::half_sine()},
      {"harmonic", vocabulary::harmonic()},
      {"axis", vocabulary::axis()},
      {"arc", vocabulary::arc()},
      {"linear_study", vocabulary::linear_study()},
      {"path_study", vocabulary::path_study()},
      {"stage", vocabulary::stage()},
      {"buckling_study", vocabulary::buckling_study()},
      {"inverse_study", vocabulary::inverse_study()},
      {"modes_study", vocabulary::modes_study()},
      {"transient_study", vocabulary::transient_study()},
      {"linkage_study", vocabulary::linkage_study()},
      {"speed_harmonic", vocabulary::speed_harmonic()},
      {"speeds", vocabulary::speeds()},
      {"midha", vocabulary::midha()},
      {"response_study", vocabulary::response_study()},
      {"modes_about", vocabulary::modes_about()},
      {"study_state", vocabulary::study_state()},
      {"frequencies", vocabulary::frequencies()},
      {"damping", vocabulary::damping()},
      {"load", vocabulary::load()},
      {"prescribed", vocabulary::prescribed()},
      {"relative", vocabulary::relative()}};
  for (const auto& [name, vocabulary] : tables) {
    expect_keys(definitions.at(name), vocabulary, name);
  }
  for (const std::string& name : vocabulary::modelings().keys) {
    expect_keys(definitions.at("modeling_" + name), vocabulary::modeling(name), name);
  }
  expect_keys(definitions.at("prbm_parameters").at("anyOf").at(1), vocabulary::prbm_parameters(),
              "prbm_parameters");
}

TEST(Schema, NamesTheReadersWords) {
  const json& definitions = schema().at("definitions");
  const auto words = [](const json& list) {
    return list.at("enum").get<std::vector<std::string>>();
  };
  EXPECT_EQ(words(definitions.at("study").at("properties").at("kind")),
            vocabulary::study_kinds().keys);
  EXPECT_EQ(words(definitions.at("modeling").at("anyOf").at(0)), vocabulary::modelings().keys);
  EXPECT_EQ(words(definitions.at("prbm_parameters").at("anyOf").at(0)),
            vocabulary::parameter_sets().keys);
  const auto property = [&](const char* table, const char* key) {
    return words(definitions.at(table).at("properties").at(key));
  };
  EXPECT_EQ(property("modeling_beam", "theory"), vocabulary::theories().keys);
  EXPECT_EQ(property("modes_study", "solver"), vocabulary::mode_solvers().keys);
  EXPECT_EQ(property("transient_study", "method"), vocabulary::methods().keys);
  for (const char* study : {"modes_study", "transient_study", "response_study"})
    EXPECT_EQ(property(study, "mass"), vocabulary::masses().keys);
}

TEST(Schema, ReferencesLeadSomewhere) {
  const auto& document = schema();
  const auto check = [&document](const auto& self, const json& node) -> void {
    if (node.is_object() && node.contains("$ref")) {
      const std::string target = node.at("$ref").get<std::string>().substr(1);
      EXPECT_TRUE(document.contains(json::json_pointer(target))) << target;
    }
    for (const json& child : node) {
      if (child.is_structured()) self(self, child);
    }
  };
  check(check, document);
}

}  // namespace
}  // namespace flexura

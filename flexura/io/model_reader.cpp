#include "flexura/io/model_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "flexura/io/locator.hpp"
#include "flexura/io/read_entities.hpp"
#include "flexura/io/read_parameters.hpp"
#include "flexura/io/read_studies.hpp"
#include "flexura/io/table_reader.hpp"
#include "flexura/io/text_checks.hpp"
#include "flexura/io/text_file.hpp"

namespace flexura {
namespace {

constexpr std::int64_t format_version = 1;

/// Whether the file says it is of the version understood here; anything said about the rest of a
/// file of another version would be a guess.
bool read_version(Reading& reading, TableReader& table) {
  const auto place = table.find("flexura");
  if (!place) {
    reading.report_key({}, "flexura", {}, "missing key 'flexura'; a model begins with flexura = 1");
    return true;
  }
  const auto* version = std::get_if<std::int64_t>(&place->node->value);
  if (version && *version == format_version) return true;
  reading.report(place->path, place->node->position,
                 version
                     ? fmt::format("format version {} is unknown; this program reads version {}",
                                   *version, format_version)
                     : fmt::format("expected the format version, {}, got {}", format_version,
                                   describe(*place->node)));
  return false;
}

/// Links of any shape have no section.
bool has_strips(const TableReader& table) {
  const auto flexures = table.find("flexures");
  const auto* entries = flexures ? flexures->node->table() : nullptr;
  if (!entries || entries->empty()) return true;
  return std::any_of(entries->begin(), entries->end(), [](const TomlEntry& entry) {
    return !entry.node.find("mesh") && !entry.node.find("outline");
  });
}

Model read_tables(Reading& reading, TableReader& table, const ParameterOverrides& overrides) {
  Model model;
  if (const auto title = table.find("title")) {
    model.title = read_text(reading, *title).value_or("");
  }
  if (const auto units = table.require("units")) model.units = read_units(reading, *units);
  read_parameters(reading, table.find("parameters"), overrides);
  // A linkage of rigid bodies has nothing made of a material.
  const bool rigid = table.has("joints") && !table.has("flexures");
  const auto of_flexures = [&](const char* key) {
    return rigid ? table.find(key) : table.require(key);
  };
  const auto materials = of_flexures("materials");
  if (materials) model.materials = read_materials(reading, *materials);
  const auto sections = has_strips(table) ? of_flexures("sections") : table.find("sections");
  if (sections) model.sections = read_sections(reading, *sections);
  const auto bodies = table.require("bodies");
  if (bodies) model.bodies = read_bodies(reading, *bodies);
  const auto complete = [](const std::optional<Place>& place) {
    return place && place->node->table();
  };
  const Names names{NameIndex::of("material", complete(materials), model.materials),
                    NameIndex::of("section", complete(sections), model.sections),
                    NameIndex::of("body", complete(bodies), model.bodies)};
  const auto flexures = of_flexures("flexures");
  if (flexures) model.flexures = read_flexures(reading, *flexures, names);
  StudyNames study_names{model.bodies, names.bodies,
                         NameIndex::of("flexure", rigid || complete(flexures), model.flexures)};
  if (const auto springs = table.find("springs")) {
    model.springs = read_springs(reading, *springs, study_names);
  }
  if (const auto joints = table.find("joints"))
    model.joints = read_joints(reading, *joints, names.bodies);
  if (const auto drivers = table.find("drivers"))
    model.drivers = read_drivers(reading, *drivers, names.bodies);
  study_names.driver_names = NameIndex::of("driver", true, model.drivers);
  if (const auto studies = table.find("studies")) {
    model.studies = read_studies(reading, *studies, study_names);
  }
  return model;
}

ValidationScope scope_of(const Reading& reading, const Model& model, const TomlNode& root) {
  const auto is_table = [&root](const char* key) {
    const TomlEntry* entry = root.find(key);
    return entry && entry->node.table();
  };
  ValidationScope scope;
  const auto need = [&](const std::string& kind, const auto& entities,
                        std::initializer_list<const char*> keys) {
    for (const auto& entity : entities)
      for (const char* key : keys)
        if (reading.has_mistake({kind, entity.name, key})) scope.connections = false;
  };
  const bool linked = is_table("flexures") || (is_table("joints") && !root.find("flexures"));
  scope.connections = is_table("bodies") && linked;
  need("bodies", model.bodies, {"fixed", "free"});
  need("flexures", model.flexures, {"between"});
  need("joints", model.joints, {"revolute", "prismatic"});
  need("drivers", model.drivers, {"turn", "move"});
  scope.pins = true;
  for (const char* kind : {"bodies", "flexures", "joints", "drivers"})
    if (reading.has_mistake({kind})) scope.pins = false;
  return scope;
}

/// The rules of a valid model, but for what is mistaken already.
void validate(Reading& reading, const Model& model, const TomlNode& root) {
  std::vector<Mistake> news = find_mistakes(model, scope_of(reading, model, root));
  // All are judged by what the readers met, none by one another.
  std::erase_if(news, [&reading](const Mistake& mistake) {
    return !mistake.independent && reading.has_mistake(mistake.path);
  });
  Locator locator(root);
  for (const Mistake& mistake : news) {
    reading.report(mistake.path, locator.locate(mistake.path), mistake.message);
  }
  if (reading.has_mistake({"units"})) return;
  for (const Mistake& doubt : find_doubts(model)) {
    if (reading.has_mistake(doubt.path)) continue;
    reading.warn(doubt.path, locator.locate(doubt.path), doubt.message);
  }
}

ModelReading finish(Diagnostics diagnostics, std::optional<Model> model) {
  std::stable_sort(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& a, const Diagnostic& b) { return a.position < b.position; });
  const auto is_error = [](const Diagnostic& d) { return d.severity == Severity::error; };
  if (std::any_of(diagnostics.begin(), diagnostics.end(), is_error)) model.reset();
  return {std::move(model), std::move(diagnostics)};
}

ModelReading refuse(SourcePosition position, std::string message) {
  return {std::nullopt, {{position, std::move(message)}}};
}

ModelReading read_checked_text(std::string_view text, const std::filesystem::path& folder,
                               const ParameterOverrides& overrides) {
  if (auto problem = check_text(text)) return {std::nullopt, {std::move(*problem)}};
  const TomlReading toml = read_toml(text);
  if (!toml.root) return {std::nullopt, {*toml.error}};
  if (toml.root->table()->empty()) {
    return refuse({}, "the file is empty; a model begins with flexura = 1");
  }
  Reading reading;
  reading.folder = folder;
  TableReader table(reading, {&*toml.root, {}}, vocabulary::model());
  if (!read_version(reading, table)) return finish(reading.diagnostics(), {});
  Model model = read_tables(reading, table, overrides);
  validate(reading, model, *toml.root);
  return finish(reading.diagnostics(), std::move(model));
}

ModelReading read_file(const std::filesystem::path& file, const ParameterOverrides& overrides) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    return refuse({}, "this is a directory, not a model file");
  }
  if (is_named_pipe(file)) return refuse({}, "this is a named pipe, not a model file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refuse({}, fmt::format("cannot open the file: {}", std::strerror(errno)));
  // One byte more than may be there, so that whatever is longer shows without being read whole.
  std::string text(longest_model_text + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) return refuse({}, "cannot read the file");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > longest_model_text) {
    const auto size = std::filesystem::file_size(file, error);
    return refuse({}, too_long_message(error ? 0 : size));
  }
  return read_checked_text(text, file.parent_path(), overrides);
}

/// A mistake of the program must not take down its caller.
template <typename Read>
ModelReading guard(const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    return refuse({}, fmt::format("the file could not be read: {}", error.what()));
  } catch (...) {
    return refuse({}, "the file could not be read");
  }
}

}  // namespace

ModelReading read_model_text(std::string_view text, const ParameterOverrides& overrides) {
  return guard([&] { return read_checked_text(text, {}, overrides); });
}

ModelReading read_model(const std::filesystem::path& file, const ParameterOverrides& overrides) {
  return guard([&] { return read_file(file, overrides); });
}

}  // namespace flexura

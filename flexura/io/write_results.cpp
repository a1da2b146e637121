#include "flexura/io/write_results.hpp"

#include <functional>
#include <set>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "flexura/io/write_csv.hpp"
#include "flexura/io/write_json.hpp"
#include "flexura/io/write_linkage.hpp"
#include "flexura/io/write_motion_csv.hpp"
#include "flexura/io/write_vtu.hpp"

namespace flexura {
namespace {

bool can_name_a_file(std::string_view name) {
  constexpr std::string_view not_in_names("/\\\0", 3);
  return !name.empty() && name.front() != '.' &&
         name.find_first_of(not_in_names) == std::string_view::npos;
}

/// Collects the files of a result; the first thing that cannot be written becomes the error.
class FileList {
 public:
  void add(const std::filesystem::path& name, std::string content,
           std::function<std::string()> make = {}) {
    if (!names_.insert(name).second) {
      fail(fmt::format("Two results would both be written to '{}': give one another label.",
                       name.string()));
    }
    files_.push_back({name, std::move(content), std::move(make)});
  }
  void add(const std::filesystem::path& name, CsvText csv) {
    if (!csv.error.empty()) fail(fmt::format("Cannot write '{}': {}.", name.string(), csv.error));
    add(name, std::move(csv.text));
  }
  void add_study(const Result& result, const StudyResult& study);

  const std::string& error() const { return error_; }
  const std::vector<OutputFile>& files() const { return files_; }

 private:
  void add_modeling(const std::filesystem::path& folder, const Result& result,
                    const PathResult& path, const ModelingPath& modeling);
  void add_fields(const std::filesystem::path& folder, const PathResult& path,
                  const ModelingPath& modeling);
  void add_modeling(const std::filesystem::path& folder, bool frequencies, const ModeResult& modes,
                    const ModelingModes& modeling);
  void add_modeling(const std::filesystem::path& folder, const MotionResult& motion,
                    const ModelingMotion& modeling);

  void fail(const std::string& error) {
    if (error_.empty()) error_ = error;
  }
  bool check_name(const char* what, const std::string& name) {
    if (!can_name_a_file(name)) {
      fail(
          fmt::format("The {} '{}' cannot name a file: it must not be empty, begin with '.' or "
                      "hold a slash.",
                      what, name));
    }
    return can_name_a_file(name);
  }

  std::vector<OutputFile> files_;
  std::set<std::filesystem::path> names_;
  std::string error_;
};

void FileList::add_modeling(const std::filesystem::path& folder, const Result& result,
                            const PathResult& path, const ModelingPath& modeling) {
  add(folder / (modeling.label + ".csv"), make_path_csv(path, modeling));
  if (!modeling.members.empty()) {
    add(folder / (modeling.label + ".members.csv"),
        make_members_csv(path.flexures, modeling.members));
  }
  if (!modeling.stage.empty()) {
    add(folder / (modeling.label + ".stage.csv"), make_stage_csv(modeling));
  }
  if (!path.condensed.empty()) {
    add(folder / (modeling.label + ".stiffness.json"), make_stiffness_json(result, path, modeling));
  }
  add_fields(folder, path, modeling);
}

/// A file of its own, or one for every state and the list of them.
void FileList::add_fields(const std::filesystem::path& folder, const PathResult& path,
                          const ModelingPath& modeling) {
  std::vector<std::string> names;
  std::vector<double> times;
  for (const FieldState& fields : modeling.fields) {
    const double load_factor = modeling.states[fields.state].load_factor;
    names.push_back(modeling.fields.size() == 1
                        ? modeling.label + ".fields.vtu"
                        : fmt::format("{}.fields.{:03}.vtu", modeling.label, fields.state));
    times.push_back(path.by_arc_length ? static_cast<double>(fields.state) : load_factor);
    add(folder / names.back(), {},
        [&fields, time = times.back()] { return make_vtu(fields, time); });
  }
  if (names.size() > 1) add(folder / (modeling.label + ".fields.pvd"), make_pvd(names, times));
}

void FileList::add_modeling(const std::filesystem::path& folder, bool frequencies,
                            const ModeResult& modes, const ModelingModes& modeling) {
  if (frequencies) {
    add(folder / (modeling.label + ".modes.csv"), make_modes_csv(modeling));
  } else {
    add(folder / (modeling.label + ".buckling.csv"), make_buckling_csv(modeling));
  }
  add(folder / (modeling.label + ".shapes.csv"), make_shapes_csv(modes, modeling));
  if (!modeling.curve.empty()) {
    add(folder / (modeling.label + ".frequencies.csv"), make_frequencies_csv(modeling));
  }
}

void FileList::add_modeling(const std::filesystem::path& folder, const MotionResult& motion,
                            const ModelingMotion& modeling) {
  add(folder / (modeling.label + ".csv"), make_motion_csv(motion, modeling));
  add(folder / (modeling.label + ".energy.csv"), make_energy_csv(modeling));
  if (!modeling.members.empty()) {
    add(folder / (modeling.label + ".members.csv"),
        make_members_csv(motion.flexures, modeling.members));
  }
}

void FileList::add_study(const Result& result, const StudyResult& study) {
  if (!check_name("study", study.name)) return;
  const std::filesystem::path folder(study.name);
  const auto for_each = [&](const auto& content, auto&& add_one) {
    for (const auto& modeling : content.modelings)
      if (check_name("label", modeling.label)) add_one(modeling);
  };
  if (const auto* linear = std::get_if<LinearResult>(&study.content)) {
    add(folder / "ellipse.json", make_ellipse_json(result, study, *linear));
  } else if (const auto* path = std::get_if<PathResult>(&study.content)) {
    for_each(*path, [&](const auto& m) { add_modeling(folder, result, *path, m); });
  } else if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
    const bool frequencies = study.kind == "modes";
    for_each(*modes, [&](const auto& m) { add_modeling(folder, frequencies, *modes, m); });
  } else if (const auto* motion = std::get_if<MotionResult>(&study.content)) {
    for_each(*motion, [&](const auto& m) { add_modeling(folder, *motion, m); });
  } else if (const auto* linkage = std::get_if<LinkageResult>(&study.content)) {
    for (const auto& [name, csv] : make_linkage_files(*linkage, result.angle_unit))
      add(folder / name, csv);
  } else {
    const auto& response = std::get<ResponseResult>(study.content);
    for_each(response, [&](const auto& m) {
      add(folder / (m.label + ".response.csv"), make_response_csv(response, m));
    });
  }
}

}  // namespace

WriteOutcome write_results(const Result& result, const std::string& report_html,
                           const std::filesystem::path& folder) {
  FileList list;
  for (const StudyResult& study : result.studies) list.add_study(result, study);
  list.add("report.html", report_html);
  // Last, so that whoever waits for it finds all the others.
  list.add("summary.json", make_summary_json(result));
  if (!list.error().empty()) return {list.error()};
  return write_files(folder, list.files());
}

}  // namespace flexura

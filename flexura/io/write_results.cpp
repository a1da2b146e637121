#include "flexura/io/write_results.hpp"

#include <set>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "flexura/io/write_csv.hpp"
#include "flexura/io/write_json.hpp"

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
  void add(const std::filesystem::path& name, std::string content) {
    if (!names_.insert(name).second) {
      fail(fmt::format("Two results would both be written to '{}': give one another label.",
                       name.string()));
    }
    files_.push_back({name, std::move(content)});
  }
  void add(const std::filesystem::path& name, CsvText csv) {
    if (!csv.error.empty()) fail(fmt::format("Cannot write '{}': {}.", name.string(), csv.error));
    add(name, std::move(csv.text));
  }
  void add_study(const Result& result, const StudyResult& study);

  const std::string& error() const { return error_; }
  const std::vector<OutputFile>& files() const { return files_; }

 private:
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

void FileList::add_study(const Result& result, const StudyResult& study) {
  if (!check_name("study", study.name)) return;
  const std::filesystem::path folder(study.name);
  if (const auto* linear = std::get_if<LinearResult>(&study.content)) {
    add(folder / "ellipse.json", make_ellipse_json(result, study, *linear));
    return;
  }
  if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
    for (const ModelingModes& modeling : modes->modelings) {
      if (!check_name("label", modeling.label)) continue;
      add(folder / (modeling.label + ".buckling.csv"), make_buckling_csv(modeling));
      add(folder / (modeling.label + ".shapes.csv"), make_shapes_csv(*modes, modeling));
    }
    return;
  }
  const auto& path = std::get<PathResult>(study.content);
  for (const ModelingPath& modeling : path.modelings) {
    if (!check_name("label", modeling.label)) continue;
    add(folder / (modeling.label + ".csv"), make_path_csv(path, modeling));
    if (!modeling.members.empty()) {
      add(folder / (modeling.label + ".members.csv"), make_members_csv(path, modeling));
    }
    if (!modeling.stage.empty()) {
      add(folder / (modeling.label + ".stage.csv"), make_stage_csv(modeling));
    }
    if (!path.condensed.empty()) {
      add(folder / (modeling.label + ".stiffness.json"),
          make_stiffness_json(result, path, modeling));
    }
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

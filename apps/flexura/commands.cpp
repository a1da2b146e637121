#include "apps/flexura/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <optional>
#include <set>

#include "apps/flexura/input.hpp"
#include "apps/flexura/terminal.hpp"
#include "apps/flexura/watched_run.hpp"
#include "flexura/io/starter.hpp"
#include "flexura/io/write_results.hpp"
#include "flexura/report/report.hpp"
#include "flexura/report/table.hpp"

namespace flexura::app {
namespace {

bool names_exist(const Model& model, const RunArguments& arguments) {
  std::set<std::string> studies;
  std::set<std::string> modelings;
  const auto note = [&modelings](const auto& kind) {
    if constexpr (requires { kind.modelings; })
      for (const ModelingSettings& settings : kind.modelings) {
        modelings.insert(settings.label);
        modelings.insert(modeling_name(settings));
      }
  };
  for (const Study& study : model.studies) {
    studies.insert(study.name);
    std::visit(note, study.kind);
  }
  return check_names(arguments.studies, studies, "study") &&
         check_names(arguments.modelings, modelings, "modeling");
}

std::filesystem::path results_folder(const RunArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  return arguments.model.file.stem().string() + ".results";
}

/// What a quiet run still has to say: which modelings stopped, and why.
void print_stops(const Result& result) {
  for (const StudyResult& study : result.studies) {
    const auto* path = std::get_if<PathResult>(&study.content);
    if (!path && !study.termination.converged())
      print_error(fmt::format("{}: {}", study.name, study.termination.reason));
    for (const ModelingPath& modeling : path ? path->modelings : std::vector<ModelingPath>{})
      if (!modeling.termination.converged())
        print_error(
            fmt::format("{}: {}: {}", study.name, modeling.label, modeling.termination.reason));
  }
}

bool all_converged(const Result& result) {
  for (const StudyResult& study : result.studies)
    if (!study.termination.converged()) return false;
  return true;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const std::optional<Model> model = read_or_complain(arguments.model);
  if (!model || !names_exist(*model, arguments)) return wrong_input;

  RunOptions options;
  options.studies = arguments.studies;
  options.modelings = arguments.modelings;
  options.threads = arguments.threads;
  Result result = run_watched(*model, options, arguments.quiet);
  result.model_file = arguments.model.file.filename().string();

  const std::filesystem::path folder = results_folder(arguments);
  const WriteOutcome outcome = write_results(result, make_report(result), folder);
  if (!outcome.ok()) {
    print_error(outcome.error);
    return stopped_early;
  }
  if (arguments.quiet) {
    print_stops(result);
  } else {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    fmt::print("{}", make_comparison_table(result, is_coloured(STDOUT_FILENO)));
    fmt::print("\n{:.2f} s; report: {}\n", took.count(), (folder / "report.html").string());
  }
  return all_converged(result) ? all_finished : stopped_early;
}

int check_command(const ModelArguments& arguments, bool quiet) {
  const std::optional<Model> model = read_or_complain(arguments);
  if (!model) return wrong_input;
  if (!quiet)
    fmt::print("{}: no mistakes: {} bodies, {} flexures, {} studies\n", arguments.file.string(),
               model->bodies.size(), model->flexures.size(), model->studies.size());
  return all_finished;
}

int new_command(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) {
    print_error(fmt::format("'{}' exists already; choose another name", file.string()));
    return wrong_input;
  }
  std::ofstream out(file);
  out << starter_model();
  out.close();
  if (!out) {
    print_error(fmt::format("cannot write '{}'", file.string()));
    return wrong_input;
  }
  fmt::print("{0} written; next: flexura run {0}\n", file.string());
  return all_finished;
}

}  // namespace flexura::app

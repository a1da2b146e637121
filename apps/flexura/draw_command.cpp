#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "apps/flexura/commands.hpp"
#include "apps/flexura/input.hpp"
#include "apps/flexura/terminal.hpp"
#include "apps/flexura/watched_run.hpp"
#include "flexura/io/write_files.hpp"
#include "flexura/model/study_kind.hpp"
#include "flexura/pictures/picture.hpp"

namespace flexura::app {
namespace {

bool has_shape(const Study& study) { return can_be_drawn(study_kind(study)); }

/// The study to draw, or nothing and a message.
const Study* choose_study(const Model& model, const std::string& asked) {
  std::set<std::string> names;
  for (const Study& study : model.studies) names.insert(study.name);
  if (!asked.empty() && !check_names({asked}, names, "study")) return nullptr;
  const auto wanted = [&](const Study& study) {
    return asked.empty() ? has_shape(study) : study.name == asked;
  };
  const auto found = std::ranges::find_if(model.studies, wanted);
  if (found == model.studies.end()) {
    print_error(
        "the model has no study with a shape to draw; those of kind linear and response "
        "have none");
    return nullptr;
  }
  if (!has_shape(*found)) {
    print_error(fmt::format("study '{}' is of kind {}, which has no shape to draw", found->name,
                            study_kind(*found)));
    return nullptr;
  }
  return &*found;
}

/// The label of the modeling to draw, or nothing and a message. All methods of a linkage come out
/// of one run; an empty label stands for its reference.
std::optional<std::string> choose_modeling(const Study& study, const std::string& asked) {
  return std::visit(
      [&](const auto& kind) -> std::optional<std::string> {
        if constexpr (requires { kind.modelings; }) {
          if (asked.empty()) return kind.modelings[kind.reference].label;
          std::set<std::string> known;
          for (const ModelingSettings& settings : kind.modelings) {
            if (asked == settings.label || asked == modeling_name(settings)) return settings.label;
            known.insert({settings.label, modeling_name(settings)});
          }
          check_names({asked}, known, ("modeling in study '" + study.name + "' named").c_str());
          return {};
        } else {
          return asked;
        }
      },
      study.kind);
}

}  // namespace

int draw_command(const DrawArguments& arguments) {
  const std::optional<Model> model = read_or_complain(arguments.model);
  if (!model) return wrong_input;
  const Study* study = choose_study(*model, arguments.study);
  if (study == nullptr) return wrong_input;
  const std::optional<std::string> label = choose_modeling(*study, arguments.modeling);
  if (!label) return wrong_input;

  RunOptions options;
  options.studies = {study->name};
  if (!std::holds_alternative<LinkageStudy>(study->kind)) options.modelings = {*label};
  const Result result = run_watched(*model, options, arguments.quiet);
  PictureRequest request;
  request.study = study->name;
  request.modeling = *label;
  request.mode = static_cast<std::size_t>(arguments.mode);
  request.moving = !arguments.still;
  if (arguments.exaggeration > 0.0) request.exaggeration = arguments.exaggeration;
  const Picture picture = make_picture(result, request);
  if (!picture.ok()) {
    print_error(picture.error);
    return wrong_input;
  }
  std::filesystem::path file = arguments.output;
  if (file.empty()) file = arguments.model.file.stem().string() + ".svg";
  const WriteOutcome outcome =
      write_files(file.parent_path(), {OutputFile{file.filename(), picture.svg}});
  if (!outcome.ok()) {
    print_error(outcome.error);
    return stopped_early;
  }
  const Termination& termination = result.studies.front().termination;
  if (!termination.converged())
    print_error(fmt::format("{}: {}; what converged is drawn", study->name, termination.reason));
  if (!arguments.quiet) fmt::print("{} written\n", file.string());
  return termination.converged() ? all_finished : stopped_early;
}

}  // namespace flexura::app

#include "apps/flexura/input.hpp"

#include <fmt/format.h>

#include "apps/flexura/terminal.hpp"
#include "flexura/core/nearest_word.hpp"
#include "flexura/io/model_reader.hpp"

namespace flexura::app {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::optional<Model> read_or_complain(const ModelArguments& arguments) {
  ParameterOverrides overrides;
  for (const std::string& assignment : arguments.assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      print_error(fmt::format("--set takes name=value, got '{}'", assignment));
      return {};
    }
    overrides[trimmed(assignment.substr(0, equals))] = trimmed(assignment.substr(equals + 1));
  }
  ModelReading reading = read_model(arguments.file, overrides);
  print_diagnostics(arguments.file.string(), reading.diagnostics);
  return std::move(reading.model);
}

bool check_names(const std::vector<std::string>& asked, const std::set<std::string>& known,
                 const char* what) {
  for (const std::string& name : asked) {
    if (known.contains(name)) continue;
    const std::vector<std::string> words(known.begin(), known.end());
    print_error(fmt::format("the model has no {} '{}'{}", what, name, suggestion(name, words)));
    return false;
  }
  return true;
}

}  // namespace flexura::app

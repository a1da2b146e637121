#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/flexura/commands.hpp"
#include "flexura/model/model.hpp"

namespace flexura::app {

/// Reads the model or says what is wrong with it.
std::optional<Model> read_or_complain(const ModelArguments& arguments);

/// False, with a message, where a name asked for on the command line is not in the model.
bool check_names(const std::vector<std::string>& asked, const std::set<std::string>& known,
                 const char* what);

}  // namespace flexura::app

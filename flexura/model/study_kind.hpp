#pragma once

#include <string>

#include "flexura/model/model.hpp"

namespace flexura {

/// What model files and results call a study's kind: "linear", "path", ..
std::string study_kind(const Study& study);

}  // namespace flexura

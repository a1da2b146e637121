#pragma once

#include <optional>
#include <string>

#include "flexura/model/model.hpp"

namespace flexura {

/// Why a mechanism's tangent at rest is singular, and what to do, from System::softest_body.
std::string describe_singular(const Model& model, std::optional<std::size_t> softest_body);

}  // namespace flexura

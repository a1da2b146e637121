#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "flexura/core/diagnostics.hpp"

namespace flexura {

/// No model file is longer (bytes).
inline constexpr std::size_t longest_model_text = std::size_t{4} << 20U;

/// What to say of a longer one; size 0 is unknown.
std::string too_long_message(std::uintmax_t size);

/// What makes a text no candidate for a model at all: too long, binary, not UTF-8, or nested so
/// deep that reading it would exhaust the stack. Nothing is said about its syntax.
std::optional<Diagnostic> check_text(std::string_view text);

}  // namespace flexura

#pragma once

#include <optional>

#include "flexura/core/time_history.hpp"
#include "flexura/io/reading.hpp"

namespace flexura {

/// A `history`: a table that names a kind, or an expression of the time `t` and the parameters.
/// Nothing after a mistake.
std::optional<TimeHistory> read_history(Reading& reading, const Place& place);

}  // namespace flexura

#pragma once

#include <optional>

#include "flexura/core/time_history.hpp"
#include "flexura/io/reading.hpp"

namespace flexura {

/// What a history is over.
enum class HistoryVariable { time, angle };

/// A `history`: a table that names a kind, or an expression of the time `t`, or of the `angle`, and
/// the parameters. Nothing after a mistake.
std::optional<TimeHistory> read_history(Reading& reading, const Place& place,
                                        HistoryVariable variable = HistoryVariable::time);

}  // namespace flexura

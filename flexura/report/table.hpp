#pragma once

#include <string>

#include "flexura/results/result.hpp"

namespace flexura {

/// The comparison of modelings for a terminal: per study a row per modeling, with what it cost and
/// how far it is off, and events and stop reasons below the row; of modes the first values, of a
/// response the highest peak. A study of kind linear gets one line. `colour` adds ANSI escapes.
std::string make_comparison_table(const Result& result, bool colour);

}  // namespace flexura

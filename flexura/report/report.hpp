#pragma once

#include <string>

#include "flexura/results/result.hpp"

namespace flexura {

/// The report as one self-contained HTML page: style, scripts, plotting library and the results
/// themselves are inside it, and it asks the network for nothing.
std::string make_report(const Result& result);

}  // namespace flexura

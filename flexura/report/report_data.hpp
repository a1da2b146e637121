#pragma once

#include <string>

#include "flexura/results/result.hpp"

namespace flexura {

/// What the page's scripts draw from: the results as JSON, rounded to seven significant digits
/// (the files beside the report carry every digit), safe inside a script element.
std::string make_report_data(const Result& result);

}  // namespace flexura

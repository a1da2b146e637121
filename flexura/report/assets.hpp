#pragma once

#include <string_view>

namespace flexura {

/// A file of flexura/report/page (or "d3.min.js") as it was when the library was built. Empty
/// where there is no such file. Its definition is written by cmake/report_assets.cmake.
std::string_view report_asset(std::string_view file_name);

}  // namespace flexura

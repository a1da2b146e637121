#pragma once

#include <filesystem>
#include <string>

#include "flexura/io/write_files.hpp"
#include "flexura/results/result.hpp"

namespace flexura {

/// Writes the result folder: summary.json, report.html (the text given) and a folder per study
/// with its CSV and JSON files. All of them or, on an error, none.
WriteOutcome write_results(const Result& result, const std::string& report_html,
                           const std::filesystem::path& folder);

}  // namespace flexura

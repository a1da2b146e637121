#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flexura {

/// No file of a history is longer (bytes).
inline constexpr std::size_t longest_history_file = std::size_t{64} << 20U;

/// Two columns of a CSV file with a line of names at its head.
struct HistoryColumns {
  std::string file;  ///< as the user wrote it, for messages
  std::string time;
  std::string value;
};

/// The rows, or what is wrong and which of the keys "file", "time" and "value" it concerns.
struct HistoryFileReading {
  std::vector<double> times;
  std::vector<double> values;
  std::string error;
  std::string key = "file";
};

/// Commas separate fields, which may stand in double quotes; empty lines do not count. Whatever is
/// wrong comes back as an error; places in the file are "file:line:column".
HistoryFileReading read_history_file(const std::filesystem::path& path,
                                     const HistoryColumns& columns);
/// The same of a file's text.
HistoryFileReading read_history_text(std::string_view text, const HistoryColumns& columns);

}  // namespace flexura

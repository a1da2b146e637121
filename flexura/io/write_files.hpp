#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace flexura {

/// Whether writing succeeded: `error` is a sentence that names the file and the cause, empty if
/// everything was written.
struct WriteOutcome {
  std::string error;

  bool ok() const { return error.empty(); }
};

struct OutputFile {
  std::filesystem::path name;  ///< relative to the folder
  std::string content;
  /// Makes the content at the time of writing, where that is too large to be kept; or nothing.
  std::function<std::string()> make = {};
};

/// Writes all files or none: every file is first written in full beside its place, and only when
/// all are complete do they take their names. What else is in the folder stays; on an error
/// nothing in it has changed, and folders made for the files are gone again. Names must differ.
WriteOutcome write_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace flexura

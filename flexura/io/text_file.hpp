#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace flexura {

/// The text of a file, or why it cannot be read.
struct TextReading {
  std::string text;
  std::string error;
};

/// Opening a named pipe waits for a writer that may never come; others have theirs.
bool is_named_pipe(const std::filesystem::path& path);

/// A file of at most `longest` bytes. `shown` is how the user wrote its name, for messages.
TextReading read_text_file(const std::filesystem::path& path, const std::string& shown,
                           std::size_t longest);

/// Without what is blank at its ends.
std::string_view trimmed(std::string_view text);

/// A part of a file for a message: not long, and nothing that a terminal would act on.
std::string shown_text(std::string_view text);

}  // namespace flexura

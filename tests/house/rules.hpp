#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flexura::house {

/// Ways in which a source breaks the rules of the house, each as "file:line: what". `file` is
/// the path from the top of the checkout; the rules depend on where a source lives.
using Offences = std::vector<std::string>;

/// Rooms: what stands in flexura/ or apps/ includes its own room and rooms of lower rank, and
/// one modeling never includes another.
Offences room_offences(std::string_view file, std::string_view text);

/// Hygiene: #pragma once heads every header, lines have at most 100 columns, files at most 400
/// lines.
Offences hygiene_offences(std::string_view file, std::string_view text);

/// C++ sources in the named folders of the checkout, as paths from its top.
std::vector<std::string> sources_in(const std::vector<std::string>& folders);

/// Markdown documents at the top of the checkout and in its docs, as paths from its top.
std::vector<std::string> documents();

/// Text of a file, by its path from the top of the checkout.
std::string read_text(const std::string& file);

}  // namespace flexura::house

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexura {

/// Columns that UTF-8 text takes on a terminal, one per code point.
std::size_t display_width(std::string_view text);

/// The words of `text` in lines of at most `width` columns; a longer word has a line to itself.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width);

}  // namespace flexura

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexura {

/// Edits (insert, delete, replace, swap neighbours) that turn one word into the other; letters
/// that differ in case only cost nothing.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The valid word that `word` was most likely meant to be: the first of those with the fewest
/// edits, if they are few for a word of this length; else the first that it abbreviates; otherwise
/// nothing.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> valid);

/// "; did you mean 'thickness'?" where a valid word is near; otherwise "; valid: a, b, c" if
/// there are not many, or nothing. Made to follow "unknown key 'thicknes'".
std::string suggestion(std::string_view word, std::span<const std::string> valid);

}  // namespace flexura

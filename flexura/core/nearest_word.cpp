#include "flexura/core/nearest_word.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace flexura {
namespace {

// Beyond these a suggestion helps nobody, and a hostile file could make the search slow.
constexpr std::size_t longest_word = 64;
constexpr std::size_t most_words = 2000;
constexpr std::size_t most_listed = 16;

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment, three rows of the table at a time.
  std::array<std::vector<std::size_t>, 3> rows;
  for (auto& row : rows) row.resize(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto& now = rows[i % 3];
    const auto& above = rows[(i + 2) % 3];
    const auto& two_above = rows[(i + 1) % 3];
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = above[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      now[j] = std::min({above[j] + 1, now[j - 1] + 1, replace});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1])) {
        now[j] = std::min(now[j], two_above[j - 2] + 1);
      }
    }
  }
  return rows[a.size() % 3][b.size()];
}

std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> valid) {
  if (word.empty() || word.size() > longest_word || valid.size() > most_words) return {};
  const std::size_t allowed = std::max<std::size_t>(1, word.size() / 3);
  const std::string* best = nullptr;
  std::size_t fewest = allowed + 1;
  for (const std::string& candidate : valid) {
    if (candidate.size() > word.size() + allowed || candidate.size() + allowed < word.size()) {
      continue;
    }
    const std::size_t edits = edit_distance(word, candidate);
    // A word of one letter is near to every other one: then only a difference in case counts.
    if (edits >= std::max(word.size(), candidate.size())) continue;
    // Of words as near, one that goes on as this one begins is meant.
    const bool goes_on =
        best && edits == fewest && candidate.starts_with(word) && !best->starts_with(word);
    if (edits < fewest || goes_on) {
      best = &candidate;
      fewest = edits;
    }
  }
  if (best) return *best;
  // Nor is a word far from what it abbreviates.
  constexpr std::size_t shortest_abbreviation = 3;
  for (const std::string& candidate : valid) {
    if (word.size() >= shortest_abbreviation && candidate.starts_with(word)) return candidate;
  }
  return {};
}

std::string suggestion(std::string_view word, std::span<const std::string> valid) {
  if (const auto near = nearest_word(word, valid)) return "; did you mean '" + *near + "'?";
  if (valid.empty() || valid.size() > most_listed) return {};
  std::string text = "; valid: ";
  for (const std::string& candidate : valid) {
    if (&candidate != valid.data()) text += ", ";
    text += candidate.size() <= longest_word ? candidate : candidate.substr(0, longest_word) + "..";
  }
  return text;
}

}  // namespace flexura

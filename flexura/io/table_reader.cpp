#include "flexura/io/table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "flexura/core/nearest_word.hpp"

namespace flexura {
namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Near words are looked for among the planned ones too: better to hear of the word that was
/// meant than of one that happens to be available.
std::string suggest(const std::string& word, const Vocabulary& vocabulary) {
  std::vector<std::string> all = vocabulary.keys;
  all.insert(all.end(), vocabulary.planned.begin(), vocabulary.planned.end());
  return nearest_word(word, all) ? suggestion(word, all) : suggestion(word, vocabulary.keys);
}

}  // namespace

TableReader::TableReader(Reading& reading, const Place& place, const Vocabulary& vocabulary)
    : reading_(reading), place_(place) {
  if (place.node->table()) {
    report_unknown_keys(vocabulary);
  } else {
    report_unexpected(reading, place, "a table");
  }
}

void TableReader::report_unknown_keys(const Vocabulary& vocabulary) {
  for (const TomlEntry& entry : *place_.node->table()) {
    if (contains(vocabulary.keys, entry.key)) continue;
    if (contains(vocabulary.planned, entry.key)) {
      has_planned_ = true;
      reading_.report_key(place_.path, entry.key, entry.position,
                          fmt::format("'{}' is not available yet", entry.key));
      continue;
    }
    unknown_.push_back(entry.key);
    // What was meant is there, though not understood: no rule shall miss it.
    if (const auto meant = nearest_word(entry.key, vocabulary.keys)) {
      reading_.spoil(place_.path / *meant);
    }
    reading_.report_key(
        place_.path, entry.key, entry.position,
        fmt::format("unknown key '{}'{}", entry.key, suggest(entry.key, vocabulary)));
  }
}

bool TableReader::nearly_there(const std::string& key) const {
  const std::vector<std::string> wanted = {key};
  return std::any_of(unknown_.begin(), unknown_.end(), [&wanted](const std::string& unknown) {
    return nearest_word(unknown, wanted).has_value();
  });
}

SourcePosition TableReader::position(const std::string& key) const {
  const TomlEntry* entry = place_.node->find(key);
  return entry ? entry->position : place_.node->position;
}

std::optional<Place> TableReader::find(const std::string& key) const {
  const TomlEntry* entry = place_.node->find(key);
  if (!entry) return {};
  return Place{&entry->node, place_.path / key};
}

std::optional<Place> TableReader::require(const std::string& key) {
  auto place = find(key);
  if (place || !place_.node->table()) return place;
  if (nearly_there(key)) {
    reading_.spoil(place_.path / key);
  } else {
    reading_.report_key(place_.path, key, place_.node->position,
                        fmt::format("missing key '{}'", key));
  }
  return {};
}

double TableReader::quantity(const std::string& key, const Dimension& dimension, double fallback) {
  return optional_quantity(key, dimension).value_or(fallback);
}

double TableReader::required_quantity(const std::string& key, const Dimension& dimension) {
  const auto place = require(key);
  return place ? read_quantity(reading_, *place, dimension).value_or(0.0) : 0.0;
}

std::optional<double> TableReader::optional_quantity(const std::string& key,
                                                     const Dimension& dimension) {
  const auto place = find(key);
  if (!place) return {};
  return read_quantity(reading_, *place, dimension);
}

Vec2 TableReader::vector(const std::string& key, const Dimension& dimension, Vec2 fallback) {
  const auto place = find(key);
  return place ? read_vector(reading_, *place, dimension).value_or(fallback) : fallback;
}

bool TableReader::boolean(const std::string& key, bool fallback) {
  const auto place = find(key);
  return place ? read_boolean(reading_, *place).value_or(fallback) : fallback;
}

int TableReader::integer(const std::string& key, int fallback) {
  const auto place = find(key);
  return place ? read_integer(reading_, *place).value_or(fallback) : fallback;
}

std::optional<std::string> TableReader::exactly_one_of(std::span<const std::string> keys) {
  std::vector<std::string> found;
  for (const std::string& key : keys) {
    if (has(key)) found.push_back(key);
  }
  if (found.size() == 1) return found.front();
  const bool near =
      std::any_of(keys.begin(), keys.end(), [this](const auto& key) { return nearly_there(key); });
  if (found.size() > 1) {
    reading_.report_key(place_.path, found[1], position(found[1]),
                        fmt::format("both '{}' and '{}' are given; only one of {} may be", found[0],
                                    found[1], fmt::join(keys, ", ")));
  } else if (place_.node->table() && !near && !has_planned_) {
    reading_.report(place_.path, place_.node->position,
                    fmt::format("one of {} is missing", fmt::join(keys, ", ")));
  }
  reading_.spoil(place_.path);
  return {};
}

std::optional<std::string> read_word(Reading& reading, const Place& place, const std::string& what,
                                     const Vocabulary& words) {
  auto word = read_text(reading, place);
  if (!word || contains(words.keys, *word)) return word;
  if (contains(words.planned, *word)) {
    reading.report(place.path, place.node->position,
                   fmt::format("{} '{}' is not available yet", what, *word));
  } else {
    reading.report(place.path, place.node->position,
                   fmt::format("unknown {} '{}'{}", what, *word, suggest(*word, words)));
  }
  return {};
}

}  // namespace flexura

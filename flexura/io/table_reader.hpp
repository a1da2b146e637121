#pragma once

#include <optional>
#include <span>
#include <string>

#include "flexura/io/reading.hpp"
#include "flexura/io/vocabulary.hpp"

namespace flexura {

/// Reads one table whose keys are known beforehand. Keys outside the vocabulary are reported when
/// it is made; a value that is no table is reported too and then counts as one without any key.
class TableReader {
 public:
  /// `what` names the table's kind in messages, as in "keys of a body"; may be empty.
  TableReader(Reading& reading, const Place& place, const Vocabulary& vocabulary);

  bool has(const std::string& key) const { return place_.node->find(key) != nullptr; }
  /// Position of the key if it is there, of the table otherwise.
  SourcePosition position(const std::string& key) const;
  KeyPath path(const std::string& key) const { return place_.path / key; }
  const KeyPath& path() const { return place_.path; }

  /// The value of a key; nothing if it is not there.
  std::optional<Place> find(const std::string& key) const;
  /// Likewise, but its absence is reported, unless the table itself or a key that is nearly the
  /// same was reported before.
  std::optional<Place> require(const std::string& key);

  /// A quantity, or `fallback` where there is none or after a mistake.
  double quantity(const std::string& key, const Dimension& dimension, double fallback);
  double required_quantity(const std::string& key, const Dimension& dimension);
  std::optional<double> optional_quantity(const std::string& key, const Dimension& dimension);
  Vec2 vector(const std::string& key, const Dimension& dimension, Vec2 fallback);
  bool boolean(const std::string& key, bool fallback);
  int integer(const std::string& key, int fallback);

  /// Which of these keys the table has; reports if it has none, or the second if it
  /// has several.
  std::optional<std::string> exactly_one_of(std::span<const std::string> keys);

 private:
  void report_unknown_keys(const Vocabulary& vocabulary);
  bool nearly_there(const std::string& key) const;

  Reading& reading_;
  Place place_;
  std::vector<std::string> unknown_;
  bool has_planned_ = false;
};

/// Which of the words a text is; reports others, with the nearest, and "not available yet" for
/// planned ones. `what` says what it would be: "modeling", "study kind".
std::optional<std::string> read_word(Reading& reading, const Place& place, const std::string& what,
                                     const Vocabulary& words);

}  // namespace flexura

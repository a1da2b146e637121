#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "flexura/core/diagnostics.hpp"

namespace flexura {

struct TomlEntry;

/// A value of a TOML file and where it stands. Tables keep the order of the file: "first" always
/// means first in the file.
struct TomlNode {
  struct Date {};
  using Array = std::vector<TomlNode>;
  using Table = std::vector<TomlEntry>;

  SourcePosition position;
  std::variant<Table, Array, std::string, std::int64_t, double, bool, Date> value;

  const Table* table() const { return std::get_if<Table>(&value); }
  const Array* array() const { return std::get_if<Array>(&value); }
  const std::string* string() const { return std::get_if<std::string>(&value); }
  /// The entry of a table; null if this is no table or has no such key.
  const TomlEntry* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  SourcePosition position;  ///< of the key
  TomlNode node;
};

/// "a table", "a list", "the text \"abc\"", "the number 3", "true", ..: for messages.
std::string describe(const TomlNode& node);

/// Either the whole document or the one syntax error that ended its reading.
struct TomlReading {
  std::optional<TomlNode> root;
  std::optional<Diagnostic> error;
};

/// Precondition: check_text has no objection, which bounds how deep the document nests.
TomlReading read_toml(std::string_view text);

}  // namespace flexura

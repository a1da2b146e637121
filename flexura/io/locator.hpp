#pragma once

#include <string_view>
#include <unordered_map>

#include "flexura/io/toml_document.hpp"
#include "flexura/model/validation.hpp"

namespace flexura {

/// Finds where in a file the things stand that paths lead to.
class Locator {
 public:
  /// Precondition: `root` outlives the locator.
  explicit Locator(const TomlNode& root) : root_(root) {}

  /// The position of what a path leads to (its key for a table, else its value), or of the last
  /// thing on the way that is there.
  SourcePosition locate(const KeyPath& path);

 private:
  const TomlEntry* find(const TomlNode& table, std::string_view key);

  using Index = std::unordered_map<std::string_view, const TomlEntry*>;
  const TomlNode& root_;
  std::unordered_map<const TomlNode*, Index> large_tables_;
};

}  // namespace flexura

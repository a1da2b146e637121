#include "flexura/io/locator.hpp"

#include <charconv>

namespace flexura {

const TomlEntry* Locator::find(const TomlNode& table, std::string_view key) {
  // A list of bodies can be long, and every one of them mistaken.
  constexpr std::size_t large = 16;
  const TomlNode::Table* entries = table.table();
  if (!entries || entries->size() < large) return table.find(key);
  const auto [at, is_new] = large_tables_.try_emplace(&table);
  if (is_new) {
    for (const TomlEntry& entry : *entries) at->second.emplace(entry.key, &entry);
  }
  const auto entry = at->second.find(key);
  return entry == at->second.end() ? nullptr : entry->second;
}

SourcePosition Locator::locate(const KeyPath& path) {
  const TomlNode* node = &root_;
  SourcePosition position = root_.position;
  for (const std::string& key : path) {
    if (const TomlEntry* entry = find(*node, key)) {
      node = &entry->node;
      position = node->table() ? entry->position : node->position;
      continue;
    }
    const TomlNode::Array* elements = node->array();
    std::size_t index = 0;
    if (!elements || !key.starts_with('[')) break;
    std::from_chars(key.data() + 1, key.data() + key.size(), index);
    if (index >= elements->size()) break;
    node = &(*elements)[index];
    position = node->position;
  }
  return position;
}

}  // namespace flexura

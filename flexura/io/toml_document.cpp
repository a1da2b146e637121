#include "flexura/io/toml_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>

namespace flexura {
namespace {

SourcePosition position_of(const toml::source_region& region) {
  // Values that the syntax only implies have no place of their own.
  return {std::max(1, static_cast<int>(region.begin.line)),
          std::max(1, static_cast<int>(region.begin.column))};
}

TomlNode convert(const toml::node& node);

TomlNode::Table convert_table(const toml::table& table) {
  TomlNode::Table entries;
  entries.reserve(table.size());
  for (const auto& [key, node] : table) {
    entries.push_back({std::string(key.str()), position_of(key.source()), convert(node)});
  }
  // toml++ sorts tables by name.
  std::stable_sort(entries.begin(), entries.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.position < b.position; });
  return entries;
}

TomlNode convert(const toml::node& node) {
  TomlNode result;
  result.position = position_of(node.source());
  if (const auto* table = node.as_table()) {
    result.value = convert_table(*table);
  } else if (const auto* array = node.as_array()) {
    TomlNode::Array elements;
    elements.reserve(array->size());
    for (const toml::node& element : *array) elements.push_back(convert(element));
    result.value = std::move(elements);
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.value = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.value = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    result.value = boolean->get();
  } else {
    result.value = TomlNode::Date{};
  }
  return result;
}

/// What stands at a position; empty at the end of the text.
std::string_view text_from(std::string_view text, SourcePosition position) {
  for (int line = 1; line < position.line; ++line) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(std::min(text.size(), static_cast<std::size_t>(position.column - 1)));
}

/// "0.1 mm" without its quotes: the reading stops at a letter that follows a number.
bool is_bare_unit(std::string_view text, SourcePosition position) {
  const std::string_view rest = text_from(text, position);
  if (rest.empty() || std::isalpha(static_cast<unsigned char>(rest[0])) == 0) return false;
  const std::string_view before = text.substr(0, text.size() - rest.size());
  const auto last = before.find_last_not_of(' ');
  return last != std::string_view::npos &&
         std::isdigit(static_cast<unsigned char>(before[last])) != 0;
}

/// toml++'s name of a type, as the rest of the messages say it.
std::string plain_kind(const std::string& kind) {
  if (kind == "floating-point" || kind == "integer") return "a number";
  if (kind == "boolean") return "true or false";
  if (kind == "string") return "a text";
  if (kind == "array") return "a list";
  return "a " + kind;
}

std::string redefinition_message(const std::string& text, std::size_t at) {
  constexpr std::string_view phrase = "cannot redefine existing ";
  const auto name = text.find('\'', at);
  if (name == std::string::npos) return "TOML: " + text.substr(at);
  const std::string kind = text.substr(at + phrase.size(), name - at - phrase.size() - 1);
  return fmt::format("{} is already defined above, as {}", text.substr(name), plain_kind(kind));
}

/// toml++'s sentence in the words of someone who writes a model.
std::string syntax_message(std::string message, std::string_view text, SourcePosition position) {
  if (const auto at = message.find("cannot redefine existing "); at != std::string::npos) {
    return redefinition_message(message, at);
  }
  const std::string_view rest = text_from(text, position);
  const bool line_ends = rest.empty() || rest[0] == '\n' || rest[0] == '\r';
  if (line_ends && message.find("unescaped control characters") != std::string::npos) {
    return "TOML syntax error: the text that begins on this line lacks its closing quote";
  }
  const auto replace = [&message](std::string_view from, std::string_view to) {
    const auto at = message.find(from);
    if (at != std::string::npos) message.replace(at, from.size(), to);
  };
  replace("Error while parsing a", "in an a");
  replace("Error while parsing i", "in an i");
  replace("Error while parsing", "in a");
  replace("in an array", "in a list");
  replace("key-value pair", "line \"key = value\"");
  replace("encountered end-of-file", "the file ends here");
  replace("saw '\\n'", "but the line ends here");
  if (is_bare_unit(text, position)) message += "; a quantity with a unit stands in quotes";
  return "TOML syntax error " + message;
}

}  // namespace

const TomlEntry* TomlNode::find(std::string_view key) const {
  const Table* entries = table();
  if (!entries) return nullptr;
  const auto at = std::find_if(entries->begin(), entries->end(),
                               [key](const TomlEntry& entry) { return entry.key == key; });
  return at == entries->end() ? nullptr : &*at;
}

std::string describe(const TomlNode& node) {
  struct Describe {
    std::string operator()(const TomlNode::Table&) const { return "a table"; }
    std::string operator()(const TomlNode::Array& a) const {
      return a.empty() ? "an empty list" : fmt::format("a list of {}", a.size());
    }
    std::string operator()(const std::string& s) const {
      constexpr std::size_t longest = 60;
      return s.size() <= longest ? fmt::format("\"{}\"", s)
                                 : fmt::format("\"{}..\"", s.substr(0, longest));
    }
    std::string operator()(std::int64_t i) const { return fmt::format("{}", i); }
    std::string operator()(double d) const { return fmt::format("{}", d); }
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(const TomlNode::Date&) const { return "a date or time"; }
  };
  return std::visit(Describe{}, node.value);
}

TomlReading read_toml(std::string_view text) {
  try {
    const toml::table root = toml::parse(text);
    TomlNode node;
    node.value = convert_table(root);
    return {std::move(node), std::nullopt};
  } catch (const toml::parse_error& error) {
    const SourcePosition position = position_of(error.source());
    return {std::nullopt,
            Diagnostic{position, syntax_message(std::string(error.description()), text, position)}};
  }
}

}  // namespace flexura

#include "flexura/io/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "flexura/core/nearest_word.hpp"

namespace flexura {

void Reading::report(const KeyPath& path, SourcePosition position, const std::string& message) {
  diagnostics_.push_back({position, path.empty() ? message : to_text(path) + ": " + message});
  mistaken_.insert(path);
}

void Reading::report_key(const KeyPath& table, const std::string& key, SourcePosition position,
                         const std::string& message) {
  diagnostics_.push_back({position, table.empty() ? message : to_text(table) + ": " + message});
  mistaken_.insert(table / key);
}

void Reading::warn(const KeyPath& path, SourcePosition position, const std::string& message) {
  diagnostics_.push_back({position, to_text(path) + ": " + message, Severity::warning});
}

bool Reading::has_mistake(const KeyPath& path) const {
  for (std::size_t length = 0; length <= path.size(); ++length) {
    const auto last = path.begin() + static_cast<std::ptrdiff_t>(length);
    if (mistaken_.contains(KeyPath(path.begin(), last))) return true;
  }
  const auto next = mistaken_.lower_bound(path);
  return next != mistaken_.end() && next->size() >= path.size() &&
         std::equal(path.begin(), path.end(), next->begin());
}

void report_unexpected(Reading& reading, const Place& place, const std::string& what) {
  reading.report(place.path, place.node->position,
                 fmt::format("expected {}, got {}", what, describe(*place.node)));
}

namespace {

void report_formula(Reading& reading, const KeyPath& path, SourcePosition position,
                    const std::string& quoted, const std::string& why) {
  reading.report(path, position, fmt::format("cannot evaluate {}: {}", quoted, why));
}

}  // namespace

bool check_formula(Reading& reading, const KeyPath& path, SourcePosition position,
                   const std::string& formula, const std::string& quoted,
                   const std::vector<std::string>& variables) {
  const Formulas::Names undefined = reading.formulas.undefined_names(formula);
  if (!undefined.error.empty()) {
    report_formula(reading, path, position, quoted, undefined.error);
    return false;
  }
  std::vector<std::string> known = variables;
  known.insert(known.end(), reading.parameter_names.begin(), reading.parameter_names.end());
  bool spoilt = false;
  for (const std::string& name : undefined.names) {
    if (std::find(variables.begin(), variables.end(), name) != variables.end()) continue;
    if (!reading.spoilt_parameters.contains(name)) {
      report_formula(reading, path, position, quoted,
                     fmt::format("unknown parameter '{}'{}", name, suggestion(name, known)));
      return false;
    }
    spoilt = true;
  }
  if (spoilt) reading.spoil(path);
  return !spoilt;
}

std::optional<double> evaluate(Reading& reading, const KeyPath& path, SourcePosition position,
                               const std::string& formula, const std::string& quoted) {
  if (!check_formula(reading, path, position, formula, quoted)) return {};
  const Formulas::Value value = reading.formulas.evaluate(formula);
  if (!value.value) report_formula(reading, path, position, quoted, value.error);
  return value.value;
}

namespace {

std::string expectation(const Dimension& dimension) {
  if (dimension == dimensions::number) return "a number";
  return fmt::format("{}, e.g. {}", describe(dimension), example_of(dimension));
}

/// A string that is no expression, in declared units.
std::optional<double> read_quantity_text(Reading& reading, const Place& place,
                                         const Dimension& dimension) {
  if (dimension == dimensions::number) {
    report_unexpected(reading, place, "a number or an expression like \"= 2*t\"");
    return {};
  }
  const QuantityReading result = read_quantity(*place.node->string());
  if (!result.quantity) {
    reading.report(place.path, place.node->position,
                   fmt::format("expected {}, got {}: {}", expectation(dimension),
                               describe(*place.node), result.error));
    return {};
  }
  const Dimension& found = result.quantity->unit.dimension;
  if (found != dimension) {
    reading.report(place.path, place.node->position,
                   fmt::format("expected {}, got {} {}", expectation(dimension), describe(found),
                               describe(*place.node)));
    return {};
  }
  return reading.units.value_of(*result.quantity);
}

std::optional<double> read_declared(Reading& reading, const Place& place,
                                    const Dimension& dimension) {
  const TomlNode& node = *place.node;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    return static_cast<double>(*integer);
  }
  if (const auto* number = std::get_if<double>(&node.value)) return *number;
  if (const std::string* text = node.string()) {
    if (const auto formula = formula_of(*text)) {
      return evaluate(reading, place.path, node.position, *formula, describe(node));
    }
    return read_quantity_text(reading, place, dimension);
  }
  report_unexpected(reading, place, expectation(dimension));
  return {};
}

}  // namespace

std::optional<double> read_quantity(Reading& reading, const Place& place,
                                    const Dimension& dimension) {
  auto value = read_declared(reading, place, dimension);
  if (!value) return {};
  value = reading.units.with_radians(*value, dimension);
  if (!std::isfinite(*value)) {
    reading.report(place.path, place.node->position,
                   fmt::format("expected a finite number, got {}", describe(*place.node)));
    return {};
  }
  // Sections go with the fourth power of a thickness: beyond this, sums overflow.
  constexpr double largest = 1e60;
  if (std::abs(*value) > largest) {
    reading.report(place.path, place.node->position,
                   fmt::format("{} is beyond {:g}, the largest number that is computed with",
                               describe(*place.node), largest));
    return {};
  }
  return value;
}

std::optional<Vec2> read_vector(Reading& reading, const Place& place, const Dimension& dimension) {
  const TomlNode::Array* pair = place.node->array();
  if (!pair || pair->size() != 2) {
    report_unexpected(reading, place, "two components [x, y]");
    return {};
  }
  const auto x = read_quantity(reading, {&(*pair)[0], place.path / std::size_t{0}}, dimension);
  const auto y = read_quantity(reading, {&(*pair)[1], place.path / std::size_t{1}}, dimension);
  if (!x || !y) return {};
  return Vec2{*x, *y};
}

std::optional<bool> read_boolean(Reading& reading, const Place& place) {
  if (const bool* value = std::get_if<bool>(&place.node->value)) return *value;
  report_unexpected(reading, place, "true or false");
  return {};
}

std::optional<int> read_integer(Reading& reading, const Place& place) {
  const auto* value = std::get_if<std::int64_t>(&place.node->value);
  // What lies beyond an int is beyond every rule as well, which then names the bounds.
  constexpr std::int64_t largest = std::numeric_limits<int>::max();
  if (value) return static_cast<int>(std::clamp(*value, -largest, largest));
  report_unexpected(reading, place, "a whole number");
  return {};
}

std::optional<std::string> read_text(Reading& reading, const Place& place) {
  if (const std::string* text = place.node->string()) return *text;
  report_unexpected(reading, place, "a text in quotes");
  return {};
}

std::vector<Place> read_list(Reading& reading, const Place& place, const std::string& of_what) {
  std::vector<Place> places;
  if (const TomlNode::Array* elements = place.node->array()) {
    for (std::size_t i = 0; i < elements->size(); ++i) {
      places.push_back({&(*elements)[i], place.path / i});
    }
  } else {
    report_unexpected(reading, place, "a list of " + of_what);
  }
  return places;
}

std::vector<NamedPlace> read_names(Reading& reading, const Place& place) {
  std::vector<NamedPlace> places;
  if (const TomlNode::Table* entries = place.node->table()) {
    for (const TomlEntry& entry : *entries) {
      places.push_back({entry.key, entry.position, {&entry.node, place.path / entry.key}});
    }
  } else {
    report_unexpected(reading, place, "a table of names");
  }
  return places;
}

}  // namespace flexura

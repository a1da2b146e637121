#include "flexura/io/read_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "flexura/io/history_file.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

/// What histories are over, in words and numbers.
struct Variable {
  std::string letter;
  std::string values;  ///< "times"
  Dimension dimension;
  Dimension frequency;
};
Variable variable_of(HistoryVariable kind) {
  if (kind == HistoryVariable::angle)
    return {"angle", "angles", dimensions::angle, dimensions::number};
  return {"t", "times", dimensions::time, dimensions::frequency};
}

/// Two values of a list, such as a time and a number; nothing after a mistake.
std::optional<std::pair<double, double>> read_pair(Reading& reading, const Place& place,
                                                   const std::string& what,
                                                   const Dimension& first_dimension,
                                                   const Dimension& second_dimension) {
  const TomlNode::Array* pair = place.node->array();
  if (!pair || pair->size() != 2) {
    report_unexpected(reading, place, what);
    return {};
  }
  const auto first = read_quantity(reading, {&(*pair)[0], place.path / 0}, first_dimension);
  const auto second = read_quantity(reading, {&(*pair)[1], place.path / 1}, second_dimension);
  if (!first || !second) return {};
  return std::pair{*first, *second};
}

TimeHistory read_ramp(Reading& reading, const Place& place, bool smooth, const Variable& over) {
  const auto times = read_pair(reading, place, "two " + over.values + " [start, end]",
                               over.dimension, over.dimension);
  return times ? RampHistory{times->first, times->second, smooth} : RampHistory{};
}

TimeHistory read_half_sine(Reading& reading, const Place& place, const Variable& over) {
  TableReader table(reading, place, vocabulary::half_sine());
  return HalfSineHistory{table.quantity("start", over.dimension, 0.0),
                         table.required_quantity("duration", over.dimension)};
}

/// Cycles per time are angular frequencies in the model; over an angle, a frequency is an order.
TimeHistory read_harmonic(Reading& reading, const Place& place, const Variable& over) {
  TableReader table(reading, place, vocabulary::harmonic());
  const double frequency = table.required_quantity("frequency", over.frequency);
  return HarmonicHistory{over.letter == "t" ? 2.0 * std::numbers::pi * frequency : frequency,
                         table.quantity("phase", dimensions::angle, 0.0)};
}

TimeHistory read_table(Reading& reading, const Place& place, bool smooth, const Variable& over) {
  std::vector<double> times, values;
  for (const Place& row : read_list(reading, place, "rows [time, value]")) {
    const auto pair =
        read_pair(reading, row, "a row [time, value]", over.dimension, dimensions::number);
    times.push_back(pair ? pair->first : 0.0);
    values.push_back(pair ? pair->second : 0.0);
  }
  return TableHistory{std::move(times), std::move(values), smooth};
}

/// The columns of a file beside the model file.
TimeHistory read_file(Reading& reading, TableReader& table, const Place& place, bool smooth) {
  HistoryColumns columns;
  const auto read_key = [&](const std::optional<Place>& at, std::string& text) {
    const auto read = at ? read_text(reading, *at) : std::nullopt;
    text = read.value_or("");
    return read.has_value();
  };
  const bool file = read_key(place, columns.file);
  const bool time = read_key(table.require("time"), columns.time);
  const bool value = read_key(table.require("value"), columns.value);
  if (!file || !time || !value) return TableHistory{};
  HistoryFileReading result = read_history_file(reading.folder / columns.file, columns);
  if (!result.error.empty())
    reading.report(table.path(result.key), table.find(result.key)->node->position, result.error);
  return TableHistory{std::move(result.times), std::move(result.values), smooth};
}

/// Keys that belong to some kinds only.
void refuse_others(Reading& reading, TableReader& table, const std::string& kind) {
  const auto refuse = [&](const char* key, const char* why) {
    if (table.has(key)) reading.report_key(table.path(), key, table.position(key), why);
  };
  if (kind != "ramp" && kind != "table" && kind != "file")
    refuse("smooth", "only a ramp, a table and a file can be smooth or not");
  if (kind == "file") return;
  refuse("time", "only a file has columns to choose");
  refuse("value", "only a file has columns to choose");
}

/// A function of t (or of the angle), whatever parameter may have that name.
std::optional<TimeHistory> read_expression(Reading& reading, const Place& place,
                                           const std::string& formula, const std::string& letter) {
  const std::string quoted = describe(*place.node);
  if (!check_formula(reading, place.path, place.node->position, formula, quoted, {letter}))
    return {};
  const Formulas::Function function = reading.formulas.function_of(letter, formula);
  if (function.function) return FunctionHistory{function.function};
  reading.report(place.path, place.node->position,
                 fmt::format("cannot evaluate {}: {}", quoted, function.error));
  return {};
}

}  // namespace

std::optional<TimeHistory> read_history(Reading& reading, const Place& place,
                                        HistoryVariable variable) {
  const Variable over = variable_of(variable);
  if (const std::string* text = place.node->string()) {
    if (const auto formula = formula_of(*text))
      return read_expression(reading, place, *formula, over.letter);
  }
  if (!place.node->table()) {
    report_unexpected(reading, place,
                      "a history: { ramp = [0, 1] } or the like, or an expression of the time "
                      "such as \"= sin(3*t)\"");
    return {};
  }
  static const std::vector<std::string> kinds = {"step",     "ramp",  "half_sine",
                                                 "harmonic", "table", "file"};
  TableReader table(reading, place, vocabulary::history());
  const auto kind = table.exactly_one_of(kinds);
  if (!kind) return {};
  refuse_others(reading, table, *kind);
  const bool smooth = table.boolean("smooth", false);
  const Place inside = *table.find(*kind);
  TimeHistory history = StepHistory{};
  if (*kind == "step") history = StepHistory{table.required_quantity("step", over.dimension)};
  if (*kind == "ramp") history = read_ramp(reading, inside, smooth, over);
  if (*kind == "half_sine") history = read_half_sine(reading, inside, over);
  if (*kind == "harmonic") history = read_harmonic(reading, inside, over);
  if (*kind == "table") history = read_table(reading, inside, smooth, over);
  if (*kind == "file" && variable == HistoryVariable::angle)
    reading.report(inside.path, inside.node->position,
                   "a file has a column of times; over an angle, a table has the values");
  else if (*kind == "file")
    history = read_file(reading, table, inside, smooth);
  if (reading.has_mistake(place.path)) return {};
  return history;
}

}  // namespace flexura

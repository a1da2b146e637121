#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/results/motion_result.hpp"
#include "flexura/results/result.hpp"
#include "flexura/results/safety.hpp"

// What the tables of all kinds of study are made of; included by report/*.cpp only.

namespace flexura::table {

constexpr std::size_t line_width = 96;
using Row = std::vector<std::string>;

enum class Ink { plain, bold, faint, good, bad };

std::string paint(std::string_view text, Ink ink, bool colour);

/// Three significant digits without an exponent where that stays short.
std::string number(double value);
std::string duration(double seconds);
std::string percent(const std::optional<double>& fraction);

/// "Hz", or "1/ms": cycles per time unit.
std::string frequency_unit(const std::string& time_unit);

/// The study's name and kind, and what its modelings are compared with, if so.
std::string headline(const StudyResult& study, const std::string& reference, bool colour);

/// Words below the row they belong to.
std::string note(const std::string& words, Ink ink, bool colour);

/// Why a modeling stopped; `place` says where ("at load factor 0.7: "), empty if nowhere. Of one
/// that has converged, what is to be said nevertheless, if anything.
std::string termination_note(const Termination& termination, const std::string& place, bool colour);

/// A modeling's cells, and what is to be said of it below them.
struct Line {
  Row cells;
  bool converged = false;
  std::string notes;
};

/// Two columns of words to the left, numbers to the right; every line has a cell for each title.
std::string lay_out(const Row& titles, const std::vector<Line>& lines, bool colour);

/// The label, and whether it converged: where every line begins.
template <class Modeling>
Row first_cells(const Modeling& modeling) {
  return {modeling.label, modeling.termination.converged() ? "converged" : "stopped"};
}

/// The error estimate, and the difference from the reference: where every line ends.
template <class Modeling>
void add_errors(Row& row, const Modeling& modeling, bool is_reference) {
  row.push_back(percent(modeling.error_estimate));
  row.push_back(is_reference ? "reference" : percent(modeling.difference));
}

/// A column for the safety, where a strength is stated.
void add_safety(Row& titles, std::vector<Line>& lines,
                const std::vector<std::optional<Safety>>& safeties);

/// Tables of studies of kind `transient` and `response`.
std::string motion_table(const Result& result, const StudyResult& study, const MotionResult& motion,
                         bool colour);
std::string response_table(const Result& result, const StudyResult& study,
                           const ResponseResult& response, bool colour);
/// Of a study of kind `linkage`.
std::string linkage_table(const Result& result, const StudyResult& study,
                          const LinkageResult& linkage, bool colour);

}  // namespace flexura::table

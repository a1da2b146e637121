#include "flexura/report/table.hpp"

#include <algorithm>
#include <numbers>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "flexura/report/table_parts.hpp"
#include "flexura/report/wrap.hpp"

namespace flexura {
namespace {

using namespace table;

Row cells_of(const ModelingPath& m, bool is_reference) {
  Row cells = first_cells(m);
  for (const int count : {m.unknowns, m.steps, m.iterations})
    cells.push_back(std::to_string(count));
  cells.push_back(duration(m.seconds));
  add_errors(cells, m, is_reference);
  return cells;
}

/// Events on the way and why it stopped, below the row they belong to.
std::string notes(const PathResult& path, const ModelingPath& m,
                  const std::optional<Safety>& safety, bool colour) {
  std::string text;
  for (const PathEvent& event : m.events) {
    text += note(fmt::format("{} at load factor {:.4g}", event.kind, event.load_factor), Ink::faint,
                 colour);
  }
  if (safety && safety->reached) {
    text += note(fmt::format("strength of {} reached at load factor {:.4g}",
                             path.flexures[safety->reached->flexure], safety->reached->load_factor),
                 Ink::bad, colour);
  }
  const std::string place =
      m.states.empty() ? "" : fmt::format("at load factor {:.4g}: ", m.states.back().load_factor);
  return text + termination_note(m.termination, place, colour);
}

std::string path_table(const StudyResult& study, const PathResult& path, bool colour) {
  Row titles{"modeling",   "status", "unknowns",   "steps",
             "iterations", "time",   "error est.", "difference"};
  std::vector<Line> lines;
  std::vector<std::optional<Safety>> safeties;
  for (std::size_t i = 0; i < path.modelings.size(); ++i) {
    const ModelingPath& m = path.modelings[i];
    safeties.push_back(find_safety(path, m));
    lines.push_back({cells_of(m, i == path.reference), m.termination.converged(),
                     notes(path, m, safeties.back(), colour)});
  }
  add_safety(titles, lines, safeties);
  const bool compared = path.reference < path.modelings.size();
  return headline(study, compared ? path.modelings[path.reference].label : "", colour) +
         lay_out(titles, lines, colour);
}

/// The first load factors or, of kind `modes`, frequencies.
std::string mode_values(const Result& result, const StudyResult& study, const ModelingModes& m) {
  constexpr std::size_t shown = 4;
  const bool frequencies = study.kind == "modes";
  std::string text = frequencies ? "frequency" : "load factor";
  for (std::size_t k = 0; k < std::min(shown, m.modes.size()); ++k) {
    const double value = m.modes[k].value;
    if (frequencies && value < 0.0) {
      text += " unstable";
    } else {
      text += fmt::format(" {:.6g}", frequencies ? value / (2.0 * std::numbers::pi) : value);
    }
  }
  if (m.modes.size() > shown) text += " ..";
  if (m.modes.empty()) return text + " none";
  return frequencies ? text + ' ' + frequency_unit(result.time_unit) : text;
}

/// One line per modeling: its first values and how sure they are.
std::string mode_table(const Result& result, const StudyResult& study, const ModeResult& modes,
                       bool colour) {
  std::string text = headline(study, "", colour);
  std::size_t width = 0;
  for (const ModelingModes& m : modes.modelings) width = std::max(width, display_width(m.label));
  for (std::size_t i = 0; i < modes.modelings.size(); ++i) {
    const ModelingModes& m = modes.modelings[i];
    const bool converged = m.termination.converged();
    text += "  " + m.label + std::string(width - display_width(m.label), ' ') + "  ";
    text +=
        converged ? paint("converged", Ink::good, colour) : paint("stopped  ", Ink::bad, colour);
    text += "  " + mode_values(result, study, m);
    if (m.error_estimate) text += "  error est. " + percent(m.error_estimate);
    if (i == modes.reference) text += "  reference";
    if (m.difference) text += "  difference " + percent(m.difference);
    text += "  " + duration(m.seconds) + '\n';
    text += note(m.termination.reason, converged ? Ink::faint : Ink::bad, colour);
  }
  return text;
}

std::string linear_line(const StudyResult& study, const LinearResult& linear, bool colour) {
  std::string text =
      fmt::format("{}  linear, {} compliance matrices: {}/ellipse.json\n",
                  paint(study.name, Ink::bold, colour), linear.records.size(), study.name);
  if (!study.termination.converged()) {
    for (const std::string& line :
         wrap_text("stopped: " + study.termination.reason, line_width - 2)) {
      text += "  " + paint(line, Ink::bad, colour) + '\n';
    }
  }
  return text;
}

}  // namespace

std::string make_comparison_table(const Result& result, bool colour) {
  std::string text;
  for (const StudyResult& study : result.studies) {
    if (!text.empty()) text += '\n';
    if (const auto* path = std::get_if<PathResult>(&study.content)) {
      text += path_table(study, *path, colour);
    } else if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
      text += mode_table(result, study, *modes, colour);
    } else if (const auto* motion = std::get_if<MotionResult>(&study.content)) {
      text += motion_table(result, study, *motion, colour);
    } else if (const auto* response = std::get_if<ResponseResult>(&study.content)) {
      text += response_table(result, study, *response, colour);
    } else if (const auto* linkage = std::get_if<LinkageResult>(&study.content)) {
      text += linkage_table(result, study, *linkage, colour);
    } else {
      text += linear_line(study, std::get<LinearResult>(study.content), colour);
    }
  }
  return text;
}

}  // namespace flexura

#include "flexura/report/table.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "flexura/report/wrap.hpp"
#include "flexura/results/safety.hpp"

namespace flexura {
namespace {

constexpr std::size_t line_width = 96;
using Row = std::vector<std::string>;

enum class Ink { plain, bold, faint, good, bad };

std::string paint(std::string_view text, Ink ink, bool colour) {
  static constexpr std::string_view escapes[] = {"", "\x1b[1m", "\x1b[2m", "\x1b[32m", "\x1b[31m"};
  if (!colour || ink == Ink::plain) return std::string(text);
  return fmt::format("{}{}\x1b[0m", escapes[static_cast<int>(ink)], text);
}

/// Three significant digits without an exponent where that stays short.
std::string number(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e5) return fmt::format("{:.2e}", value);
  const int decimals = 2 - static_cast<int>(std::floor(std::log10(size)));
  return fmt::format("{:.{}f}", value, std::max(0, decimals));
}

std::string duration(double seconds) {
  if (seconds < 1e-3) return number(1e6 * seconds) + " us";
  if (seconds < 1.0) return number(1e3 * seconds) + " ms";
  return number(seconds) + " s";
}

std::string percent(const std::optional<double>& fraction) {
  return fraction && std::isfinite(*fraction) ? number(100.0 * *fraction) + " %" : "-";
}

/// The columns of every table; a last one where a strength is stated.
Row row_of(const ModelingPath& m, bool is_reference, const std::optional<Safety>& safety) {
  Row row{m.label,
          m.termination.converged() ? "converged" : "stopped",
          std::to_string(m.unknowns),
          std::to_string(m.steps),
          std::to_string(m.iterations),
          duration(m.seconds),
          percent(m.error_estimate),
          is_reference ? "reference" : percent(m.difference)};
  if (safety) row.push_back(safety->factor ? number(*safety->factor) : "-");
  return row;
}

/// Two columns of words to the left, numbers to the right.
std::string align(const Row& row, const std::vector<std::size_t>& widths, Ink status_ink,
                  bool colour) {
  std::string line = " ";
  for (std::size_t c = 0; c < row.size(); ++c) {
    const std::string gap(widths[c] - display_width(row[c]), ' ');
    const bool left = c < 2;
    // Escapes take no room on the screen, so they are put around what is already measured.
    const std::string text = c == 1 ? paint(row[c], status_ink, colour) : row[c];
    line += ' ' + (left ? text + gap : gap + text) + (c + 1 < row.size() ? " " : "");
  }
  return line + '\n';
}

/// Events on the way and why it stopped, below the row they belong to.
std::string notes(const PathResult& path, const ModelingPath& m,
                  const std::optional<Safety>& safety, bool colour) {
  std::string text;
  const auto add = [&](const std::string& note, Ink ink) {
    for (const std::string& line : wrap_text(note, line_width - 6)) {
      text += "      " + paint(line, ink, colour) + '\n';
    }
  };
  for (const PathEvent& event : m.events) {
    add(fmt::format("{} at load factor {:.4g}", event.kind, event.load_factor), Ink::faint);
  }
  if (safety && safety->reached) {
    add(fmt::format("strength of {} reached at load factor {:.4g}",
                    path.flexures[safety->reached->flexure], safety->reached->load_factor),
        Ink::bad);
  }
  if (!m.termination.converged()) {
    const std::string place =
        m.states.empty() ? "" : fmt::format("at load factor {:.4g}: ", m.states.back().load_factor);
    const std::string& reason = m.termination.reason;
    add("stopped " + place + (reason.empty() ? "no reason was given" : reason), Ink::bad);
  }
  return text;
}

std::string path_table(const StudyResult& study, const PathResult& path, bool colour) {
  std::vector<Row> rows{{"modeling", "status", "unknowns", "steps", "iterations", "time",
                         "error est.", "difference"}};
  std::vector<std::optional<Safety>> safeties;
  for (std::size_t m = 0; m < path.modelings.size(); ++m) {
    safeties.push_back(find_safety(path, path.modelings[m]));
    rows.push_back(row_of(path.modelings[m], m == path.reference, safeties.back()));
  }
  if (std::ranges::any_of(safeties, [](const auto& safety) { return safety.has_value(); })) {
    rows.front().emplace_back("safety");
    // Of a modeling that never began nothing is known.
    for (Row& row : rows) row.resize(rows.front().size(), "-");
  }
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], display_width(row[c]));
    }
  }
  std::string text = paint(study.name, Ink::bold, colour) + "  " + study.kind;
  if (path.reference < path.modelings.size()) {
    text += ", compared with " + path.modelings[path.reference].label;
  }
  text += '\n' + paint(align(rows.front(), widths, Ink::plain, false), Ink::faint, colour);
  for (std::size_t m = 0; m < path.modelings.size(); ++m) {
    const ModelingPath& modeling = path.modelings[m];
    text +=
        align(rows[m + 1], widths, modeling.termination.converged() ? Ink::good : Ink::bad, colour);
    text += notes(path, modeling, safeties[m], colour);
  }
  return text;
}

/// One line per modeling: its first load factors and how sure they are.
std::string mode_table(const StudyResult& study, const ModeResult& modes, bool colour) {
  constexpr std::size_t shown = 4;
  std::string text = paint(study.name, Ink::bold, colour) + "  " + study.kind + '\n';
  std::size_t width = 0;
  for (const ModelingModes& m : modes.modelings) width = std::max(width, display_width(m.label));
  for (std::size_t i = 0; i < modes.modelings.size(); ++i) {
    const ModelingModes& m = modes.modelings[i];
    text += "  " + m.label + std::string(width - display_width(m.label), ' ') + "  ";
    text += m.termination.converged() ? paint("converged", Ink::good, colour)
                                      : paint("stopped  ", Ink::bad, colour);
    text += "  load factor";
    for (std::size_t k = 0; k < std::min(shown, m.modes.size()); ++k)
      text += fmt::format(" {:.6g}", m.modes[k].value);
    if (m.modes.size() > shown) text += " ..";
    if (m.modes.empty()) text += " none";
    if (m.error_estimate) text += "  error est. " + percent(m.error_estimate);
    if (i == modes.reference) text += "  reference";
    if (m.difference) text += "  difference " + percent(m.difference);
    text += "  " + duration(m.seconds) + '\n';
    for (const std::string& line : wrap_text(m.termination.reason, line_width - 6))
      text +=
          "      " + paint(line, m.termination.converged() ? Ink::faint : Ink::bad, colour) + '\n';
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
      text += mode_table(study, *modes, colour);
    } else {
      text += linear_line(study, std::get<LinearResult>(study.content), colour);
    }
  }
  return text;
}

}  // namespace flexura

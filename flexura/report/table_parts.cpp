#include "flexura/report/table_parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexura/report/wrap.hpp"

namespace flexura::table {
namespace {

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

}  // namespace

std::string paint(std::string_view text, Ink ink, bool colour) {
  static constexpr std::string_view escapes[] = {"", "\x1b[1m", "\x1b[2m", "\x1b[32m", "\x1b[31m"};
  if (!colour || ink == Ink::plain) return std::string(text);
  return fmt::format("{}{}\x1b[0m", escapes[static_cast<int>(ink)], text);
}

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

std::string frequency_unit(const std::string& time_unit) {
  return time_unit == "s" ? "Hz" : "1/" + time_unit;
}

std::string headline(const StudyResult& study, const std::string& reference, bool colour) {
  std::string text = paint(study.name, Ink::bold, colour) + "  " + study.kind;
  if (!reference.empty()) text += ", compared with " + reference;
  return text + '\n';
}

std::string note(const std::string& words, Ink ink, bool colour) {
  std::string text;
  for (const std::string& line : wrap_text(words, line_width - 6)) {
    text += "      " + paint(line, ink, colour) + '\n';
  }
  return text;
}

std::string termination_note(const Termination& termination, const std::string& place,
                             bool colour) {
  const std::string& reason = termination.reason;
  if (termination.converged())
    return reason.empty() ? std::string() : note(reason, Ink::faint, colour);
  return note("stopped " + place + (reason.empty() ? "no reason was given" : reason), Ink::bad,
              colour);
}

void add_safety(Row& titles, std::vector<Line>& lines,
                const std::vector<std::optional<Safety>>& safeties) {
  if (std::ranges::none_of(safeties, [](const auto& safety) { return safety.has_value(); })) return;
  titles.emplace_back("safety");
  for (std::size_t m = 0; m < lines.size(); ++m) {
    const std::optional<Safety>& safety = safeties[m];
    lines[m].cells.push_back(safety && safety->factor ? number(*safety->factor) : "-");
  }
}

std::string lay_out(const Row& titles, const std::vector<Line>& lines, bool colour) {
  std::vector<std::size_t> widths(titles.size(), 0);
  const auto widen = [&](const Row& row) {
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], display_width(row[c]));
  };
  widen(titles);
  for (const Line& line : lines) widen(line.cells);
  std::string text = paint(align(titles, widths, Ink::plain, false), Ink::faint, colour);
  for (const Line& line : lines) {
    text += align(line.cells, widths, line.converged ? Ink::good : Ink::bad, colour) + line.notes;
  }
  return text;
}

}  // namespace flexura::table

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "flexura/report/table_parts.hpp"
#include "flexura/results/linkage_peaks.hpp"

namespace flexura::table {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string bands_note(const Result& result, const LinkageResult& linkage, bool colour) {
  std::string words = "frequencies over the turn, " + frequency_unit(result.time_unit) + ":";
  const auto bands = frequency_bands(linkage);
  if (bands.empty()) return {};
  constexpr double turn = 2.0 * std::numbers::pi;
  for (std::size_t k = 0; k < std::min<std::size_t>(4, bands.size()); ++k)
    words += fmt::format("{} {} to {}", k == 0 ? "" : ",", number(bands[k].least / turn),
                         number(bands[k].greatest / turn));
  return note(words, Ink::faint, colour);
}

std::string stability_note(const LinkageResult& linkage, bool colour) {
  if (linkage.multipliers.empty()) return {};
  const double largest = std::abs(linkage.multipliers.front());
  const bool stable = largest < 1.0;
  return note(
      fmt::format("largest multiplier of Floquet {}: {}", number(largest),
                  stable ? "the periodic motion is stable" : "the periodic motion is unstable"),
      stable ? Ink::faint : Ink::bad, colour);
}

}  // namespace

std::string linkage_table(const Result& result, const StudyResult& study,
                          const LinkageResult& linkage, bool colour) {
  Row titles{"method", "status", "unknowns", "time", "error est.", "difference", "largest stress"};
  std::vector<Line> lines;
  for (std::size_t i = 0; i < linkage.modelings.size(); ++i) {
    const LinkageMotion& m = linkage.modelings[i];
    Row cells = first_cells(m);
    cells.push_back(std::to_string(m.unknowns));
    cells.push_back(duration(m.seconds));
    add_errors(cells, m, i == linkage.reference);
    CurvePeak worst;
    std::size_t where = 0;
    for (std::size_t k = 0; k < m.flexures.size(); ++k) {
      const CurvePeak peak = find_peak(linkage, m.flexures[k].stress);
      if (peak.value <= worst.value) continue;
      worst = peak;
      where = k;
    }
    cells.push_back(m.flexures.empty()
                        ? ""
                        : fmt::format("{} at {:.0f} deg, {}", number(worst.value),
                                      worst.angle / degree, linkage.flexures[where]));
    std::string notes = termination_note(m.termination, "", colour);
    if (m.iterations > 0)
      notes += note(fmt::format("{} {}", m.iterations, m.counted), Ink::faint, colour);
    if (!m.remark.empty()) notes += note(m.remark, Ink::bad, colour);
    lines.push_back({std::move(cells), m.termination.converged(), std::move(notes)});
  }
  std::string text =
      headline(study, lines.empty() ? "" : linkage.modelings[linkage.reference].label, colour);
  if (!lines.empty()) text += lay_out(titles, lines, colour);
  if (lines.empty()) return text + termination_note(study.termination, "", colour);
  text += bands_note(result, linkage, colour) + stability_note(linkage, colour);
  for (const std::string& words : linkage.notes) text += note(words, Ink::plain, colour);
  return text;
}

}  // namespace flexura::table

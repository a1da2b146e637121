#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "flexura/report/table_parts.hpp"
#include "flexura/results/response_peaks.hpp"

namespace flexura::table {
namespace {

template <class Content>
std::string reference_label(const Content& content) {
  return content.reference < content.modelings.size() ? content.modelings[content.reference].label
                                                      : std::string();
}

std::string motion_notes(const Result& result, const MotionResult& motion, const ModelingMotion& m,
                         const std::optional<Safety>& safety, bool colour) {
  const auto at = [&](double time) { return fmt::format("at {:.4g} {}", time, result.time_unit); };
  std::string text;
  if (safety && safety->reached) {
    text += note(fmt::format("strength of {} reached {}", motion.flexures[safety->reached->flexure],
                             at(safety->reached->load_factor)),
                 Ink::bad, colour);
  }
  const std::string place = m.states.empty() ? "" : at(m.states.back().time) + ": ";
  return text + termination_note(m.termination, place, colour);
}

/// The highest peak of any displacement: of rotations, which have another unit, only where no
/// displacement has one.
std::string highest_peak(const Result& result, const ResponseResult& response,
                         const ModelingResponse& modeling) {
  std::optional<ResponsePeak> highest;
  for (const bool rotation : {false, true}) {
    if (highest) break;
    for (std::size_t place = 0; place < response.places.size(); ++place) {
      if (is_rotation(response, place) != rotation) continue;
      for (const ResponsePeak& peak : find_peaks(response, modeling, place))
        if (!highest || peak.amplitude > highest->amplitude) highest = peak;
    }
  }
  if (!highest) return "none";
  return fmt::format(
      "{} {} {} at {:.4g} {}", response.places[highest->place], number(highest->amplitude),
      is_rotation(response, highest->place) ? "rad" : result.length_unit,
      highest->angular_frequency / (2.0 * std::numbers::pi), frequency_unit(result.time_unit));
}

}  // namespace

std::string motion_table(const Result& result, const StudyResult& study, const MotionResult& motion,
                         bool colour) {
  // Iterations would make it wider than a terminal: they are in the summary.
  Row titles{"modeling", "status",       "unknowns",   "steps",
             "time",     "energy error", "error est.", "difference"};
  std::vector<Line> lines;
  std::vector<std::optional<Safety>> safeties;
  for (std::size_t i = 0; i < motion.modelings.size(); ++i) {
    const ModelingMotion& m = motion.modelings[i];
    safeties.push_back(find_safety(motion, m));
    Row cells = first_cells(m);
    for (const int count : {m.unknowns, m.steps}) cells.push_back(std::to_string(count));
    cells.push_back(duration(m.seconds));
    cells.push_back(percent(m.energy_error));
    add_errors(cells, m, i == motion.reference);
    lines.push_back({std::move(cells), m.termination.converged(),
                     motion_notes(result, motion, m, safeties.back(), colour)});
  }
  add_safety(titles, lines, safeties);
  return headline(study, reference_label(motion), colour) + lay_out(titles, lines, colour);
}

std::string response_table(const Result& result, const StudyResult& study,
                           const ResponseResult& response, bool colour) {
  const Row titles{"modeling",   "status",     "unknowns",    "time",
                   "error est.", "difference", "highest peak"};
  std::vector<Line> lines;
  for (std::size_t i = 0; i < response.modelings.size(); ++i) {
    const ModelingResponse& m = response.modelings[i];
    Row cells = first_cells(m);
    cells.push_back(std::to_string(m.unknowns));
    cells.push_back(duration(m.seconds));
    add_errors(cells, m, i == response.reference);
    cells.push_back(highest_peak(result, response, m));
    lines.push_back(
        {std::move(cells), m.termination.converged(), termination_note(m.termination, "", colour)});
  }
  return headline(study, reference_label(response), colour) + lay_out(titles, lines, colour);
}

}  // namespace flexura::table

#include "robustness/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "flexura/studies/arc_tracer.hpp"

namespace flexura::robustness {
namespace {

constexpr double alike = 1e-6;  // relative

/// Where a path ends: at full load or at its limit point.
struct PathEndState {
  bool limit = false;
  double load_factor = 0.0;
  double critical = INFINITY;  ///< load factor at which the path first turns critical
  double estimate = 0.0;       ///< of the last state's points (length)
  std::vector<Pose> poses;     ///< of the moving bodies
};

std::vector<Pose> poses_of(const Model& model, const System& system, const std::vector<double>& z) {
  std::vector<Pose> poses;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) poses.push_back(system.pose(b, z));
  return poses;
}

std::optional<PathEndState> end_of(const Model& model, const TracedPath& path) {
  if (path.states.empty()) return {};
  PathEndState end;
  for (const double error : path.states.back().errors) end.estimate = std::max(end.estimate, error);
  for (const TracedEvent& event : path.events) {
    if (event.kind == "stability lost" || event.kind == "limit point")
      end.critical = std::min(end.critical, event.load_factor);
    if (event.kind != "limit point") continue;
    end.limit = true;
    end.load_factor = event.load_factor;
    end.poses = poses_of(model, *path.systems[event.system], event.z);
    return end;
  }
  const TracedState& last = path.states.back();
  if (!path.termination.converged()) return {};
  end.load_factor = last.load_factor;
  end.poses = poses_of(model, *path.systems[last.system], last.z);
  return end;
}

/// Largest difference of the bodies' poses, relative to how far they have moved, in lengths.
double difference(const PathEndState& a, const PathEndState& b, const std::vector<Pose>& start,
                  double length) {
  double apart = 0.0, moved = 1e-6 * length;
  for (std::size_t k = 0; k < start.size(); ++k) {
    apart = std::max({apart, norm(a.poses[k].position - b.poses[k].position),
                      length * std::abs(a.poses[k].rotation - b.poses[k].rotation)});
    moved = std::max({moved, norm(a.poses[k].position - start[k].position),
                      length * std::abs(a.poses[k].rotation - start[k].rotation)});
  }
  return apart / moved;
}

/// Near a limit point places are only as good as the square root of the load factor.
bool same_end(const PathEndState& a, const PathEndState& b, const std::vector<Pose>& start,
              double length) {
  if (a.limit != b.limit) return false;
  if (a.limit) return std::abs(a.load_factor - b.load_factor) <= alike * std::abs(a.load_factor);
  const double allowed = alike + 10.0 * (a.estimate + b.estimate) / length;
  return difference(a, b, start, length) <= allowed;
}

/// Beyond the first critical state several branches lead on, and rounding decides; up to there both
/// must agree.
bool parted_where_critical(const PathEndState& a, const PathEndState& b) {
  return std::isfinite(a.critical) && std::abs(a.critical - b.critical) <= alike * a.critical;
}

/// Whether a path by arc length in short steps passes the end: its load factor with its poses.
bool is_on_branch(const RandomMechanism& mechanism, const PathEndState& end,
                  const std::vector<Pose>& start, double length) {
  PathStudy study = std::get<PathStudy>(mechanism.model.studies.front().kind);
  study.arc_length = true;
  study.steps = 200;  // steps of at most a hundredth of a length or radian
  study.until.load_factor = end.limit ? 2.0 : end.load_factor;
  if (end.limit) study.until.limit_points = 1;
  const TracedPath path = trace_by_arc_length(mechanism.model, study, study.modelings.front(), {});
  const auto found = end_of(mechanism.model, path);
  return found && same_end(*found, end, start, length);
}

}  // namespace

void compare_with_elements(const RandomMechanism& mechanism, const TracedPath& exact,
                           Verdict& verdict) {
  const Model& model = mechanism.model;
  const auto& study = std::get<PathStudy>(model.studies.front().kind);
  ModelingSettings elements = study.modelings.front();
  elements.kind = BeamSettings{6, 7, BeamSettings::Theory::exact};
  elements.label = "beam";
  const auto by_exact = end_of(model, exact);
  const System& system = *exact.systems.front();
  const std::vector<Pose> start = poses_of(model, system, system.initial_state());
  const double length = system.mean_length();
  TracedPath path;
  std::optional<PathEndState> by_elements;
  for (const int steps : {study.steps, 20 * study.steps}) {  // elements may lose their way, too
    path = trace_path(model, study.loads, elements, {steps});
    by_elements = end_of(model, path);
    if (by_elements && same_end(*by_exact, *by_elements, start, length)) {
      verdict.comparison = Verdict::Comparison::agrees;
      return;
    }
  }
  verdict.comparison_note =
      by_elements
          ? fmt::format(
                "{} {:.9g} by exact, {} {:.9g} by elements, first critical at "
                "{:.9g} and {:.9g}, difference {:.2g}, "
                "estimates {:.1g} and {:.1g} of a length",
                by_exact->limit ? "limit" : "end", by_exact->load_factor,
                by_elements->limit ? "limit" : "end", by_elements->load_factor, by_exact->critical,
                by_elements->critical, difference(*by_exact, *by_elements, start, length),
                by_exact->estimate / length, by_elements->estimate / length)
          : "elements: " + path.termination.reason;
  if ((by_elements && parted_where_critical(*by_exact, *by_elements)) ||
      is_on_branch(mechanism, *by_exact, start, length)) {
    verdict.comparison = Verdict::Comparison::other_branch;
    return;
  }
  verdict.comparison = Verdict::Comparison::differs;
  verdict.correct = false;
  verdict.category = "differs from elements";
  verdict.reason = verdict.comparison_note;
}

}  // namespace flexura::robustness

#include <functional>

#include "flexura/report/data_json.hpp"
#include "flexura/report/thinning.hpp"

// A motion may have thousands of output times. The page keeps up to 5000 of them for bodies,
// points, energies and reactions; up to 1250 of those for sections at mid-length and stresses; and
// up to 400 of these for the axes, which are by far the largest. Between those, axes follow the
// bodies at their ends (page/course.js).

namespace flexura::report_data {
namespace {

constexpr std::size_t most_fine = 5000;
constexpr std::size_t most_coarse = 1250;
constexpr std::size_t most_frames = 400;
constexpr std::size_t most_axis_points = 25;
constexpr std::size_t most_border_points = 150;  // of links of any shape: closed lines with corners

using Indices = std::vector<std::size_t>;
using Value = std::function<double(const MotionState&)>;

/// Of one modeling, at the times that are kept.
class Series {
 public:
  Series(const ModelingMotion& modeling, Indices kept)
      : states_(modeling.states), kept_(std::move(kept)) {}

  Json times() const {
    Json times = Json::array();
    for (const std::size_t i : kept_) times.push_back(rounded(states_[i].time));
    return times;
  }

  /// Values as whole numbers of a unit that is 1e-7 of the largest, which are short; from the
  /// first one on, so that small motions keep their digits wherever the mechanism lies.
  Json since_start(const Value& value) const {
    const double start = states_.empty() ? 0.0 : value(states_.front());
    return series(value, std::isfinite(start) ? start : 0.0);
  }
  Json plain(const Value& value) const { return series(value, 0.0); }

  template <class Part>
  Json poses(const Part& part, std::size_t count) const {
    Json list = Json::array();
    for (std::size_t k = 0; k < count; ++k) {
      const auto pose = [&part, k](const MotionState& m) -> const Pose& { return part(m)[k]; };
      list.push_back({since_start([&](const MotionState& m) { return pose(m).position.x; }),
                      since_start([&](const MotionState& m) { return pose(m).position.y; }),
                      since_start([&](const MotionState& m) { return pose(m).rotation; })});
    }
    return list;
  }

 private:
  Json series(const Value& value, double start) const {
    double largest = 0.0;
    for (const std::size_t i : kept_) {
      const double moved = value(states_[i]) - start;
      if (std::isfinite(moved)) largest = std::max(largest, std::abs(moved));
    }
    const double unit = 1e-7 * largest;
    Json values = Json::array();
    for (const std::size_t i : kept_) {
      const double moved = value(states_[i]) - start;
      if (!std::isfinite(moved)) {
        values.push_back(nullptr);
      } else {
        values.push_back(unit > 0.0 ? std::llround(moved / unit) : 0);
      }
    }
    return {{"start", start}, {"unit", unit}, {"values", std::move(values)}};
  }

  const std::vector<MotionState>& states_;
  Indices kept_;
};

Json fine_json(const MotionResult& motion, const Series& series) {
  Json points = Json::array();
  for (std::size_t p = 0; p < motion.points.size(); ++p) {
    points.push_back({series.since_start([p](const auto& m) { return m.state.points[p].x; }),
                      series.since_start([p](const auto& m) { return m.state.points[p].y; })});
  }
  const auto energy = [&](const auto& value) {
    return series.plain([&](const MotionState& m) { return value(m.energy); });
  };
  Json energies = {
      {"kinetic", energy([](const EnergyBalance& e) { return e.kinetic; })},
      {"strain", energy([](const EnergyBalance& e) { return e.strain; })},
      {"total", energy([](const EnergyBalance& e) { return e.kinetic + e.strain - e.work; })},
      {"dissipated", energy([](const EnergyBalance& e) { return e.dissipated; })},
      {"error", energy([](const EnergyBalance& e) { return e.error; })}};
  Json reactions = Json::array();
  for (std::size_t h = 0; h < motion.held.size(); ++h) {
    // The start may come without: nothing holds it.
    const auto reaction = [h](const MotionState& m) {
      return m.state.reactions.empty() ? Reaction{} : m.state.reactions[h];
    };
    reactions.push_back({series.plain([&](const MotionState& m) { return reaction(m).force.x; }),
                         series.plain([&](const MotionState& m) { return reaction(m).force.y; }),
                         series.plain([&](const MotionState& m) { return reaction(m).moment; })});
  }
  const auto bodies = [](const MotionState& m) -> const auto& { return m.state.bodies; };
  return {{"times", series.times()},
          {"bodies", series.poses(bodies, motion.bodies.size())},
          {"points", std::move(points)},
          {"energies", std::move(energies)},
          {"reactions", std::move(reactions)}};
}

Json coarse_json(const MotionResult& motion, const ModelingMotion& modeling, const Series& series) {
  const auto mids = [](const MotionState& m) -> const auto& { return m.state.mids; };
  Json json = {{"mids", series.poses(mids, motion.flexures.size())}};
  // Not every modeling knows stresses.
  const bool stressed = std::ranges::all_of(
      modeling.states, [](const MotionState& m) { return !m.state.peak_stresses.empty(); });
  for (std::size_t f = 0; stressed && f < motion.flexures.size(); ++f)
    json["peaks"].push_back(series.plain([f](const auto& m) { return m.state.peak_stresses[f]; }));
  return json;
}

std::vector<Vec2> drawn_axis(const std::vector<Vec2>& axis) {
  std::vector<Vec2> drawn;
  const bool closed = !axis.empty() && axis.front() == axis.back();
  const std::size_t most = closed ? most_border_points : most_axis_points;
  for (const std::size_t k : thinned(axis.size(), axis.size(), most)) drawn.push_back(axis[k]);
  return drawn;
}

Json axes_json(const ModelingMotion& modeling, const Indices& kept,
               const DrawnCoordinates& coordinates) {
  Json axes = Json::array();
  for (const std::size_t i : kept) {
    Json frame = Json::array();
    for (const auto& axis : modeling.states[i].state.axes)
      frame.push_back(coordinates(drawn_axis(axis)));
    axes.push_back(std::move(frame));
  }
  return axes;
}

Indices picked(const Indices& from, const Indices& which) {
  Indices list;
  for (const std::size_t i : which) list.push_back(from[i]);
  return list;
}

/// States that are kept, and which of those, counted among them, at coarser times.
struct Kept {
  Indices fine;
  Indices coarse;
  Indices frames;
};

Kept keep(std::size_t count, std::size_t longest) {
  Kept kept;
  kept.fine = thinned(count, longest, most_fine);
  const std::size_t longest_fine = thinned(longest, longest, most_fine).size();
  kept.coarse = thinned(kept.fine.size(), longest_fine, most_coarse);
  const std::size_t longest_coarse = thinned(longest_fine, longest_fine, most_coarse).size();
  kept.frames = picked(kept.coarse, thinned(kept.coarse.size(), longest_coarse, most_frames));
  return kept;
}

Json modeling_json(const MotionResult& motion, const ModelingMotion& modeling, std::size_t longest,
                   const DrawnCoordinates& coordinates) {
  Json json = modeling_head_json(modeling);
  json["steps"] = modeling.steps;
  json["rejected"] = modeling.rejected;
  json["iterations"] = modeling.iterations;
  json["smallest_step"] = rounded(modeling.smallest_step);
  json["largest_step"] = rounded(modeling.largest_step);
  json["energy_error"] = rounded(modeling.energy_error);
  json["safety"] = safety_json(find_safety(motion, modeling));
  if (const auto peak = find_largest_stress(modeling)) {
    json["largest_stress"] = {{"value", rounded(peak->stress)},
                              {"time", rounded(peak->time)},
                              {"flexure", peak->flexure}};
  }
  const Kept kept = keep(modeling.states.size(), longest);
  json["fine"] = fine_json(motion, {modeling, kept.fine});
  json["coarse"] = coarse_json(motion, modeling, {modeling, picked(kept.fine, kept.coarse)});
  json["coarse"]["at"] = kept.coarse;
  json["frames"] = {{"at", kept.frames},
                    {"axes", axes_json(modeling, picked(kept.fine, kept.frames), coordinates)}};
  json["members"] = members_json(modeling.members);
  return json;
}

}  // namespace

Json make_motion_json(const MotionResult& motion, const DrawnCoordinates& coordinates) {
  std::size_t longest = 0;
  for (const ModelingMotion& m : motion.modelings) longest = std::max(longest, m.states.size());
  Json modelings = Json::array();
  for (const ModelingMotion& m : motion.modelings)
    modelings.push_back(modeling_json(motion, m, longest, coordinates));
  Json json = names_json(motion);
  json["method"] = motion.method;
  json["damping"] = motion.damping;
  json["modelings"] = std::move(modelings);
  return json;
}

}  // namespace flexura::report_data

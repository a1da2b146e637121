#include <functional>

#include "flexura/report/data_json.hpp"
#include "flexura/report/thinning.hpp"

// A motion may have thousands of output times. The page keeps up to 5000 of them for what its
// plots are read for, bodies, points and energies; up to 1250 for sections at mid-length, stresses
// and reactions; and up to 400 for the axes, which it draws and which are by far the largest.
// Between those, axes follow the bodies at their ends (page/course.js).

namespace flexura::report_data {
namespace {

constexpr std::size_t most_fine = 5000;
constexpr std::size_t most_coarse = 1250;
constexpr std::size_t most_frames = 400;
constexpr std::size_t most_axis_points = 25;

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
  const auto bodies = [](const MotionState& m) -> const auto& { return m.state.bodies; };
  return {{"times", series.times()},
          {"bodies", series.poses(bodies, motion.bodies.size())},
          {"points", std::move(points)},
          {"energies", std::move(energies)}};
}

/// Stresses and reactions that some modeling does not know are left out.
Json coarse_json(const MotionResult& motion, const ModelingMotion& modeling, const Series& series) {
  const auto mids = [](const MotionState& m) -> const auto& { return m.state.mids; };
  Json json = {{"times", series.times()}, {"mids", series.poses(mids, motion.flexures.size())}};
  const auto all_have = [&](auto part) {
    return std::ranges::all_of(modeling.states,
                               [&](const MotionState& m) { return !part(m).empty(); });
  };
  if (all_have([](const auto& m) -> const auto& { return m.state.peak_stresses; })) {
    for (std::size_t f = 0; f < motion.flexures.size(); ++f)
      json["peaks"].push_back(
          series.plain([f](const auto& m) { return m.state.peak_stresses[f]; }));
  }
  for (std::size_t h = 0; h < motion.held.size(); ++h) {
    // The start may come without: nothing holds it.
    const auto reaction = [h](const MotionState& m) {
      return m.state.reactions.empty() ? Reaction{} : m.state.reactions[h];
    };
    json["reactions"].push_back(
        {series.plain([&](const MotionState& m) { return reaction(m).force.x; }),
         series.plain([&](const MotionState& m) { return reaction(m).force.y; }),
         series.plain([&](const MotionState& m) { return reaction(m).moment; })});
  }
  return json;
}

std::vector<Vec2> drawn_axis(const std::vector<Vec2>& axis) {
  std::vector<Vec2> drawn;
  for (const std::size_t k : thinned(axis.size(), axis.size(), most_axis_points))
    drawn.push_back(axis[k]);
  return drawn;
}

Json frames_json(const ModelingMotion& modeling, const Indices& kept,
                 const DrawnCoordinates& coordinates) {
  Json axes = Json::array();
  for (const std::size_t i : kept) {
    Json frame = Json::array();
    for (const auto& axis : modeling.states[i].state.axes)
      frame.push_back(coordinates(drawn_axis(axis)));
    axes.push_back(std::move(frame));
  }
  return {{"times", Series(modeling, kept).times()}, {"axes", std::move(axes)}};
}

Json modeling_json(const MotionResult& motion, const ModelingMotion& modeling, std::size_t longest,
                   const DrawnCoordinates& coordinates) {
  const auto kept = [&](std::size_t most) {
    return thinned(modeling.states.size(), longest, most);
  };
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
  json["fine"] = fine_json(motion, {modeling, kept(most_fine)});
  json["coarse"] = coarse_json(motion, modeling, {modeling, kept(most_coarse)});
  json["frames"] = frames_json(modeling, kept(most_frames), coordinates);
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

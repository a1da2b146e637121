#include "flexura/report/data_json.hpp"
#include "flexura/report/difference.hpp"

namespace flexura::report_data {
namespace {

Json state_json(const PathState& state, const DrawnCoordinates& coordinates) {
  Json bodies = Json::array();
  for (const Pose& pose : state.bodies) {
    bodies.push_back({rounded(pose.position.x), rounded(pose.position.y), rounded(pose.rotation)});
  }
  Json points = Json::array();
  for (const Vec2 p : state.points) points.push_back(pair(p));
  Json mids = Json::array();
  for (const Pose& mid : state.mids) {
    mids.push_back({rounded(mid.position.x), rounded(mid.position.y), rounded(mid.rotation)});
  }
  Json axes = Json::array();
  for (const std::vector<Vec2>& axis : state.axes) axes.push_back(coordinates(axis));
  Json json = {{"load_factor", rounded(state.load_factor)},
               {"bodies", std::move(bodies)},
               {"points", std::move(points)},
               {"mids", std::move(mids)},
               {"axes", std::move(axes)},
               {"unstable", state.unstable_directions > 0}};
  for (const double peak : state.peak_stresses) json["peaks"].push_back(rounded(peak));
  if (!state.reactions.empty()) {
    Json& reactions = json["reactions"] = Json::array();
    for (const Reaction& r : state.reactions) {
      reactions.push_back({rounded(r.force.x), rounded(r.force.y), rounded(r.moment)});
    }
  }
  return json;
}

Json stage_json(const std::optional<StageState>& stage) {
  if (!stage) return nullptr;
  const auto& centre = stage->instant_centre;
  return {{"soft", optional_number(stage->soft)},
          {"stiff", optional_number(stage->stiff)},
          {"soft_direction", rounded(stage->soft_direction)},
          {"across", rounded(stage->across)},
          {"rotation", rounded(stage->rotation)},
          {"drift", centre ? Json(rounded(stage->centre_drift)) : Json(nullptr)},
          {"geometric", optional_number(stage->geometric_advantage)},
          {"mechanical", optional_number(stage->mechanical_advantage)}};
}

Json condensed_json(const CondensedStiffness& condensed) {
  Json matrix = Json::array();
  for (const double entry : condensed.matrix) matrix.push_back(rounded(entry));
  return {{"load_factor", rounded(condensed.load_factor)}, {"matrix", std::move(matrix)}};
}

Json modeling_json(const PathResult& path, std::size_t index, const DrawnCoordinates& coordinates) {
  const ModelingPath& m = path.modelings[index];
  Json states = Json::array();
  for (const PathState& state : m.states) states.push_back(state_json(state, coordinates));
  Json events = Json::array();
  for (const PathEvent& event : m.events) {
    Json json = {{"kind", event.kind}, {"load_factor", rounded(event.load_factor)}};
    if (!event.state.bodies.empty()) json["state"] = state_json(event.state, coordinates);
    events.push_back(std::move(json));
  }
  Json reaction_events = Json::array();
  for (const ReactionEvent& event : m.reaction_events) {
    const bool halt = event.kind == ReactionEvent::Kind::halt;
    reaction_events.push_back({{"kind", halt ? "snap force" : "equilibrium"},
                               {"load_factor", rounded(event.load_factor)},
                               {"reaction", rounded(event.reaction)},
                               {"stable", event.stable},
                               {"state", state_json(event.state, coordinates)}});
  }
  Json stage = Json::array();
  for (const auto& state : m.stage) stage.push_back(stage_json(state));
  Json condensed = Json::array();
  for (const CondensedStiffness& c : m.condensed) condensed.push_back(condensed_json(c));
  Json differences = Json::array();
  if (index != path.reference) {
    for (std::size_t p = 0; p < path.points.size() + path.bodies.size(); ++p) {
      Json series = Json::array();
      for (const double d : difference_series(path, m, p)) series.push_back(rounded(d));
      differences.push_back(std::move(series));
    }
  }
  Json json = modeling_head_json(m);
  json["steps"] = m.steps;
  json["iterations"] = m.iterations;
  json["safety"] = safety_json(find_safety(path, m));
  json["events"] = std::move(events);
  json["reaction_events"] = std::move(reaction_events);
  json["states"] = std::move(states);
  json["stage"] = std::move(stage);
  json["condensed"] = std::move(condensed);
  json["differences"] = std::move(differences);
  json["members"] = members_json(m.members);
  json["stress_fields"] = stress_fields_json(m, coordinates);
  return json;
}

}  // namespace

Json members_json(const std::vector<std::vector<MemberStation>>& members) {
  Json list = Json::array();
  for (const std::vector<MemberStation>& stations : members) {
    Json rows = Json::array();
    for (const MemberStation& m : stations) {
      rows.push_back({rounded(m.s), rounded(m.axial_force), rounded(m.shear_force),
                      rounded(m.bending_moment), rounded(m.stress), rounded(m.section.position.x),
                      rounded(m.section.position.y)});
    }
    list.push_back(std::move(rows));
  }
  return list;
}

Json safety_json(const std::optional<Safety>& safety) {
  if (!safety) return nullptr;
  Json reached;
  if (safety->reached) {
    reached = {{"flexure", safety->reached->flexure},
               {"load_factor", rounded(safety->reached->load_factor)}};
  }
  return {{"factor", optional_number(safety->factor)}, {"reached", std::move(reached)}};
}

Json make_path_json(const PathResult& path, const DrawnCoordinates& coordinates) {
  Json modelings = Json::array();
  for (std::size_t m = 0; m < path.modelings.size(); ++m) {
    modelings.push_back(modeling_json(path, m, coordinates));
  }
  Json json = names_json(path);
  json["stage"] = path.stage;
  json["condensed"] = path.condensed;
  json["modelings"] = std::move(modelings);
  return json;
}

}  // namespace flexura::report_data

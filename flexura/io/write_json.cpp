#include "flexura/io/write_json.hpp"

#include <optional>
#include <variant>

#include "flexura/io/summary_json.hpp"

namespace flexura {
namespace {

using namespace summary;

Json units_json(const Result& result) {
  return {{"length", result.length_unit},
          {"force", result.force_unit},
          {"time", result.time_unit},
          {"angle", "rad"}};
}

Json state_json(const PathResult& path, const PathState& state) {
  Json bodies = Json::object();
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Pose& pose = state.bodies[b];
    bodies[path.bodies[b]] = {
        {"x", pose.position.x}, {"y", pose.position.y}, {"rotation", pose.rotation}};
  }
  Json points = Json::object();
  for (std::size_t p = 0; p < state.points.size(); ++p) {
    points[path.points[p]] = {{"x", state.points[p].x}, {"y", state.points[p].y}};
  }
  Json json = {{"bodies", std::move(bodies)}, {"points", std::move(points)}};
  for (std::size_t h = 0; h < state.reactions.size(); ++h) {
    const Reaction& r = state.reactions[h];
    json["reactions"][path.held[h].name] = {
        {"x", r.force.x}, {"y", r.force.y}, {"moment", r.moment}};
  }
  return json;
}

/// Forces at which the driven mechanism would snap, and where it would stay when let go.
void add_reaction_events(Json& json, const PathResult& path, const ModelingPath& modeling) {
  Json& snaps = json["snap_forces"] = Json::array();
  Json& equilibria = json["equilibria"] = Json::array();
  for (const ReactionEvent& event : modeling.reaction_events) {
    Json entry = {{"load_factor", event.load_factor}};
    if (event.kind == ReactionEvent::Kind::halt) {
      if (!path.held.empty()) entry["reaction"] = event.reaction;
    } else {
      entry["stable"] = event.stable;
    }
    entry["state"] = state_json(path, event.state);
    (event.kind == ReactionEvent::Kind::halt ? snaps : equilibria).push_back(std::move(entry));
  }
}

Json modeling_json(const PathResult& path, const ModelingPath& modeling) {
  Json json = {{"modeling", modeling.modeling}};
  add_termination(json, modeling.termination);
  json["unknowns"] = modeling.unknowns;
  json["steps"] = modeling.steps;
  json["iterations"] = modeling.iterations;
  json["seconds"] = modeling.seconds;
  json["error_estimate"] = optional_number(modeling.error_estimate);
  json["difference"] = optional_number(modeling.difference);
  json["extremes"] = extremes_json(path, modeling);
  if (const auto safety = find_safety(path, modeling))
    json["safety"] = safety_json(path, *safety, "load_factor");
  if (modeling.stress_error) json["stress_error"] = *modeling.stress_error;
  if (const auto& largest = modeling.largest_stress)
    json["largest_stress"] = {{"von_mises", largest->von_mises},
                              {"flexure", path.flexures[largest->flexure]},
                              {"place", pair(largest->place)},
                              {"drawn", pair(largest->drawn)}};
  Json& events = json["events"] = Json::array();
  for (const PathEvent& event : modeling.events) {
    events.push_back({{"kind", event.kind},
                      {"load_factor", event.load_factor},
                      {"state", state_json(path, event.state)}});
  }
  if (!path.held.empty() || path.by_arc_length) add_reaction_events(json, path, modeling);
  return json;
}

Json modes_json(const ModelingModes& modeling, bool frequencies) {
  Json json = {{"modeling", modeling.modeling}};
  add_termination(json, modeling.termination);
  json["unknowns"] = modeling.unknowns;
  json["seconds"] = modeling.seconds;
  json["error_estimate"] = optional_number(modeling.error_estimate);
  json["difference"] = optional_number(modeling.difference);
  Json& values = json[frequencies ? "angular_frequencies" : "load_factors"] = Json::array();
  for (const Mode& mode : modeling.modes) values.push_back(mode.value);
  for (const FrequencyPoint& point : modeling.curve) {
    json["curve"].push_back(
        {{"load_factor", point.load_factor}, {"angular_frequencies", point.angular_frequencies}});
  }
  return json;
}

/// The reference's label, and every modeling under its own.
template <class Content, class ModelingJson>
void add_modelings(Json& json, const Content& content, ModelingJson modeling_json_of) {
  if (content.reference < content.modelings.size()) {
    json["reference"] = content.modelings[content.reference].label;
  }
  for (const auto& modeling : content.modelings) {
    json["modelings"][modeling.label] = modeling_json_of(modeling);
  }
}

Json study_json(const StudyResult& study) {
  Json json = {{"kind", study.kind}};
  add_termination(json, study.termination);
  json["modelings"] = Json::object();
  if (const auto* path = std::get_if<PathResult>(&study.content)) {
    add_modelings(json, *path, [&](const auto& m) { return modeling_json(*path, m); });
  } else if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
    add_modelings(json, *modes,
                  [&](const auto& m) { return modes_json(m, study.kind == "modes"); });
  } else if (const auto* motion = std::get_if<MotionResult>(&study.content)) {
    json["method"] = motion->method;
    json["damping"] = motion->damping;
    add_modelings(json, *motion, [&](const auto& m) { return motion_json(*motion, m); });
  } else if (const auto* response = std::get_if<ResponseResult>(&study.content)) {
    json["damping"] = response->damping;
    add_modelings(json, *response, [&](const auto& m) { return response_json(*response, m); });
  } else if (const auto* linkage = std::get_if<LinkageResult>(&study.content)) {
    add_linkage(json, *linkage);
    add_modelings(json, *linkage, [&](const auto& m) { return linkage_json(*linkage, m); });
  }
  return json;
}

Json record_json(const ElasticityRecord& record) {
  const std::optional<Ellipse>& e = record.ellipse;
  Json json;
  json["at"] = pair(record.at);
  json["compliance"] = record.compliance;
  json["elastic_weight"] = e ? e->weight : 0.0;
  json["centre"] = e ? pair(e->centre) : Json(nullptr);
  json["semi_axes"] = e ? Json::array({e->major, e->minor}) : Json(nullptr);
  json["orientation"] = e ? Json(e->orientation) : Json(nullptr);
  json["principal_compliances"] = record.principal_compliances;
  json["principal_directions"] =
      Json::array({pair(record.principal_directions[0]), pair(record.principal_directions[1])});
  if (record.antipolar) {
    const Line2& line = *record.antipolar;
    json["antipolar"] = {{"point", pair(line.origin + line.offset * line.normal)},
                         {"direction", pair(perp(line.normal))}};
  } else {
    json["antipolar"] = nullptr;
  }
  return json;
}

std::string text_of(const Json& json) {
  // Names that are not valid UTF-8 are mended rather than refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string make_summary_json(const Result& result) {
  Json json = {{"title", result.title},
               {"model_file", result.model_file},
               {"version", result.version},
               {"units", units_json(result)},
               {"studies", Json::object()}};
  for (const StudyResult& study : result.studies) json["studies"][study.name] = study_json(study);
  return text_of(json);
}

std::string make_ellipse_json(const Result& result, const StudyResult& study,
                              const LinearResult& linear) {
  Json json = {{"study", study.name},
               {"version", result.version},
               {"units", units_json(result)},
               {"order",
                {{"load", {"force_x", "force_y", "moment"}},
                 {"displacement", {"displacement_x", "displacement_y", "rotation"}}}},
               {"flexures", Json::object()},
               {"bodies", Json::object()},
               {"points", Json::object()},
               {"poles", Json::array()}};
  for (const ElasticityRecord& record : linear.records) {
    static constexpr const char* groups[] = {"flexures", "bodies", "points"};
    json[groups[static_cast<int>(record.of)]][record.name] = record_json(record);
  }
  for (const PoleRecord& pole : linear.poles) {
    json["poles"].push_back({{"load", pole.load},
                             {"force", pair(pole.force)},
                             {"moment", pole.moment},
                             {"displacement", pair(pole.displacement)},
                             {"rotation", pole.rotation},
                             {"pole", pole.pole ? pair(*pole.pole) : Json(nullptr)}});
  }
  return text_of(json);
}

std::string make_stiffness_json(const Result& result, const PathResult& path,
                                const ModelingPath& modeling) {
  Json json = {{"modeling", modeling.modeling},
               {"version", result.version},
               {"units", units_json(result)},
               {"bodies", path.condensed},
               {"order",
                {{"load", {"force_x", "force_y", "moment"}},
                 {"displacement", {"displacement_x", "displacement_y", "rotation"}}}},
               {"states", Json::array()}};
  const std::size_t n = 3 * path.condensed.size();
  for (const CondensedStiffness& condensed : modeling.condensed) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < n; ++i) {
      Json row = Json::array();
      for (std::size_t j = 0; j < n; ++j) row.push_back(condensed.matrix[i * n + j]);
      rows.push_back(std::move(row));
    }
    json["states"].push_back(
        {{"load_factor", condensed.load_factor}, {"stiffness", std::move(rows)}});
  }
  return text_of(json);
}

}  // namespace flexura

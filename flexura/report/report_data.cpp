#include "flexura/report/report_data.hpp"

#include <string>
#include <variant>

#include "flexura/report/data_json.hpp"

namespace flexura {
namespace {

using namespace report_data;

Json drawing_json(const Drawing& drawing, const DrawnCoordinates& coordinates) {
  Json flexures = Json::array();
  for (const DrawnFlexure& f : drawing.flexures) {
    flexures.push_back({{"name", f.name},
                        {"base", f.base},
                        {"action", f.action},
                        {"pinned_base", f.pinned_base},
                        {"pinned_action", f.pinned_action},
                        {"depth", rounded(f.depth)},
                        {"axis", coordinates(f.axis)}});
    for (const double depth : f.depths) flexures.back()["depths"].push_back(rounded(depth));
  }
  Json bodies = Json::array();
  for (const DrawnBody& b : drawing.bodies) {
    bodies.push_back({{"name", b.name},
                      {"fixed", b.fixed},
                      {"centre", pair(b.centre)},
                      {"ends", coordinates(b.ends)},
                      {"point_names", b.point_names},
                      {"points", coordinates(b.points)}});
  }
  Json springs = Json::array();
  for (const DrawnSpring& s : drawing.springs) {
    springs.push_back({{"name", s.name},
                       {"base", s.base},
                       {"action", s.action},
                       {"base_place", pair(s.base_place)},
                       {"action_place", pair(s.action_place)},
                       {"torsional", s.torsional}});
  }
  Json joints = Json::array();
  for (const DrawnJoint& j : drawing.joints) {
    joints.push_back({{"name", j.name},
                      {"base", j.base},
                      {"action", j.action},
                      {"at", pair(j.at)},
                      {"direction", j.direction ? pair(*j.direction) : Json(nullptr)}});
  }
  return {{"flexures", std::move(flexures)},
          {"bodies", std::move(bodies)},
          {"springs", std::move(springs)},
          {"joints", std::move(joints)}};
}

Json history_json(const std::optional<DrawnHistory>& history) {
  if (!history) return nullptr;
  Json factors = Json::array();
  for (const double factor : history->factors) factors.push_back(rounded(factor));
  return {{"words", history->words},
          {"end", rounded(history->end)},
          {"largest", rounded(history->largest())},
          {"factors", std::move(factors)}};
}

Json loads_json(const std::vector<DrawnLoad>& loads) {
  Json list = Json::array();
  for (const DrawnLoad& load : loads) {
    list.push_back({{"on", load.on},
                    {"force", pair(load.force)},
                    {"moment", rounded(load.moment)},
                    {"follower", load.follower},
                    {"constant", load.constant},
                    {"history", history_json(load.history)}});
  }
  return list;
}

Json fields_json(const DrawnFields& fields) {
  Json spread = Json::array();
  for (const auto& load : fields.spread)
    spread.push_back({{"flexure", load.flexure}, {"per_length", pair(load.per_length)}});
  return {{"spread", std::move(spread)},
          {"gravity", pair(fields.gravity)},
          {"temperature", rounded(fields.temperature)},
          {"constant", fields.constant}};
}

Json study_json(const StudyResult& study, const DrawnCoordinates& coordinates) {
  Json json = {{"name", study.name},
               {"kind", study.kind},
               {"converged", study.termination.converged()},
               {"reason", study.termination.reason},
               {"loads", loads_json(study.loads)},
               {"fields", fields_json(study.fields)}};
  if (const auto* path = std::get_if<PathResult>(&study.content)) {
    json["path"] = make_path_json(*path, coordinates);
  } else if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
    json["modes"] = make_mode_json(*modes, coordinates);
  } else if (const auto* motion = std::get_if<MotionResult>(&study.content)) {
    json["motion"] = make_motion_json(*motion, coordinates);
  } else if (const auto* response = std::get_if<ResponseResult>(&study.content)) {
    json["response"] = make_response_json(*response);
  } else if (const auto* linkage = std::get_if<LinkageResult>(&study.content)) {
    json["linkage"] = make_linkage_json(*linkage, coordinates);
  } else {
    json["linear"] = make_linear_json(std::get<LinearResult>(study.content));
  }
  return json;
}

/// '<' occurs in JSON only inside strings: written as an escape it can neither close the script
/// element nor open a comment in it.
std::string escape_for_script(const std::string& json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string make_report_data(const Result& result) {
  const DrawnCoordinates coordinates(result.drawing);
  Json studies = Json::array();
  for (const StudyResult& study : result.studies) {
    studies.push_back(study_json(study, coordinates));
  }
  const Json json = {
      {"title", result.title},
      {"model_file", result.model_file},
      {"version", result.version},
      {"units",
       {{"length", result.length_unit}, {"force", result.force_unit}, {"time", result.time_unit}}},
      {"drawing", drawing_json(result.drawing, coordinates)},
      {"studies", std::move(studies)}};
  // Names that are not valid UTF-8 are mended rather than refused.
  return escape_for_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace flexura

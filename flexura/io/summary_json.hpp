#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "flexura/core/termination.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/results/extremes.hpp"
#include "flexura/results/linkage_result.hpp"
#include "flexura/results/motion_result.hpp"
#include "flexura/results/safety.hpp"

// The parts of summary.json; included by io/*.cpp only.

namespace flexura::summary {

// Objects in the order they are built: that of the model file.
using Json = nlohmann::ordered_json;

inline Json pair(Vec2 v) { return Json::array({v.x, v.y}); }

inline Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

inline void add_termination(Json& json, const Termination& termination) {
  json["status"] = termination.converged() ? "converged" : "stopped";
  // What was never run has not converged: it counts as stopped, and says so.
  const bool silent = termination.status == Status::not_run && termination.reason.empty();
  json["reason"] = silent ? "not run" : termination.reason;
}

/// Where the section forces and the stress of the last state are largest. `names` are those of a
/// PathResult or a MotionResult.
template <class Names, class Modeling>
Json extremes_json(const Names& names, const Modeling& modeling) {
  Json json = Json::object();
  const auto add = [&](const char* name, double MemberStation::*quantity) {
    const std::optional<Extreme> extreme = find_extreme(modeling, quantity);
    if (!extreme) return;
    json[name] = {{"value", extreme->value},
                  {"flexure", names.flexures[extreme->flexure]},
                  {"s", extreme->s}};
  };
  add("axial_force", &MemberStation::axial_force);
  add("shear_force", &MemberStation::shear_force);
  add("bending_moment", &MemberStation::bending_moment);
  add("stress", &MemberStation::stress);
  return json;
}

/// The factor at the last state, and where the way first reaches the strength: at a `load_factor`
/// or a `time`, as `measure` says.
template <class Names>
Json safety_json(const Names& names, const Safety& safety, const char* measure) {
  const auto name = [&](std::size_t flexure) { return Json(names.flexures[flexure]); };
  Json json = {{"factor", optional_number(safety.factor)},
               {"flexure", safety.factor ? name(safety.flexure) : Json(nullptr)},
               {"strength_reached", nullptr}};
  if (!safety.reached) return json;
  Json displacements = Json::object();
  for (std::size_t p = 0; p < names.points.size(); ++p) {
    const Vec2 moved = safety.reached->displacements[p];
    displacements[names.points[p]] = {{"x", moved.x}, {"y", moved.y}};
  }
  json["strength_reached"] = {{measure, safety.reached->load_factor},
                              {"flexure", name(safety.reached->flexure)},
                              {"displacements", std::move(displacements)}};
  return json;
}

/// What a modeling of a study of kind `transient` or `response` says.
Json motion_json(const MotionResult& motion, const ModelingMotion& modeling);
Json response_json(const ResponseResult& response, const ModelingResponse& modeling);
/// What a study of kind `linkage` says of the whole, and of one of its methods.
void add_linkage(Json& json, const LinkageResult& linkage);
Json linkage_json(const LinkageResult& linkage, const LinkageMotion& motion);

}  // namespace flexura::summary

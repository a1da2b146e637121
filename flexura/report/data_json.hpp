#pragma once

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "flexura/results/point_owner.hpp"
#include "flexura/results/result.hpp"
#include "flexura/results/safety.hpp"

// How values of a Result become JSON for the page; included by report/*.cpp only.

namespace flexura::report_data {

using Json = nlohmann::ordered_json;

/// Seven significant digits. What is not finite stays so, and the JSON library writes it as null.
inline double rounded(double value) {
  if (!std::isfinite(value)) return value;
  return std::strtod(fmt::format("{:.6e}", value).c_str(), nullptr) + 0.0;
}

inline Json pair(Vec2 v) { return Json::array({rounded(v.x), rounded(v.y)}); }

inline Json optional_number(const std::optional<double>& value) {
  return value ? Json(rounded(*value)) : Json(nullptr);
}

/// Drawn coordinates, flat (x0, y0, x1, y1, ...): a hundred-thousandth of the mechanism is
/// finer than any screen and keeps the page small.
class DrawnCoordinates {
 public:
  explicit DrawnCoordinates(const Drawing& drawing) {
    const bool has_axis = !drawing.flexures.empty() && !drawing.flexures.front().axis.empty();
    const Vec2 origin = has_axis ? drawing.flexures.front().axis.front() : Vec2{};
    double extent = 0.0;
    for (const DrawnFlexure& flexure : drawing.flexures) {
      for (const Vec2 p : flexure.axis) extent = std::max(extent, norm(p - origin));
    }
    if (extent > 0.0) {
      decimals_ = std::clamp(static_cast<int>(std::ceil(5.0 - std::log10(extent))), 0, 15);
    }
  }

  Json operator()(const std::vector<Vec2>& points) const {
    Json flat = Json::array();
    for (const Vec2 p : points) {
      flat.push_back(fixed(p.x));
      flat.push_back(fixed(p.y));
    }
    return flat;
  }

 private:
  double fixed(double value) const {
    if (!std::isfinite(value)) return value;
    return std::strtod(fmt::format("{:.{}f}", value, decimals_).c_str(), nullptr) + 0.0;
  }

  int decimals_ = 6;
};

/// What the rows of a PathResult or a MotionResult belong to.
template <class Names>
Json names_json(const Names& names) {
  Json owners = Json::array();
  for (std::size_t p = 0; p < names.points.size(); ++p) {
    const std::optional<std::size_t> owner = owner_of_point(names, p);
    owners.push_back(owner ? Json(*owner) : Json(nullptr));
  }
  Json held = Json::array();
  for (const HeldPlace& place : names.held) {
    held.push_back({{"name", place.name},
                    {"body", place.body},
                    {"point", place.point ? Json(*place.point) : Json(nullptr)}});
  }
  Json strengths = Json::array();
  for (const auto& strength : names.strengths) strengths.push_back(optional_number(strength));
  return {{"bodies", names.bodies},
          {"points", names.points},
          {"owners", std::move(owners)},
          {"flexures", names.flexures},
          {"strengths", std::move(strengths)},
          {"held", std::move(held)},
          {"reference", names.reference}};
}

/// Who a modeling is, how it ended, what it cost and how far it is off.
template <class Modeling>
Json modeling_head_json(const Modeling& m) {
  return {{"label", m.label},
          {"modeling", m.modeling},
          {"converged", m.termination.converged()},
          {"reason", m.termination.reason},
          {"unknowns", m.unknowns},
          {"seconds", rounded(m.seconds)},
          {"error_estimate", optional_number(m.error_estimate)},
          {"difference", optional_number(m.difference)}};
}

Json members_json(const std::vector<std::vector<MemberStation>>& members);
Json safety_json(const std::optional<Safety>& safety);

/// Null where the modeling has none.
Json stress_fields_json(const ModelingPath& modeling, const DrawnCoordinates& coordinates);

Json make_path_json(const PathResult& path, const DrawnCoordinates& coordinates);
Json make_mode_json(const ModeResult& modes, const DrawnCoordinates& coordinates);
Json make_motion_json(const MotionResult& motion, const DrawnCoordinates& coordinates);
Json make_response_json(const ResponseResult& response);
Json make_linkage_json(const LinkageResult& linkage, const DrawnCoordinates& coordinates);
Json make_linear_json(const LinearResult& linear);

}  // namespace flexura::report_data

#pragma once

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "flexura/results/result.hpp"

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

Json make_path_json(const PathResult& path, const DrawnCoordinates& coordinates);
Json make_mode_json(const ModeResult& modes, const DrawnCoordinates& coordinates);
Json make_linear_json(const LinearResult& linear);

}  // namespace flexura::report_data

#include "flexura/report/data_json.hpp"

namespace flexura::report_data {
namespace {

Json poses_json(const std::vector<Pose>& poses) {
  Json list = Json::array();
  for (const Pose& pose : poses) {
    list.push_back({rounded(pose.position.x), rounded(pose.position.y), rounded(pose.rotation)});
  }
  return list;
}

/// Displacements, flat; drawn magnified, so they keep their digits.
Json displacements_json(const std::vector<std::vector<Vec2>>& axes) {
  Json list = Json::array();
  for (const std::vector<Vec2>& axis : axes) {
    Json flat = Json::array();
    for (const Vec2 v : axis) {
      flat.push_back(std::strtod(fmt::format("{:.4f}", v.x).c_str(), nullptr) + 0.0);
      flat.push_back(std::strtod(fmt::format("{:.4f}", v.y).c_str(), nullptr) + 0.0);
    }
    list.push_back(std::move(flat));
  }
  return list;
}

Json mode_json(const Mode& mode, const DrawnCoordinates& coordinates) {
  Json axes = Json::array();
  for (const std::vector<Vec2>& axis : mode.axes) axes.push_back(coordinates(axis));
  return {{"value", rounded(mode.value)},
          {"bodies", poses_json(mode.bodies)},
          {"axes", std::move(axes)},
          {"shape_bodies", poses_json(mode.shape.bodies)},
          {"shape_axes", displacements_json(mode.shape.axes)}};
}

}  // namespace

Json make_mode_json(const ModeResult& result, const DrawnCoordinates& coordinates) {
  Json modelings = Json::array();
  for (const ModelingModes& m : result.modelings) {
    Json modes = Json::array();
    for (const Mode& mode : m.modes) modes.push_back(mode_json(mode, coordinates));
    Json curve = Json::array();
    for (const FrequencyPoint& point : m.curve) {
      Json values = Json::array();
      for (const double w : point.angular_frequencies) values.push_back(rounded(w));
      curve.push_back({{"load_factor", rounded(point.load_factor)}, {"values", std::move(values)}});
    }
    Json json = modeling_head_json(m);
    json["modes"] = std::move(modes);
    json["curve"] = std::move(curve);
    modelings.push_back(std::move(json));
  }
  return {{"bodies", result.bodies},
          {"flexures", result.flexures},
          {"reference", result.reference},
          {"modelings", std::move(modelings)}};
}

}  // namespace flexura::report_data

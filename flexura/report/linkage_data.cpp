#include <complex>

#include "flexura/report/data_json.hpp"
#include "flexura/results/linkage_peaks.hpp"

namespace flexura::report_data {
namespace {

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

Json rows(const std::vector<std::vector<double>>& table) {
  Json list = Json::array();
  for (const std::vector<double>& row : table) list.push_back(numbers(row));
  return list;
}

Json complex_json(const std::vector<std::complex<double>>& values) {
  Json list = Json::array();
  for (const std::complex<double>& value : values)
    list.push_back(Json::array({rounded(value.real()), rounded(value.imag())}));
  return list;
}

/// Displacements are small beside coordinates, and get digits of their own.
Json displacements_json(const std::vector<Vec2>& displacements) {
  Json flat = Json::array();
  for (const Vec2 d : displacements) {
    flat.push_back(rounded(d.x));
    flat.push_back(rounded(d.y));
  }
  return flat;
}

Json position_json(const RigidPosition& position, const DrawnCoordinates& coordinates) {
  Json axes = Json::array();
  for (const std::vector<Vec2>& axis : position.flexures) axes.push_back(coordinates(axis));
  std::vector<Vec2> bodies;
  Json rotations = Json::array();
  for (const Pose& body : position.bodies) {
    bodies.push_back(body.position);
    rotations.push_back(rounded(body.rotation));
  }
  return {{"angle", rounded(position.angle)},
          {"flexures", std::move(axes)},
          {"bodies", coordinates(bodies)},
          {"rotations", std::move(rotations)},
          {"points", coordinates(position.points)},
          {"torque", rounded(position.torque)},
          {"shaking_force", pair(position.shaking_force)},
          {"shaking_moment", rounded(position.shaking_moment)},
          {"transmission_angle", optional_number(position.transmission_angle)}};
}

Json peak_json(const CurvePeak& peak) {
  return {{"value", rounded(peak.value)}, {"angle", rounded(peak.angle)}};
}

Json curves_json(const LinkageResult& linkage, const FlexureCurves& curves) {
  return {{"strain", numbers(curves.strain)},
          {"axial_strain", numbers(curves.axial_strain)},
          {"deflection", numbers(curves.deflection)},
          {"stress", numbers(curves.stress)},
          {"upper_stress", rows(curves.upper_stress)},
          {"lower_stress", rows(curves.lower_stress)},
          {"peaks",
           {{"strain", peak_json(find_peak(linkage, curves.strain))},
            {"deflection", peak_json(find_peak(linkage, curves.deflection))},
            {"stress", peak_json(find_peak(linkage, curves.stress))}}}};
}

Json method_json(const LinkageResult& linkage, const LinkageMotion& motion) {
  Json json = {{"label", motion.label},
               {"converged", motion.termination.converged()},
               {"reason", motion.termination.reason},
               {"remark", motion.remark},
               {"unknowns", motion.unknowns},
               {"iterations", motion.iterations},
               {"counted", motion.counted},
               {"seconds", rounded(motion.seconds)},
               {"error_estimate", optional_number(motion.error_estimate)},
               {"difference", optional_number(motion.difference)}};
  Json& flexures = json["flexures"] = Json::array();
  for (const FlexureCurves& curves : motion.flexures)
    flexures.push_back(curves_json(linkage, curves));
  Json& displacements = json["displacements"] = Json::array();
  for (const auto& position : motion.displacements) {
    Json of_flexures = Json::array();
    for (const std::vector<Vec2>& flexure : position)
      of_flexures.push_back(displacements_json(flexure));
    displacements.push_back(std::move(of_flexures));
  }
  Json& bodies = json["bodies"] = Json::array();
  for (const std::vector<Vec2>& position : motion.bodies)
    bodies.push_back(displacements_json(position));
  Json& points = json["points"] = Json::array();
  for (const std::vector<Vec2>& position : motion.points)
    points.push_back(displacements_json(position));
  return json;
}

}  // namespace

Json make_linkage_json(const LinkageResult& linkage, const DrawnCoordinates& coordinates) {
  Json positions = Json::array();
  for (const RigidPosition& position : linkage.positions)
    positions.push_back(position_json(position, coordinates));
  Json methods = Json::array();
  for (const LinkageMotion& motion : linkage.modelings)
    methods.push_back(method_json(linkage, motion));
  Json speeds = Json::array();
  for (const SpeedState& state : linkage.speeds)
    speeds.push_back({{"speed", rounded(state.speed)},
                      {"buckles", state.buckles},
                      {"multipliers", complex_json(state.multipliers)},
                      {"peak_strain", numbers(state.peak_strain)}});
  Json strengths = Json::array();
  for (const auto& strength : linkage.strengths) strengths.push_back(optional_number(strength));
  return {{"driver", linkage.driver},
          {"speed", rounded(linkage.speed)},
          {"modeling", linkage.modeling},
          {"damping", linkage.damping},
          {"grashof", linkage.grashof},
          {"notes", linkage.notes},
          {"bodies", linkage.bodies},
          {"points", linkage.points},
          {"flexures", linkage.flexures},
          {"strengths", std::move(strengths)},
          {"stations", rows(linkage.stations)},
          {"reference", linkage.reference},
          {"positions", std::move(positions)},
          {"frequencies", rows(linkage.frequencies)},
          {"followed", rows(linkage.followed)},
          {"methods", std::move(methods)},
          {"multipliers", complex_json(linkage.multipliers)},
          {"speeds", std::move(speeds)},
          {"buckling_factor", optional_number(linkage.buckling_factor)},
          {"buckling_angle", rounded(linkage.buckling_angle)}};
}

}  // namespace flexura::report_data

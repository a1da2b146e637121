#include "tests/report/sample_turn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/report/sample_linkage.hpp"

namespace flexura::sample {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double drive = 10.0 * full_turn;  // 600 rpm
constexpr int axis_points = 21;
constexpr int station_count = 15;

/// By how much a method's vibration is beside its quasi-static deflection.
LinkagePose pose_at(double angle, double vibration) {
  return {angle, -0.3 * std::sin(angle) + 0.2 * vibration * std::cos(7.0 * angle),
          0.8 * std::cos(angle) + 0.5 * vibration * std::sin(5.0 * angle)};
}

RigidPosition rigid_position(double angle) {
  const PathState state = make_linkage_state({angle, 0.0, 0.0}, axis_points);
  RigidPosition position;
  position.angle = angle;
  position.bodies = state.bodies;
  position.flexures = state.axes;
  position.points = state.points;
  position.torque = 4.0 * std::sin(2.0 * angle);
  position.shaking_force = {3.0 * std::cos(angle), 0.4 * std::sin(angle)};
  position.shaking_moment = -2.0 * std::sin(angle);
  return position;
}

std::vector<Vec2> differences(const std::vector<Vec2>& moved, const std::vector<Vec2>& rigid) {
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < rigid.size(); ++i) result.push_back(moved[i] - rigid[i]);
  return result;
}

/// Strain, deflection and stress follow the middle's way out.
void add_curves(FlexureCurves& curves, double way_out, double stiffness) {
  curves.strain.push_back(1e-3 * way_out);
  curves.axial_strain.push_back(-2e-6);
  curves.deflection.push_back(way_out);
  std::vector<double> upper;
  std::vector<double> lower;
  for (int k = 0; k < station_count; ++k) {
    const double share = static_cast<double>(k) / (station_count - 1);
    const double stress = stiffness * way_out * std::sin(std::numbers::pi * share);
    upper.push_back(stress - 1.0);
    lower.push_back(-stress - 1.0);
  }
  curves.stress.push_back(stiffness * std::abs(way_out) + 1.0);
  curves.upper_stress.push_back(std::move(upper));
  curves.lower_stress.push_back(std::move(lower));
}

LinkageMotion method(const LinkageResult& result, const char* label, double vibration) {
  LinkageMotion motion;
  motion.label = label;
  motion.termination.status = Status::converged;
  motion.flexures.resize(2);
  motion.unknowns = 21;
  motion.seconds = 0.012;
  for (const RigidPosition& rigid : result.positions) {
    const LinkagePose pose = pose_at(rigid.angle, vibration);
    const PathState state = make_linkage_state(pose, axis_points);
    add_curves(motion.flexures[0], pose.bow, 30.0);
    add_curves(motion.flexures[1], pose.bend, 8.0);
    motion.displacements.emplace_back();
    for (std::size_t f = 0; f < state.axes.size(); ++f)
      motion.displacements.back().push_back(differences(state.axes[f], rigid.flexures[f]));
    motion.points.push_back(differences(state.points, rigid.points));
    motion.bodies.emplace_back();
    for (std::size_t b = 0; b < rigid.bodies.size(); ++b)
      motion.bodies.back().push_back(state.bodies[b].position - rigid.bodies[b].position);
  }
  return motion;
}

LinkageResult make_rigid(int intervals) {
  LinkageResult result;
  result.bodies = {"crank", "piston", "tip"};
  result.points = {"tip.P"};
  result.flexures = {"rod", "leaf"};
  result.pins = {"rod.base on crank", "rod.action on piston"};
  result.strengths = {12.0, {}};
  result.driver = "motor";
  result.speed = drive;
  result.modeling = "beam, 3 elements a flexure";
  result.damping = "0.02 of critical damping in every mode";
  for (const double length : {60.0, 45.0}) {
    result.stations.emplace_back();
    for (int k = 0; k < station_count; ++k)
      result.stations.back().push_back(length * k / (station_count - 1));
  }
  for (int k = 0; k <= intervals; ++k) {
    const double angle = full_turn * k / intervals;
    result.positions.push_back(rigid_position(angle));
    const std::vector<double> modes = {full_turn * (42.0 + 5.0 * std::cos(angle)),
                                       full_turn * (75.0 - 20.0 * std::cos(2.0 * angle)),
                                       full_turn * 190.0, full_turn * 400.0};
    result.frequencies.push_back(modes);
    result.followed.push_back(modes);
  }
  return result;
}

/// Unstable from 1500 rpm to 1700 rpm; from 2300 rpm the rod would buckle at rest.
std::vector<SpeedState> make_speeds() {
  std::vector<SpeedState> speeds;
  for (int k = 1; k <= 25; ++k) {
    SpeedState state;
    state.speed = full_turn * k * 100.0 / 60.0;
    state.buckles = k >= 23;
    const double size = std::min(0.98, 0.05 * k) + 0.3 * std::exp(-0.5 * std::pow(k - 16.0, 2.0));
    state.multipliers = {{0.0, size}, {0.0, -size}, {0.2, 0.0}};
    state.peak_strain = {1e-4 * k * k, 5e-5 * k * k};
    speeds.push_back(std::move(state));
  }
  return speeds;
}

LinkageResult make_turn(int intervals) {
  LinkageResult result = make_rigid(intervals);
  for (RigidPosition& position : result.positions)
    position.transmission_angle = 1.5 + 0.6 * std::cos(position.angle);
  result.grashof = "crank-rocker";
  result.notes = {"The quasi-static strain of rod is 2.1 times too small.",
                  "A second finding, in a sentence."};
  result.modelings = {method(result, "quasi_static", 0.0),
                      method(result, "periodic", 1.0),
                      method(result, "midha", 0.9),
                      {}};
  result.reference = 1;
  result.modelings[0].difference = 0.61;
  result.modelings[1].iterations = 10;
  result.modelings[1].counted = "turns";
  result.modelings[1].error_estimate = 0.02;
  result.modelings[2].remark = "The coupling terms are not small at this speed.";
  LinkageMotion& stopped = result.modelings[3];
  stopped.label = "transient";
  stopped.termination = {Status::stopped, "It did not settle within 400 turns; add damping."};
  stopped.iterations = 400;
  stopped.counted = "turns";
  result.multipliers = {{0.2, 0.9}, {0.2, -0.9}, {-1.15, 0.0}, {0.4, 0.1}, {0.4, -0.1}};
  result.speeds = make_speeds();
  result.buckling_factor = 3.44;
  result.buckling_angle = 0.4;
  return result;
}

LinkageResult make_slow(int intervals) {
  LinkageResult result = make_rigid(intervals);
  result.modelings = {method(result, "quasi_static", 0.0)};
  return result;
}

LinkageResult make_jammed() {
  LinkageResult result = make_rigid(0);
  result.positions.clear();
  result.frequencies.clear();
  result.followed.clear();
  return result;
}

StudyResult study(const char* name, LinkageResult content) {
  StudyResult result;
  result.name = name;
  result.kind = "linkage";
  result.termination.status = Status::converged;
  result.content = std::move(content);
  return result;
}

}  // namespace

Result make_sample_turn(int intervals) {
  Result result;
  result.title = "A driven crank, its elastic rod & a leaf on the piston";
  result.model_file = "linkage.toml";
  result.version = "0.1.0";
  result.length_unit = "mm";
  result.force_unit = "N";
  result.time_unit = "s";
  result.angle_unit = "deg";
  result.drawing = make_linkage_drawing();
  result.studies = {study("turn", make_turn(intervals)), study("slow", make_slow(intervals)),
                    study("jammed", make_jammed())};
  result.studies[0].termination = {Status::stopped, "transient stopped early"};
  result.studies[2].termination = {
      Status::stopped,
      "The linkage cannot be put together with the drive at 130 deg; check the links' lengths."};
  return result;
}

}  // namespace flexura::sample

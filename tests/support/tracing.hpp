#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "flexura/studies/path_tracer.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {

/// A path in equal steps of the load factor, without error estimates unless asked for (a tolerance
/// that chooses the modes needs them).
inline TracedPath trace(const Model& model, const std::vector<Load>& loads,
                        const ModelingSettings& settings, int steps, bool estimate = true) {
  TraceOptions options;
  options.steps = steps;
  options.estimate_errors = estimate;
  return trace_path(model, loads, settings, options);
}

/// Where a body (its centre) is in an output state.
inline Pose pose_in(const TracedPath& path, std::size_t state, std::size_t body) {
  const TracedState& at = path.states.at(state);
  return path.systems.at(at.system)->pose(body, at.z);
}
inline Vec2 point_in(const TracedPath& path, std::size_t state, std::size_t body, Vec2 drawn) {
  const TracedState& at = path.states.at(state);
  return path.systems.at(at.system)->moved_point(body, drawn, at.z);
}
inline Eigen::Vector3d member_load_in(const TracedPath& path, std::size_t state,
                                      std::size_t member) {
  const TracedState& at = path.states.at(state);
  return path.systems.at(at.system)->member_load(member, at.z);
}

/// The body's pose at full load, with a failed expectation where the path stops before.
inline Pose final_pose(const Model& model, const std::vector<Load>& loads,
                       const ModelingSettings& settings, std::size_t body, int steps = 1) {
  const TracedPath path = trace(model, loads, settings, steps);
  EXPECT_TRUE(path.termination.converged()) << settings.label << ": " << path.termination.reason;
  if (path.states.empty()) return {};
  return pose_in(path, path.states.size() - 1, body);
}

/// Distance of two poses: positions in units of `length`, rotations in radians.
inline double distance(const Pose& a, const Pose& b, double length) {
  return std::max(norm(a.position - b.position) / length, std::abs(a.rotation - b.rotation));
}

}  // namespace flexura::testing

#pragma once

#include <gtest/gtest.h>

#include "flexura/studies/transient_study.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {

/// A study of kind transient by Radau's method, recorded in `outputs` equal intervals.
inline TransientStudy transient(double duration, int outputs, double tolerance) {
  TransientStudy study;
  study.duration = duration;
  study.outputs = outputs;
  study.tolerance = tolerance;
  study.estimate = false;
  return study;
}

/// The same in fixed steps of another method.
inline TransientStudy in_steps(TransientStudy study, TransientStudy::Method method, double step) {
  study.method = method;
  study.step = step;
  return study;
}

/// The motion, with a failed expectation where it stops before its end.
inline ModelingMotion move(const Model& model, const TransientStudy& study,
                           const ModelingSettings& settings) {
  ModelingMotion motion = run_transient(model, study, settings, [](double) { return true; });
  EXPECT_TRUE(motion.termination.converged())
      << settings.label << ": " << motion.termination.reason;
  return motion;
}

/// Where a body (its centre) is at an output time.
inline Pose pose_at(const Mechanism& mechanism, const MotionState& state, const std::string& body) {
  const std::vector<Body>& bodies = mechanism.model().bodies;
  std::size_t moving = 0;
  for (std::size_t b = 0; b < mechanism.index(body); ++b) moving += bodies[b].fixed ? 0 : 1;
  return state.state.bodies.at(moving);
}

}  // namespace flexura::testing

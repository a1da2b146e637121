#pragma once

#include "flexura/studies/field_record.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {

/// Stress fields at full load, reached in one step or more.
inline std::vector<FieldState::OfFlexure> final_fields(const Model& model,
                                                       const std::vector<Load>& loads,
                                                       const ModelingSettings& settings,
                                                       int steps = 1) {
  const TracedPath path = trace(model, loads, settings, steps, false);
  EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
  const TracedState& last = path.states.back();
  return make_fields(model, StillState(*path.systems[last.system], last.z));
}

}  // namespace flexura::testing

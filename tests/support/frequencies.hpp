#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flexura/studies/modes_study.hpp"

namespace flexura::testing {

/// Angular frequencies that a study of modes finds by a modeling.
inline std::vector<double> frequencies(const Model& model, const ModesStudy& study,
                                       const ModelingSettings& settings) {
  const ModelingModes modes = run_modes(model, study, settings, [](double) { return true; });
  EXPECT_TRUE(modes.termination.converged()) << modes.termination.reason;
  std::vector<double> found;
  for (const Mode& mode : modes.modes) found.push_back(mode.value);
  return found;
}

/// The lowest, about the drawn state.
inline std::vector<double> frequencies(const Model& model, const ModelingSettings& settings,
                                       int count) {
  ModesStudy study;
  study.count = count;
  return frequencies(model, study, settings);
}

/// Of the ratios from one.
inline double largest_difference(const std::vector<double>& found,
                                 const std::vector<double>& truth) {
  EXPECT_EQ(found.size(), truth.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(found.size(), truth.size()); ++k)
    largest = std::max(largest, std::abs(found[k] / truth[k] - 1.0));
  return largest;
}

}  // namespace flexura::testing

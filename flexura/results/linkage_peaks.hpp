#pragma once

#include "flexura/results/linkage_result.hpp"

namespace flexura {

/// The largest absolute value of a curve over the turn, with its sign.
CurvePeak find_peak(const LinkageResult& linkage, const std::vector<double>& curve);

/// Smallest and largest angular frequency of a mode over the turn.
struct FrequencyBand {
  double least = 0.0;
  double greatest = 0.0;
};
std::vector<FrequencyBand> frequency_bands(const LinkageResult& linkage);

}  // namespace flexura

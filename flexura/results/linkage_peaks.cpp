#include "flexura/results/linkage_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {

CurvePeak find_peak(const LinkageResult& linkage, const std::vector<double>& curve) {
  CurvePeak peak;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (std::abs(curve[i]) > std::abs(peak.value)) peak = {curve[i], linkage.positions[i].angle};
  return peak;
}

std::vector<FrequencyBand> frequency_bands(const LinkageResult& linkage) {
  std::vector<FrequencyBand> bands;
  for (const std::vector<double>& row : linkage.frequencies)
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k == bands.size()) bands.push_back({row[k], row[k]});
      bands[k] = {std::min(bands[k].least, row[k]), std::max(bands[k].greatest, row[k])};
    }
  return bands;
}

}  // namespace flexura

#pragma once

#include <string>
#include <vector>

namespace flexura {

/// How a load comes and goes in a study of motion: the factor on it over time or, in a linkage's
/// turn, over the angle of its drive.
struct DrawnHistory {
  std::string words;            ///< for readers
  double end = 0.0;             ///< of the times or angles, which begin at 0
  std::vector<double> factors;  ///< evenly from 0 to the end; at least two

  /// Between two factors on the straight line, outside as at the nearer end.
  double at(double time) const;
  double largest() const;  ///< of the factors' sizes
};

}  // namespace flexura

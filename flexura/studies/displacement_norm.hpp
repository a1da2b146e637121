#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// Where distances are measured: the named points, or the bodies' centres without any.
std::vector<Vec2> points_of(const PathState& state);

/// Of every such point, the largest displacement from `start` over states that are added one by
/// one.
class LargestDisplacements {
 public:
  explicit LargestDisplacements(const PathState& start);
  void add(const PathState& state);
  /// Floored: points that hardly move would turn rounding into a relative difference.
  std::vector<double> values() const;

 private:
  std::vector<Vec2> start_;
  double size_;  // of the mechanism
  std::vector<double> largest_;
};

/// A distance that rounding alone may cause.
double displacement_rounding(const PathState& start);

/// Largest distance of a point of two states, relative to its size.
double relative_distance(const PathState& here, const PathState& there,
                         const std::vector<double>& sizes, double noise);

}  // namespace flexura

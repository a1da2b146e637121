#pragma once

#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/geometry/axis_curve.hpp"

namespace flexura {

/// Evenly spaced stations of an axis and, between each two, quadrature points that integrate along
/// it to machine precision. Positions count from the base end.
struct StationGrid {
  struct Node {
    double s = 0.0;
    double weight = 0.0;  ///< of ds
    Vec2 position;        ///< as drawn
    double angle = 0.0;   ///< of the tangent as drawn
  };

  explicit StationGrid(const AxisCurve& axis);

  std::vector<double> s;        ///< of the stations
  std::vector<Vec2> positions;  ///< of the stations as drawn
  std::vector<double> angles;   ///< of the tangent at the stations as drawn
  std::vector<Node> nodes;
  std::vector<std::size_t> first;  ///< nodes[first[k]] .. nodes[first[k+1]] lie past station k
};

}  // namespace flexura

#pragma once

#include <vector>

#include "flexura/assembly/two_port.hpp"
#include "flexura/core/quadrature.hpp"
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

  /// Intervals between stations are cut at `breaks`, arc lengths where axis or section are less
  /// smooth.
  StationGrid(const AxisCurve& axis, const std::vector<double>& breaks);

  /// Integrals along the axis, from its base end, of a function given at the nodes.
  template <class Value>
  struct Integral {
    std::vector<Value> at_nodes;
    std::vector<Value> at_stations;
  };
  template <class Value>
  Integral<Value> integrate(const std::vector<Value>& at_nodes) const;

  std::vector<double> s;        ///< of the stations
  std::vector<Vec2> positions;  ///< of the stations as drawn
  std::vector<double> angles;   ///< of the tangent at the stations as drawn
  std::vector<Node> nodes;
  std::vector<std::size_t> first;  ///< nodes[first[k]] .. nodes[first[k+1]] lie past station k
};

/// Nodes between two knots or stations, as many as the quadrature rule has.
inline constexpr std::size_t nodes_per_interval = 6;

template <class Value>
auto StationGrid::integrate(const std::vector<Value>& at_nodes) const -> Integral<Value> {
  const std::vector<double>& partial =
      gauss_partial_integrals(static_cast<int>(nodes_per_interval));
  Integral<Value> integral;
  Value sum{};
  std::size_t next_station = 0;
  for (std::size_t start = 0; start <= nodes.size(); start += nodes_per_interval) {
    if (next_station < first.size() && start == first[next_station]) {
      integral.at_stations.push_back(sum);
      ++next_station;
    }
    if (start == nodes.size()) break;
    double length = 0.0;
    for (std::size_t q = 0; q < nodes_per_interval; ++q) length += nodes[start + q].weight;
    for (std::size_t g = 0; g < nodes_per_interval; ++g) {
      Value here = sum;
      for (std::size_t q = 0; q < nodes_per_interval; ++q)
        here = here + (length * partial[g * nodes_per_interval + q]) * at_nodes[start + q];
      integral.at_nodes.push_back(here);
    }
    for (std::size_t q = 0; q < nodes_per_interval; ++q)
      sum = sum + nodes[start + q].weight * at_nodes[start + q];
  }
  return integral;
}

/// Moment about every section of the dead forces ahead of it: at the grid's nodes and stations,
/// from the derivative of the axis at the nodes and the force ahead of each.
StationGrid::Integral<double> moments_ahead(const StationGrid& grid,
                                            const std::vector<Vec2>& slopes,
                                            const std::vector<Vec2>& forces);

/// The section at a station from its pose, with the forces that hold it in equilibrium with the
/// tip.
SectionState section_at(const StationGrid& grid, std::size_t station, const Pose& moved, Vec2 tip,
                        const Eigen::Vector3d& load);

}  // namespace flexura

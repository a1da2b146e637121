#include "flexura/modelings/station_grid.hpp"

#include <algorithm>

#include "flexura/assembly/two_port.hpp"
#include "flexura/core/quadrature.hpp"

namespace flexura {

StationGrid::StationGrid(const AxisCurve& axis, const std::vector<double>& breaks) {
  const double length = axis.length();
  const Vec2 start = axis.position(0.0);
  const QuadratureRule& rule = gauss_legendre(nodes_per_interval);
  for (int k = 0; k < station_count; ++k) {
    s.push_back(k + 1 == station_count ? length : length * k / (station_count - 1));
    positions.push_back(axis.position(s.back()) - start);
    angles.push_back(axis.tangent_angle(s.back()));
  }
  first.push_back(0);
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    std::vector<double> cuts{s[k]};
    for (const double b : breaks)
      if (b > s[k] && b < s[k + 1]) cuts.push_back(b);
    cuts.push_back(s[k + 1]);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      const double half = 0.5 * (cuts[c + 1] - cuts[c]);
      for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
        const double at = cuts[c] + half * (1.0 + rule.nodes[g]);
        nodes.push_back(
            {at, half * rule.weights[g], axis.position(at) - start, axis.tangent_angle(at)});
      }
    }
    first.push_back(nodes.size());
  }
}

StationGrid::Integral<double> moments_ahead(const StationGrid& grid,
                                            const std::vector<Vec2>& slopes,
                                            const std::vector<Vec2>& forces) {
  std::vector<double> rates;
  for (std::size_t k = 0; k < slopes.size(); ++k) rates.push_back(cross(slopes[k], forces[k]));
  StationGrid::Integral<double> moments = grid.integrate(rates);
  const double whole = moments.at_stations.back();
  for (double& moment : moments.at_nodes) moment = whole - moment;
  for (double& moment : moments.at_stations) moment = whole - moment;
  return moments;
}

SectionState section_at(const StationGrid& grid, std::size_t station, const Pose& moved, Vec2 tip,
                        const Eigen::Vector3d& load) {
  const Vec2 f{load[0], load[1]};
  const Vec2 t = unit(grid.angles[station] + moved.rotation);
  return {moved, dot(f, t), dot(f, perp(t)), load[2] + cross(tip - moved.position, f)};
}

}  // namespace flexura

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

const std::vector<double>& partial_integrals() {
  static const std::vector<double> table = [] {
    const QuadratureRule& rule = gauss_legendre(nodes_per_interval);
    std::vector<double> partial;
    for (std::size_t g = 0; g < nodes_per_interval; ++g) {
      const double share = 0.5 * (1.0 + rule.nodes[g]);  // of the interval before the node
      for (std::size_t basis = 0; basis < nodes_per_interval; ++basis) {
        double integral = 0.0;
        for (std::size_t q = 0; q < nodes_per_interval; ++q) {
          const double x = -1.0 + share * (1.0 + rule.nodes[q]);
          double value = 0.5 * share * rule.weights[q];
          for (std::size_t b = 0; b < nodes_per_interval; ++b)
            if (b != basis) value *= (x - rule.nodes[b]) / (rule.nodes[basis] - rule.nodes[b]);
          integral += value;
        }
        partial.push_back(integral);
      }
    }
    return partial;
  }();
  return table;
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

}  // namespace flexura

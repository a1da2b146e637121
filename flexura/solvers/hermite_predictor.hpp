#pragma once

#include <array>
#include <deque>
#include <vector>

namespace flexura {

/// A point of a curve z(parameter) with its slope.
struct CurvePoint {
  double parameter = 0.0;
  std::vector<double> value;
  std::vector<double> slope;
};

/// Extrapolates a curve from its last points by Hermite interpolation: value and slope at up to
/// three of them, so up to degree five. Precondition: at least one point; parameters differ.
inline void extrapolate_hermite(const std::deque<CurvePoint>& points, double parameter,
                                std::vector<double>& out) {
  const std::size_t count = points.size() < 3 ? points.size() : 3;
  const std::size_t first = points.size() - count;
  // Newton's divided differences with every node doubled
  std::array<double, 6> node{};
  for (std::size_t k = 0; k < count; ++k)
    node[2 * k] = node[2 * k + 1] = points[first + k].parameter;
  const std::size_t n = 2 * count;
  const std::size_t size = points.back().value.size();
  out.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    std::array<double, 6> d{};
    for (std::size_t k = 0; k < n; ++k) d[k] = points[first + k / 2].value[i];
    for (std::size_t k = n - 1; k > 0; --k)
      d[k] =
          k % 2 == 1 ? points[first + k / 2].slope[i] : (d[k] - d[k - 1]) / (node[k] - node[k - 1]);
    for (std::size_t order = 2; order < n; ++order)
      for (std::size_t k = n - 1; k >= order; --k)
        d[k] = (d[k] - d[k - 1]) / (node[k] - node[k - order]);
    double v = d[n - 1];
    for (std::size_t k = n - 1; k-- > 0;) v = v * (parameter - node[k]) + d[k];
    out[i] = v;
  }
}

}  // namespace flexura

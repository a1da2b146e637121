#pragma once

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
///     z(x) = sum_k [ (1 - 2 l_k'(x_k) (x - x_k)) z_k + (x - x_k) z'_k ] l_k(x)^2
/// with l_k the Lagrange polynomials of the points.
inline void extrapolate_hermite(const std::deque<CurvePoint>& points, double parameter,
                                std::vector<double>& out) {
  const std::size_t count = points.size() < 3 ? points.size() : 3;
  const std::size_t first = points.size() - count;
  out.assign(points.back().value.size(), 0.0);
  for (std::size_t k = first; k < points.size(); ++k) {
    const double here = points[k].parameter;
    double lagrange = 1.0;
    double slope = 0.0;  // of it, at its own point
    for (std::size_t j = first; j < points.size(); ++j) {
      if (j == k) continue;
      lagrange *= (parameter - points[j].parameter) / (here - points[j].parameter);
      slope += 1.0 / (here - points[j].parameter);
    }
    const double square = lagrange * lagrange;
    const double of_value = (1.0 - 2.0 * slope * (parameter - here)) * square;
    const double of_slope = (parameter - here) * square;
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] += of_value * points[k].value[i] + of_slope * points[k].slope[i];
  }
}

}  // namespace flexura

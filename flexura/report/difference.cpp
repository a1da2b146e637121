#include "flexura/report/difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexura {
namespace {

Vec2 place_of(const PathState& state, std::size_t point) {
  if (point < state.points.size()) return state.points[point];
  return state.bodies[point - state.points.size()].position;
}

double largest_displacement(const ModelingPath& modeling, std::size_t point) {
  double largest = 0.0;
  for (const PathState& state : modeling.states) {
    const Vec2 moved = place_of(state, point) - place_of(modeling.states.front(), point);
    largest = std::max(largest, norm(moved));
  }
  return largest;
}

// Load factors are equal steps of the same interval, computed by different solvers.
bool same_load_factor(double a, double b) { return std::abs(a - b) <= 1e-9; }

}  // namespace

std::vector<double> difference_series(const PathResult& path, const ModelingPath& modeling,
                                      std::size_t point) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> series(modeling.states.size(), nan);
  const ModelingPath& reference = path.modelings[path.reference];
  if (reference.states.empty()) return series;
  const double scale = largest_displacement(reference, point);
  if (!(scale > 0.0)) return series;
  std::size_t r = 0;  // both run in the order of the path: what was passed is not searched again
  for (std::size_t i = 0; i < modeling.states.size(); ++i) {
    std::size_t match = r;
    while (match < reference.states.size() &&
           !same_load_factor(reference.states[match].load_factor, modeling.states[i].load_factor)) {
      ++match;
    }
    if (match == reference.states.size()) continue;
    r = match;
    series[i] =
        norm(place_of(modeling.states[i], point) - place_of(reference.states[match], point)) /
        scale;
  }
  return series;
}

}  // namespace flexura

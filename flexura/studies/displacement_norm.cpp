#include "flexura/studies/displacement_norm.hpp"

namespace flexura {
namespace {

constexpr double hardly_moves = 1e-6;  // of the largest displacement of any point
constexpr double stands_still = 1e-9;  // of the mechanism's size
constexpr double rounding = 2e-15;     // likewise, of a distance

/// The diagonal of the box around all flexures and bodies as drawn.
double mechanism_extent(const PathState& start) {
  Vec2 low{INFINITY, INFINITY};
  Vec2 high{-INFINITY, -INFINITY};
  const auto take = [&](Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  };
  for (const auto& axis : start.axes)
    for (const Vec2 p : axis) take(p);
  if (start.axes.empty())
    for (const Vec2 p : points_of(start)) take(p);
  return norm(high - low);
}

}  // namespace

std::vector<Vec2> points_of(const PathState& state) {
  if (!state.points.empty()) return state.points;
  std::vector<Vec2> centres;
  for (const Pose& body : state.bodies) centres.push_back(body.position);
  return centres;
}

LargestDisplacements::LargestDisplacements(const PathState& start)
    : start_(points_of(start)), size_(mechanism_extent(start)), largest_(start_.size(), 0.0) {}

void LargestDisplacements::add(const PathState& state) {
  const std::vector<Vec2> now = points_of(state);
  for (std::size_t p = 0; p < now.size(); ++p)
    largest_[p] = std::max(largest_[p], norm(now[p] - start_[p]));
}

std::vector<double> LargestDisplacements::values() const {
  double most = 0.0;
  for (const double d : largest_) most = std::max(most, d);
  const double floor = std::max(hardly_moves * most, stands_still * size_);
  std::vector<double> values = largest_;
  for (double& d : values) d = std::max(d, floor);
  return values;
}

double displacement_rounding(const PathState& start) { return rounding * mechanism_extent(start); }

double relative_distance(const PathState& here, const PathState& there,
                         const std::vector<double>& sizes, double noise) {
  const std::vector<Vec2> a = points_of(here);
  const std::vector<Vec2> b = points_of(there);
  double worst = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p)
    if (norm(a[p] - b[p]) > noise && sizes[p] > 0.0)
      worst = std::max(worst, norm(a[p] - b[p]) / sizes[p]);
  return worst;
}

}  // namespace flexura

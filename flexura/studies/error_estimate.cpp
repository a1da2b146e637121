#include "flexura/studies/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/solvers/newton.hpp"

namespace flexura {
namespace {

/// By which the finer system's moments may differ at first, as turns of a flexure: where they are
/// large in a boundary layer, they differ by more than anything moves.
constexpr double most_moments = 20.0;

}  // namespace

bool ErrorEstimate::solve(const System& system, const std::vector<double>& z, int& iterations) {
  z_ = system.prolong(z, *finer_);
  finer_->hold_as(system);
  const std::vector<double> start = z_;
  std::vector<double> distances;
  double first = 0.0;
  double before = INFINITY;
  for (int k = 1; k <= 20; ++k) {
    ++iterations;
    if (!finer_->linearize(z_)) return false;
    const double size = finer_->newton_step(step_);
    if (!(size < std::max(2.0 * before, 1e-13)) || size > (k == 1 ? most_moments : 1.0))
      return false;
    add_scaled(z_, 1.0, step_);
    distances.push_back(finer_->distance(z_, start));
    if (k == 1) first = size;
    if (k == enough_ && first <= largest_first_step_) return true;
    // what is left is of the order of this step's square
    const bool settled = k > 1 && size * size <= 0.02 * distances.back();
    const bool rounding = size < 1e-13 || (size < 1e-9 && size > 0.3 * before);
    if (settled || rounding) {
      calibrate(distances, first);
      return true;
    }
    before = size;
  }
  return false;
}

void ErrorEstimate::calibrate(const std::vector<double>& distances, double first_step) {
  constexpr double allowed = 0.05;
  const double converged = distances.back();
  const auto off = [&](int iterations) {
    return std::abs(distances[static_cast<std::size_t>(iterations) - 1] - converged);
  };
  enough_ = static_cast<int>(distances.size());
  while (enough_ > 1 && off(enough_ - 1) <= allowed * converged) --enough_;
  // what the iterations left out would change grows at most like the first step, relatively
  const double margin = allowed * converged / std::max(off(enough_), 1e-3 * allowed * converged);
  largest_first_step_ = first_step * std::clamp(margin, 2.0, 50.0);
}

double error_ratio(const System& system) {
  double ratio = 1.0;
  for (const auto& member : system.layout().members)
    ratio = std::max(ratio, member.port->error_ratio());
  return ratio;
}

}  // namespace flexura

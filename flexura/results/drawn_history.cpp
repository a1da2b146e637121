#include "flexura/results/drawn_history.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {

double DrawnHistory::at(double time) const {
  const double last = static_cast<double>(factors.size() - 1);
  const double place = end > 0.0 ? std::clamp(time / end, 0.0, 1.0) * last : 0.0;
  const auto before = static_cast<std::size_t>(std::min(std::floor(place), last - 1.0));
  return std::lerp(factors[before], factors[before + 1], place - static_cast<double>(before));
}

double DrawnHistory::largest() const {
  double size = 0.0;
  for (const double factor : factors) size = std::max(size, std::abs(factor));
  return size;
}

}  // namespace flexura

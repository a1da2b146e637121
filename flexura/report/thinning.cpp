#include "flexura/report/thinning.hpp"

#include <algorithm>

namespace flexura {

std::vector<std::size_t> thinned(std::size_t count, std::size_t longest, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (longest + most - 1) / most);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; i += step) kept.push_back(i);
  if (count > 0 && kept.back() != count - 1) kept.push_back(count - 1);
  return kept;
}

}  // namespace flexura

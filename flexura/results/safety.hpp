#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// Where a path first reaches a strength, interpolated between its states.
struct StrengthReached {
  std::size_t flexure = 0;
  double load_factor = 0.0;
  std::vector<Vec2> displacements;  ///< of PathResult::points, since states[0]
};

/// The stress that a path leads to, against the strengths stated for its flexures.
struct Safety {
  /// The smallest strength per stress at the last state, and whose; absent where nothing is
  /// stressed there.
  std::optional<double> factor;
  std::size_t flexure = 0;
  std::optional<StrengthReached> reached;
};

/// Absent where no flexure has a strength, or the path no state.
std::optional<Safety> find_safety(const PathResult& path, const ModelingPath& modeling);

}  // namespace flexura

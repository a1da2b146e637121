#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "flexura/results/motion_result.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// Where a path or a motion first reaches a strength, interpolated between its states.
struct StrengthReached {
  std::size_t flexure = 0;
  double load_factor = 0.0;         ///< of a motion the time
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
std::optional<Safety> find_safety(const MotionResult& motion, const ModelingMotion& modeling);

/// The largest stress that a motion meets in any flexure, at its output times.
struct StressPeak {
  double stress = 0.0;
  double time = 0.0;
  std::size_t flexure = 0;
};

/// The first of equals; absent where stresses are not known.
std::optional<StressPeak> find_largest_stress(const ModelingMotion& modeling);

}  // namespace flexura

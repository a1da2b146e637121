#pragma once

#include <cstddef>
#include <vector>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// How far a point is from where the study's reference modeling puts it, state by state: the
/// distance at the same load factor divided by the reference's largest displacement of that
/// point. NaN where the reference has no such state or never moves the point. `point` counts
/// path.points and then the centres of path.bodies.
std::vector<double> difference_series(const PathResult& path, const ModelingPath& modeling,
                                      std::size_t point);

}  // namespace flexura

#pragma once

#include "flexura/results/path_result.hpp"

namespace flexura {

/// The largest difference of two paths' reactions at common states, forces and moments each
/// relative to the reference's largest of its kind, but no less than the largest of the other kind
/// at the lever `length` makes. 0 where nothing is held.
double reaction_difference(const ModelingPath& path, const ModelingPath& reference,
                           double length = 0.0);

}  // namespace flexura

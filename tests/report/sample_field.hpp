#pragma once

#include "flexura/results/path_result.hpp"

namespace flexura::sample {

/// Gives a path strips of quadrilaterals along its drawn axes, bent as its members say at the last
/// state: in that state only, or in every one.
void add_stress_fields(ModelingPath& path, bool every_step);

}  // namespace flexura::sample

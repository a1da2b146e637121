#pragma once

#include "flexura/studies/path_tracer.hpp"
#include "robustness/verdict.hpp"

namespace flexura::robustness {

/// Solves once more by geometrically exact beam elements of order 7 and notes how the ends compare.
/// Where the two ends differ, a path by arc length with short steps says which of them lies on the
/// branch that leads on from the unloaded state: if it is the end by `exact`, the elements changed
/// branches; if not, the verdict is taken back.
void compare_with_elements(const RandomMechanism& mechanism, const TracedPath& exact,
                           Verdict& verdict);

}  // namespace flexura::robustness

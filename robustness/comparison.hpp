#pragma once

#include "flexura/studies/path_tracer.hpp"
#include "robustness/verdict.hpp"

namespace flexura::robustness {

/// Solves once more by geometrically exact beam elements of order 7 and notes how the ends compare.
/// Ends may differ where both paths first turned critical at the same load factor, since several
/// branches lead on from there, or where a path by arc length with short steps arrives at the end
/// by `exact`; otherwise the verdict is taken back.
void compare_with_elements(const RandomMechanism& mechanism, const TracedPath& exact,
                           Verdict& verdict);

}  // namespace flexura::robustness

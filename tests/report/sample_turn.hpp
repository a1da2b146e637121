#pragma once

#include "flexura/results/result.hpp"

namespace flexura::sample {

/// A result of studies of kind linkage: the crank of sample_linkage drives its piston. Study `turn`
/// has four methods, of which the last stopped early, and speeds at some of which the motion is
/// unstable or the rod buckles; `slow` has one method and no speeds; `jammed` never ran. Prescribed
/// functions of the angle, independent of every solver of the library. `intervals` is how many the
/// turn has.
Result make_sample_turn(int intervals = 72);

}  // namespace flexura::sample

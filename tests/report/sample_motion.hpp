#pragma once

#include "flexura/results/result.hpp"

namespace flexura::sample {

/// A result of the studies that know time: modes (one of them unstable, with their frequencies
/// along a path), a transient (one modeling stops early) and two responses. A crank drives a piston
/// through an elastic rod pinned to both, and a leaf with a tip stands on the piston: prescribed
/// functions of time, plausible to look at, and independent of every solver of the library.
/// `outputs` is the number of intervals of the transient.
Result make_sample_motion(int outputs = 200);

}  // namespace flexura::sample

#pragma once

#include "flexura/results/result.hpp"

namespace flexura::sample {

/// Where a linkage is: the crank has turned by `turn`, the middle of the rod has gone out by `bow`
/// and the tip of the leaf, seen from the piston, by `bend`.
struct LinkagePose {
  double turn = 0.0;
  double bow = 0.0;
  double bend = 0.0;
};

/// Ground, crank, piston and tip; the rod and the leaf; a shaft, and a guide for the piston.
Drawing make_linkage_drawing();

/// Bodies crank, piston, tip; point tip.P; flexures rod, leaf, their axes of `axis_points`.
PathState make_linkage_state(const LinkagePose& pose, int axis_points);

/// Section forces of the rod and the leaf, of a plausible size.
std::vector<std::vector<MemberStation>> make_linkage_members(const LinkagePose& pose,
                                                             const PathState& state);

}  // namespace flexura::sample

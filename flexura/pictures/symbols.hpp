#pragma once

#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/pictures/svg.hpp"

// Signs of the drawing of mechanisms, in pixels (y down).

namespace flexura::pictures {

/// The built-in end of a flexure: a line across its axis and hatches behind. `direction`, of any
/// length, is that in which what it holds leaves.
struct GroundSign {
  PathData line;
  PathData hatch;
};
GroundSign ground_sign(Vec2 place, Vec2 direction, Box* box);

/// A rail from one place to another, hatched on the right of that direction.
GroundSign rail_sign(Vec2 from, Vec2 to, Box* box);

/// An arrow from `start`, with its filled head at the end; a path to be stroked and filled.
PathData force_arrow(Vec2 start, Vec2 span, Box* box);

/// A turn about a place by `angle` (radians, counter-clockwise on the screen): a line, and a head
/// to be filled.
struct MomentArrow {
  PathData line;
  PathData head;
};
MomentArrow moment_arrow(Vec2 centre, double angle, Box* box);

/// A coil between two places; `turns` is the same in all frames of a picture.
PathData coil(Vec2 from, Vec2 to, int turns, Box* box);
int coil_turns(Vec2 from, Vec2 to);

/// A flat spiral about a place, its outer end at `angle` on the screen.
PathData spiral(Vec2 centre, double angle, Box* box);

}  // namespace flexura::pictures

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// A straight line, or an arc that turns by `sweep` from its start to its end, positive
/// counter-clockwise, less than a full turn.
struct OutlineSide {
  Vec2 from;
  Vec2 to;
  double sweep = 0.0;  ///< 0 is straight
  std::string name;    ///< may be empty

  double length() const;
  double radius() const;  ///< of an arc
  /// The place at a share of the length, 0 to 1.
  Vec2 at(double share) const;
  OutlineSide reversed() const { return {to, from, -sweep, name}; }
};

/// Sides, each from the end of the one before it, and the first from that of the last.
using OutlineLoop = std::vector<OutlineSide>;

/// A side by where it ends; the next one begins there, rounded by a `fillet` of that radius.
struct OutlineStep {
  Vec2 to;
  double sweep = 0.0;
  double fillet = 0.0;
  std::string name;
};

/// A closed line of such steps. What is wrong with it is left in `fault`.
OutlineLoop make_loop(const std::vector<OutlineStep>& steps, std::string& fault);
OutlineLoop make_circle(Vec2 centre, double radius, const std::string& name);

/// A piece of material: what its first loop encloses, less the holes.
struct Outline {
  std::vector<OutlineLoop> loops;
};

/// What is wrong with it, in words that say where: lines that cross, a hole that is outside or in
/// another one.
std::optional<std::string> find_outline_fault(const Outline& outline);

/// The border counter-clockwise and holes clockwise: material on the left of every side.
void orient(Outline& outline);

}  // namespace flexura

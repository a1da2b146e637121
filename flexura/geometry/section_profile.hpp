#pragma once

#include <variant>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// The same thickness t everywhere.
struct LeafProfile {};

/// t at the base end, `end` at the action end, linear in between.
struct TaperProfile {
  double end = 0.0;
};

/// Piecewise linear through points (fraction of the length, multiple of t); fractions ascend from
/// 0 to 1.
struct PiecewiseProfile {
  std::vector<Vec2> points;
};

/// A notch in the middle of the flexure, elliptic with semi-axes a along it and b across, from both
/// sides: t + 2 b (1 - sqrt(1 - (x/a)^2)) at |x| <= a from the middle, t + 2 b beyond. The right
/// circular hinge is a = b.
struct NotchProfile {
  double a = 0.0;
  double b = 0.0;
  bool stated_by_radius = false;  ///< "circular" in the model file, so that messages say the same
};

/// Quarter circles at both ends: t + 2 (r - sqrt(r^2 - (r - d)^2)) at d < r from the nearer end, t
/// between them.
struct FilletProfile {
  double radius = 0.0;
};

/// How a size t of a section (thickness, width, diameter) varies along a flexure.
using Profile =
    std::variant<LeafProfile, TaperProfile, PiecewiseProfile, NotchProfile, FilletProfile>;

/// The size at arc length s of a flexure of length `length`; `t` is the section's own.
double profile_size(const Profile& profile, double t, double s, double length);

/// Arc lengths between 0 and `length`, both included, between which the size is smooth.
std::vector<double> profile_breaks(const Profile& profile, double length);

}  // namespace flexura

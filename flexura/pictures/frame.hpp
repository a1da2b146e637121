#pragma once

#include <cstddef>
#include <vector>

#include "flexura/core/vec2.hpp"
#include "flexura/results/result.hpp"

namespace flexura::pictures {

/// Where a body is: its centre and rotation, and what it has moved from there to first order, as
/// modes and the modeling `linear` know it.
struct BodyPlace {
  Pose at;
  Pose further;
};

/// The mechanism at one moment, in the model's units.
struct Frame {
  std::vector<std::vector<Vec2>> axes;  ///< of Drawing::flexures; as many points in every frame
  std::vector<BodyPlace> bodies;        ///< of Drawing::bodies
  std::vector<Vec2> points;             ///< of Course::points
  double share = 0.0;                   ///< of the loads that grow
  double time = 0.0;                    ///< of loads with histories; in a turn the drive's angle
  std::vector<Reaction> reactions;      ///< of Course::held
};

/// The mechanism as drawn; without points and reactions.
Frame drawn_frame(const Drawing& drawing);

/// Where a place on a body, given as drawn, has gone.
Vec2 carried(const Drawing& drawing, const Frame& frame, std::size_t body, Vec2 place);

/// Index into Drawing::bodies. Precondition: there is one of that name.
std::size_t find_body(const Drawing& drawing, const std::string& name);

struct Weight {
  std::size_t frame = 0;
  double value = 0.0;
};

/// The sum of frames times their weights, which add up to 1. Precondition: their axes match.
Frame blend(const std::vector<Frame>& frames, const std::vector<Weight>& weights);

/// Gives the axes of all frames as many points as those of the first have, evenly by their number.
void match_axes(std::vector<Frame>& frames);

/// What is drawn `factor` times as far from where it was. Precondition: both have the same parts.
Frame exaggerated(const Frame& frame, const Frame& from, double factor);

/// The largest distance of any point, body or place on an axis between two frames.
double distance(const Frame& a, const Frame& b);

/// Frames at `positions`, by cubics through the frames known at the ascending `times`.
std::vector<Frame> resample(const std::vector<Frame>& frames, const std::vector<double>& times,
                            const std::vector<double>& positions);

}  // namespace flexura::pictures

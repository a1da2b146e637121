#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

struct LineAxis {
  Vec2 start;
  Vec2 end;
};

/// Angles in radians; a positive sweep is counter-clockwise. The axis starts at
/// centre + radius (cos start, sin start).
struct ArcAxis {
  Vec2 centre;
  double radius = 0.0;
  double start = 0.0;
  double sweep = 0.0;
};

/// Cubic over the cumulative chord length, through all points in order: not-a-knot at an end
/// without a tangent, clamped to the direction of the tangent (any length) where one is given.
struct SplineAxis {
  std::vector<Vec2> points;
  std::optional<Vec2> start_tangent;
  std::optional<Vec2> end_tangent;
};

/// The undeformed axis of a flexure as the engineer wrote it.
using AxisShape = std::variant<LineAxis, ArcAxis, SplineAxis>;

/// The axis over its arc length s, 0 to length(), from the base end to the action end.
class AxisCurve {
 public:
  /// Precondition: the shape has a length (no coinciding neighbours, radius > 0, sweep != 0).
  explicit AxisCurve(const AxisShape& shape);

  double length() const { return breaks_.back(); }
  Vec2 position(double s) const;
  /// Angle of the tangent from the global x axis, continuous along the axis (radians).
  double tangent_angle(double s) const;
  /// d tangent_angle / d s.
  double curvature(double s) const;
  /// Arc lengths between which the axis is smooth: 0, the knots of a spline, length().
  const std::vector<double>& breaks() const { return breaks_; }
  /// Total absolute turning of the tangent (radians).
  double turning() const { return turning_; }
  const AxisShape& shape() const { return shape_; }

 private:
  struct Cubic {  // one piece of a spline over t in [0, 1]: c[0] + c[1] t + c[2] t^2 + c[3] t^3
    Vec2 c[4];
    double start_angle = 0.0;  // of the tangent at t = 0, continuous from piece to piece
  };
  void make_spline(const SplineAxis& spline);
  std::size_t piece_at(double s) const;
  double parameter_at(std::size_t piece, double s) const;

  AxisShape shape_;
  std::vector<double> breaks_;
  std::vector<Cubic> pieces_;
  double turning_ = 0.0;
};

}  // namespace flexura

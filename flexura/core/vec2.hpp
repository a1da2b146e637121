#pragma once

#include <cmath>

namespace flexura {

/// A vector of the plane, global axes unless said otherwise.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
constexpr Vec2 operator*(Vec2 a, double k) { return k * a; }

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// The out-of-plane component of a x b.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// The vector turned by +90 degrees.
constexpr Vec2 perp(Vec2 a) { return {-a.y, a.x}; }
inline double norm(Vec2 a) { return std::hypot(a.x, a.y); }
inline Vec2 unit(double angle) { return {std::cos(angle), std::sin(angle)}; }
inline Vec2 rotate(double angle, Vec2 a) {
  const Vec2 e = unit(angle);
  return {e.x * a.x - e.y * a.y, e.y * a.x + e.x * a.y};
}

/// Where a body, or a section of a flexure, is: its position and its rotation since the start
/// (radians, counter-clockwise positive, continuous over full turns).
struct Pose {
  Vec2 position;
  double rotation = 0.0;

  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace flexura

#include "flexura/pictures/symbols.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexura::pictures {
namespace {

constexpr double hatch_step = 6.0;
constexpr double hatch_depth = 8.0;

Vec2 unit_along(Vec2 v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : Vec2{0.0, -1.0};
}

/// Hatches behind a line that starts at `start` and is `length` long along `along`.
PathData hatches(Vec2 start, Vec2 along, Vec2 behind, double length, Box* box) {
  PathData data(box);
  const int count = static_cast<int>((length + 0.5) / hatch_step);
  for (int k = 1; k <= count; ++k) {
    const Vec2 place = start + hatch_step * k * along;
    data.move(place).line(place - hatch_step * along + hatch_depth * behind);
  }
  return data;
}

/// A triangle whose tip is at the end of `neck` + size `along`.
void add_head(PathData& data, Vec2 neck, Vec2 along, double size) {
  const Vec2 across = 0.38 * size * perp(along);
  data.move(neck + size * along).line(neck + across).line(neck - across).close();
}

}  // namespace

GroundSign ground_sign(Vec2 place, Vec2 direction, Box* box) {
  constexpr double half = 15.0;
  const Vec2 behind = -unit_along(direction);
  const Vec2 along = perp(behind);
  GroundSign sign{PathData(box, 1.0), hatches(place - half * along, along, behind, 2 * half, box)};
  sign.line.move(place - half * along).line(place + half * along);
  return sign;
}

GroundSign rail_sign(Vec2 from, Vec2 to, Box* box) {
  const Vec2 along = unit_along(to - from);
  GroundSign sign{PathData(box, 1.0), hatches(from, along, perp(along), norm(to - from), box)};
  sign.line.move(from).line(to);
  return sign;
}

PathData force_arrow(Vec2 start, Vec2 span, Box* box) {
  const double length = norm(span);
  const Vec2 along = length > 0.0 ? (1.0 / length) * span : Vec2{};
  const double head = std::min(11.0, 0.7 * length);
  const Vec2 neck = start + (length - head) * along;
  PathData data(box, 1.0);
  data.move(start).line(neck);
  add_head(data, neck, along, head);
  return data;
}

MomentArrow moment_arrow(Vec2 centre, double angle, Box* box) {
  constexpr double radius = 22.0;
  constexpr int pieces = 14;
  constexpr double start = 0.5 * std::numbers::pi - 0.6;
  const auto place = [&](double a) { return centre + radius * Vec2{std::cos(a), -std::sin(a)}; };
  MomentArrow arrow{PathData(box, 1.0), PathData(box, 1.0)};
  arrow.line.move(place(start));
  for (int k = 1; k <= pieces; ++k) arrow.line.line(place(start + angle * k / pieces));
  const double head = std::min(11.0, 0.5 * radius * std::abs(angle));
  const double end = start + angle;
  const double sense = angle < 0.0 ? -1.0 : 1.0;
  add_head(arrow.head, place(end), sense * Vec2{-std::sin(end), -std::cos(end)}, head);
  return arrow;
}

int coil_turns(Vec2 from, Vec2 to) {
  return 2 * static_cast<int>(std::lround(std::clamp(norm(to - from) / 11.0, 3.0, 20.0)));
}

PathData coil(Vec2 from, Vec2 to, int turns, Box* box) {
  constexpr double half = 5.0;
  const double length = norm(to - from);
  const Vec2 along = unit_along(to - from);
  const double lead = std::min(10.0, 0.2 * length);
  PathData data(box, 1.0);
  data.move(from).line(from + lead * along);
  for (int k = 0; k < turns; ++k) {
    const double at = lead + (length - 2.0 * lead) * (k + 0.5) / turns;
    data.line(from + at * along + (k % 2 == 0 ? -half : half) * perp(along));
  }
  data.line(to - lead * along).line(to);
  return data;
}

PathData spiral(Vec2 centre, double angle, Box* box) {
  constexpr double radius = 13.0;
  constexpr int pieces = 36;
  PathData data(box, 1.0);
  data.move(centre);
  for (int k = 1; k <= pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    const double a = angle + 4.0 * std::numbers::pi * share;
    data.line(centre + radius * share * Vec2{std::cos(a), std::sin(a)});
  }
  return data;
}

}  // namespace flexura::pictures

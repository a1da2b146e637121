#include "tests/report/sample_linkage.hpp"

#include <cmath>
#include <numbers>

namespace flexura::sample {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double crank_length = 10.0;
constexpr double rod_length = 60.0;
constexpr double leaf_length = 45.0;
constexpr Vec2 beyond_tip{0.0, 7.0};  // from the leaf's end to the point P
constexpr int drawn_points = 41;

double share(int k, int count) { return static_cast<double>(k) / (count - 1); }

Vec2 crank_pin(const LinkagePose& pose) { return crank_length * unit(pose.turn); }

Vec2 piston_place(const LinkagePose& pose) {
  const Vec2 pin = crank_pin(pose);
  return {pin.x + std::sqrt(rod_length * rod_length - pin.y * pin.y), 0.0};
}

std::vector<Vec2> rod_axis(const LinkagePose& pose, int count) {
  const Vec2 pin = crank_pin(pose);
  const Vec2 along = piston_place(pose) - pin;
  const Vec2 across = (1.0 / norm(along)) * perp(along);
  std::vector<Vec2> axis;
  for (int k = 0; k < count; ++k)
    axis.push_back(pin + share(k, count) * along +
                   pose.bow * std::sin(pi * share(k, count)) * across);
  return axis;
}

std::vector<Vec2> leaf_axis(const LinkagePose& pose, int count) {
  std::vector<Vec2> axis;
  for (int k = 0; k < count; ++k) {
    const double s = share(k, count);
    axis.push_back(piston_place(pose) + Vec2{0.5 * pose.bend * s * s * (3.0 - s), s * leaf_length});
  }
  return axis;
}

double leaf_turn(const LinkagePose& pose) { return -1.5 * pose.bend / leaf_length; }

}  // namespace

Drawing make_linkage_drawing() {
  const LinkagePose start;
  const Vec2 pin = crank_pin(start);
  const Vec2 piston = piston_place(start);
  const Vec2 tip = leaf_axis(start, 2).back();
  Drawing drawing;
  drawing.flexures = {{"rod", "crank", "piston", true, true, rod_axis(start, drawn_points), 0.8},
                      {"leaf", "piston", "tip", false, false, leaf_axis(start, drawn_points), 0.4}};
  drawing.bodies = {{"ground", true, {}, {}, {}, {}},
                    {"crank", false, {}, {pin}, {}, {}},
                    {"piston", false, piston, {piston, piston}, {}, {}},
                    {"tip", false, tip, {tip}, {"P"}, {tip + beyond_tip}}};
  drawing.joints = {{"shaft", "ground", "crank", {0.0, 0.0}, {}},
                    {"guide", "ground", "piston", piston, Vec2{1.0, 0.0}}};
  return drawing;
}

PathState make_linkage_state(const LinkagePose& pose, int axis_points) {
  PathState state;
  state.axes = {rod_axis(pose, axis_points), leaf_axis(pose, axis_points)};
  const Vec2 tip = state.axes[1].back();
  state.bodies = {{{0.0, 0.0}, pose.turn}, {piston_place(pose), 0.0}, {tip, leaf_turn(pose)}};
  state.points = {tip + rotate(leaf_turn(pose), beyond_tip)};
  const Vec2 along = piston_place(pose) - crank_pin(pose);
  state.mids = {{rod_axis(pose, 3)[1], std::atan2(along.y, along.x)},
                {leaf_axis(pose, 3)[1], 0.5 * leaf_turn(pose)}};
  state.peak_stresses = {30.0 * std::abs(pose.bow), 8.0 * std::abs(pose.bend)};
  return state;
}

std::vector<std::vector<MemberStation>> make_linkage_members(const LinkagePose& pose,
                                                             const PathState& state) {
  std::vector<std::vector<MemberStation>> members(2);
  for (std::size_t f = 0; f < members.size(); ++f) {
    const std::vector<Vec2>& axis = state.axes[f];
    const int count = static_cast<int>(axis.size());
    for (int k = 0; k < count; ++k) {
      const double s = share(k, count);
      const double moment =
          f == 0 ? 2.0 * pose.bow * std::sin(pi * s) : 3.0 * pose.bend * (1.0 - s);
      const double length = f == 0 ? rod_length : leaf_length;
      members[f].push_back({s * length,
                            {axis[static_cast<std::size_t>(k)], 0.0},
                            f == 0 ? -1.5 : 0.02,
                            f == 0 ? 0.1 * pose.bow * std::cos(pi * s) : -3.0 * pose.bend / length,
                            moment,
                            std::abs(moment) * 6.0});
    }
  }
  return members;
}

}  // namespace flexura::sample

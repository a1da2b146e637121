#include <algorithm>
#include <cmath>
#include <functional>

#include "flexura/pictures/parts.hpp"
#include "flexura/pictures/symbols.hpp"

namespace flexura::pictures {
namespace {

constexpr double shortest_arrow = 16.0;
constexpr double longest_arrow = 62.0;
constexpr double largest_turn = 4.4;  // radians, of the arrow of a moment

/// Where a load's body is, and the place on it as drawn.
struct LoadedPlace {
  std::size_t body = 0;
  std::optional<std::size_t> point;  ///< index into DrawnBody::points
};

std::optional<LoadedPlace> find_place(const Drawing& drawing, const std::string& on) {
  for (std::size_t b = 0; b < drawing.bodies.size(); ++b) {
    const DrawnBody& body = drawing.bodies[b];
    if (on == body.name) return LoadedPlace{b, {}};
    for (std::size_t p = 0; p < body.points.size(); ++p)
      if (on == body.name + "." + body.point_names[p]) return LoadedPlace{b, p};
  }
  return {};
}

Vec2 place_in(const Sheet& sheet, const Frame& frame, const LoadedPlace& place) {
  const DrawnBody& body = sheet.drawing.bodies[place.body];
  if (!place.point) return carried(sheet.drawing, frame, place.body, body.centre);
  const std::string name = body.name + "." + body.point_names[*place.point];
  const auto found = std::ranges::find(sheet.course.points, name);
  const auto index = static_cast<std::size_t>(found - sheet.course.points.begin());
  return index < frame.points.size()
             ? frame.points[index]
             : carried(sheet.drawing, frame, place.body, body.points[*place.point]);
}

/// Arrows of a force and a moment that change from frame to frame; sizes as shares of the longest.
std::string arrows(const Sheet& sheet, const LoadedPlace& place,
                   const std::function<Vec2(const Frame&)>& force,
                   const std::function<double(const Frame&)>& moment) {
  std::vector<std::string> straight;
  std::vector<std::string> round;
  std::vector<std::string> heads;
  bool any_force = false;
  bool any_moment = false;
  for (const Frame& frame : sheet.course.frames) {
    any_force = any_force || norm(force(frame)) > 1e-3;
    any_moment = any_moment || std::abs(moment(frame)) > 1e-3;
  }
  for (const Frame& frame : sheet.course.frames) {
    const Vec2 at = sheet.screen(place_in(sheet, frame, place));
    const Vec2 f = force(frame);
    const Vec2 span = longest_arrow * Vec2{f.x, -f.y};
    straight.push_back(force_arrow(at, span, any_force ? sheet.box : nullptr).text());
    const MomentArrow turn =
        moment_arrow(at, largest_turn * moment(frame), any_moment ? sheet.box : nullptr);
    round.push_back(turn.line.text());
    heads.push_back(turn.head.text());
  }
  std::string text;
  if (any_force) text += path_element("class=\"load\"", straight, {}, sheet.clock);
  if (any_moment)
    text += path_element("class=\"load\" fill=\"none\"", round, {}, sheet.clock) +
            path_element("class=\"load\"", heads, {}, sheet.clock);
  return text;
}

double largest_factor(const DrawnLoad& load) {
  return load.history ? load.history->largest() : 1.0;
}

std::string load_text(const Sheet& sheet, const DrawnLoad& load, double force, double moment,
                      double share) {
  const std::optional<LoadedPlace> place = find_place(sheet.drawing, load.on);
  if (!place) return {};
  const double peak = largest_factor(load);
  const auto grown = [&](const Frame& f) {
    if (load.history) return peak > 0.0 ? load.history->at(f.time) / peak : 0.0;
    return load.constant || share == 0.0 ? 1.0 : f.share / share;
  };
  const double size = peak * norm(load.force);
  const double length =
      force > 0.0
          ? (shortest_arrow + (longest_arrow - shortest_arrow) * size / force) / longest_arrow
          : 0.0;
  return arrows(
      sheet, *place,
      [&](const Frame& frame) {
        if (size == 0.0) return Vec2{};
        const Vec2 along = (length * grown(frame) / norm(load.force)) * load.force;
        return load.follower ? rotate(frame.bodies[place->body].at.rotation, along) : along;
      },
      [&](const Frame& frame) {
        return moment > 0.0 ? grown(frame) * peak * load.moment / moment : 0.0;
      });
}

std::string reaction_texts(const Sheet& sheet) {
  double force = 0.0;
  double moment = 0.0;
  for (const Frame& frame : sheet.course.frames)
    for (const Reaction& reaction : frame.reactions) {
      force = std::max(force, norm(reaction.force));
      moment = std::max(moment, std::abs(reaction.moment));
    }
  // What holds a rotation needs forces only by rounding, and the other way round.
  const double lever = 0.02 * extent(sheet.drawing);
  const bool forces = force * lever > 1e-3 * moment;
  const bool moments = moment > force * lever;
  std::string text;
  for (std::size_t h = 0; h < sheet.course.held.size(); ++h) {
    const std::optional<LoadedPlace> place = find_place(sheet.drawing, sheet.course.held[h].name);
    if (!place) continue;
    text += arrows(
        sheet, *place,
        [&](const Frame& frame) {
          return forces && h < frame.reactions.size() ? (1.0 / force) * frame.reactions[h].force
                                                      : Vec2{};
        },
        [&](const Frame& frame) {
          return moments && h < frame.reactions.size() ? frame.reactions[h].moment / moment : 0.0;
        });
  }
  return text;
}

/// Points that stay where they are have no way.
bool wanders(const Sheet& sheet, std::size_t p) {
  const double least = 0.004 * extent(sheet.drawing);
  for (const auto* frames : {&sheet.course.frames, &sheet.course.way})
    for (const Frame& frame : *frames)
      if (norm(frame.points[p] - frames->front().points[p]) > least) return true;
  return false;
}

}  // namespace

std::string load_layer(const Sheet& sheet, const std::vector<DrawnLoad>& loads) {
  double force = 0.0;
  double moment = 0.0;
  double share = 0.0;
  for (const DrawnLoad& load : loads) {
    force = std::max(force, largest_factor(load) * norm(load.force));
    moment = std::max(moment, largest_factor(load) * std::abs(load.moment));
  }
  for (const Frame& frame : sheet.course.frames) share = std::max(share, std::abs(frame.share));
  std::string text;
  for (const DrawnLoad& load : loads) text += load_text(sheet, load, force, moment, share);
  return text + reaction_texts(sheet);
}

std::string way_layer(const Sheet& sheet) {
  std::string ways;
  std::string dots;
  for (std::size_t p = 0; p < sheet.course.frames.front().points.size(); ++p) {
    if (!wanders(sheet, p)) continue;
    PathData way(sheet.box, 1.0);
    std::vector<Vec2> places;
    for (const Frame& frame : sheet.course.way) places.push_back(sheet.screen(frame.points[p]));
    if (!places.empty()) ways += path_element("class=\"way\"", way.lines(places));
    std::vector<std::string> data;
    for (const Frame& frame : sheet.course.frames)
      data.push_back(PathData(sheet.box, 1.0).circle(sheet.screen(frame.points[p]), 3.5).text());
    dots += path_element("class=\"dot\"", data, {}, sheet.clock);
  }
  return ways + dots;
}

}  // namespace flexura::pictures

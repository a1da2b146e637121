#include <algorithm>
#include <cmath>

#include "flexura/pictures/parts.hpp"
#include "flexura/pictures/symbols.hpp"

namespace flexura::pictures {
namespace {

constexpr double pin_radius = 4.5;

/// A place that a fixed body holds, and where what it holds goes on from there.
struct Held {
  Vec2 place;
  Vec2 next;
  bool pinned = false;
};

bool is_fixed(const Drawing& drawing, const std::string& body) {
  return drawing.bodies[find_body(drawing, body)].fixed;
}

/// Where an end of a flexure is fastened as drawn: `ends` of bodies are in the order of flexures.
Vec2 fastened(const Drawing& drawing, std::size_t flexure, const std::string& body) {
  std::size_t end = 0;
  for (std::size_t f = 0; f < flexure; ++f)
    if (drawing.flexures[f].base == body || drawing.flexures[f].action == body) ++end;
  return drawing.bodies[find_body(drawing, body)].ends[end];
}

void add_held_flexures(const Drawing& drawing, std::vector<Held>& held) {
  for (std::size_t f = 0; f < drawing.flexures.size(); ++f) {
    const DrawnFlexure& flexure = drawing.flexures[f];
    const std::vector<Vec2>& axis = flexure.axis;
    const Vec2 from = fastened(drawing, f, flexure.base);
    const Vec2 to = fastened(drawing, f, flexure.action);
    // A border does not say how it leaves its ends.
    const bool strip = flexure.depth > 0.0;
    if (is_fixed(drawing, flexure.base))
      held.push_back({from, strip ? axis[1] : to, flexure.pinned_base});
    if (is_fixed(drawing, flexure.action))
      held.push_back({to, strip ? axis[axis.size() - 2] : from, flexure.pinned_action});
  }
}

/// Where the rest of a body is, seen from a pin on it; up, if there is no rest.
Vec2 away(const DrawnBody& body, Vec2 pin) {
  Vec2 sum;
  double count = 0.0;
  for (const auto* places : {&body.ends, &body.points})
    for (const Vec2 p : *places)
      if (norm(p - pin) > 0.0) {
        sum = sum + p;
        count += 1.0;
      }
  return count > 0.0 ? (1.0 / count) * sum : pin + Vec2{0.0, 1.0};
}

std::vector<Held> held_places(const Sheet& sheet) {
  const Drawing& drawing = sheet.drawing;
  std::vector<Held> held;
  add_held_flexures(drawing, held);
  for (const DrawnSpring& spring : drawing.springs) {
    if (spring.torsional) continue;
    if (is_fixed(drawing, spring.base)) held.push_back({spring.base_place, spring.action_place});
    if (is_fixed(drawing, spring.action)) held.push_back({spring.action_place, spring.base_place});
  }
  for (const DrawnJoint& joint : drawing.joints) {
    if (joint.direction) continue;
    const bool base_fixed = is_fixed(drawing, joint.base);
    if (!base_fixed && !is_fixed(drawing, joint.action)) continue;
    const std::string& moving = base_fixed ? joint.action : joint.base;
    held.push_back({joint.at, away(drawing.bodies[find_body(drawing, moving)], joint.at), true});
  }
  for (const std::size_t b : sheet.course.shafts) {
    const Vec2 centre = drawing.bodies[b].centre;
    held.push_back({centre, centre + Vec2{0.0, 1.0}, true});
  }
  return held;
}

/// A rail in the ground, as long as the slider needs it.
std::string ground_rail(const Sheet& sheet, const DrawnJoint& joint) {
  constexpr double beyond = 18.0;
  constexpr double below = 7.0;
  const std::size_t body = find_body(sheet.drawing, joint.action);
  const Vec2 d = (1.0 / norm(*joint.direction)) * *joint.direction;
  const Vec2 along{d.x, -d.y};  // on the screen
  const Vec2 start = sheet.screen(joint.at);
  double least = 0.0;
  double most = 0.0;
  for (const auto* frames : {&sheet.course.frames, &sheet.course.way})
    for (const Frame& frame : *frames) {
      const double at =
          dot(sheet.screen(carried(sheet.drawing, frame, body, joint.at)) - start, along);
      least = std::min(least, at);
      most = std::max(most, at);
    }
  Vec2 side = perp(along);
  if (side.y < 0.0) side = -side;
  const Vec2 from = start + (least - beyond) * along + below * side;
  const Vec2 to = start + (most + beyond) * along + below * side;
  const bool turned = dot(perp(to - from), side) < 0.0;
  const GroundSign sign = turned ? rail_sign(to, from, sheet.box) : rail_sign(from, to, sheet.box);
  return path_element("class=\"ground-line\"", sign.line) +
         path_element("class=\"hatch\"", sign.hatch);
}

std::string pin_text(const Sheet& sheet, const std::vector<Vec2>& places) {
  std::vector<std::string> data;
  data.reserve(places.size());
  for (const Vec2 place : places)
    data.push_back(PathData(sheet.box, 1.0).circle(sheet.screen(place), pin_radius).text());
  return path_element("class=\"pin\"", data, {}, sheet.clock);
}

std::string slider_text(const Sheet& sheet, const DrawnJoint& joint) {
  const std::size_t base = find_body(sheet.drawing, joint.base);
  const std::size_t body = find_body(sheet.drawing, joint.action);
  std::vector<std::string> data;
  for (const Frame& frame : sheet.course.frames) {
    const Vec2 at = sheet.screen(carried(sheet.drawing, frame, body, joint.at));
    const Vec2 d = rotate(frame.bodies[base].at.rotation, *joint.direction);
    const Vec2 along = (1.0 / norm(d)) * Vec2{d.x, -d.y};
    const auto corner = [&](double x, double y) { return at + x * along + y * perp(along); };
    data.push_back(PathData(sheet.box, 1.0)
                       .lines({corner(-12, -7), corner(12, -7), corner(12, 7), corner(-12, 7)})
                       .close()
                       .text());
  }
  return path_element("class=\"slider\"", data, {}, sheet.clock);
}

}  // namespace

std::string ground_layer(const Sheet& sheet) {
  std::string text;
  for (const Held& held : held_places(sheet)) {
    const Vec2 place = sheet.screen(held.place);
    const GroundSign sign = ground_sign(place, sheet.screen(held.next) - place, sheet.box);
    text += path_element("class=\"ground-line\"", sign.line) +
            path_element("class=\"hatch\"", sign.hatch);
  }
  for (const DrawnJoint& joint : sheet.drawing.joints)
    if (joint.direction && is_fixed(sheet.drawing, joint.base)) text += ground_rail(sheet, joint);
  return text;
}

std::string joint_layer(const Sheet& sheet) {
  const Drawing& drawing = sheet.drawing;
  const std::vector<Frame>& frames = sheet.course.frames;
  const auto everywhere = [&](const auto& place) {
    std::vector<Vec2> places;
    places.reserve(frames.size());
    for (const Frame& frame : frames) places.push_back(place(frame));
    return places;
  };
  std::string text;
  for (const DrawnJoint& joint : drawing.joints)
    if (joint.direction) text += slider_text(sheet, joint);
  for (const DrawnJoint& joint : drawing.joints) {
    if (joint.direction) continue;
    const std::size_t body = find_body(drawing, joint.action);
    text += pin_text(
        sheet, everywhere([&](const Frame& f) { return carried(drawing, f, body, joint.at); }));
  }
  for (std::size_t f = 0; f < drawing.flexures.size(); ++f) {
    const DrawnFlexure& flexure = drawing.flexures[f];
    for (const bool base : {true, false}) {
      if (base ? !flexure.pinned_base : !flexure.pinned_action) continue;
      const std::size_t body = find_body(drawing, base ? flexure.base : flexure.action);
      const Vec2 end = fastened(drawing, f, drawing.bodies[body].name);
      text += pin_text(sheet, everywhere([&](const Frame& frame) {
                         if (!(flexure.depth > 0.0)) return carried(drawing, frame, body, end);
                         return base ? frame.axes[f].front() : frame.axes[f].back();
                       }));
    }
  }
  for (const std::size_t b : sheet.course.shafts)
    text += pin_text(sheet, std::vector(frames.size(), drawing.bodies[b].centre));
  return text;
}

std::string spring_layer(const Sheet& sheet) {
  const Drawing& drawing = sheet.drawing;
  std::string text;
  for (const DrawnSpring& spring : drawing.springs) {
    const std::size_t base = find_body(drawing, spring.base);
    const std::size_t action = find_body(drawing, spring.action);
    const int turns =
        coil_turns(sheet.screen(spring.base_place), sheet.screen(spring.action_place));
    std::vector<std::string> data;
    for (const Frame& frame : sheet.course.frames) {
      const Vec2 end = sheet.screen(carried(drawing, frame, action, spring.action_place));
      if (spring.torsional) {
        const double turn = frame.bodies[base].at.rotation - frame.bodies[action].at.rotation;
        data.push_back(spiral(end, turn, sheet.box).text());
        continue;
      }
      const Vec2 start = sheet.screen(carried(drawing, frame, base, spring.base_place));
      data.push_back(coil(start, end, turns, sheet.box).text());
    }
    text += path_element("class=\"spring\"", data, {}, sheet.clock);
  }
  return text;
}

}  // namespace flexura::pictures

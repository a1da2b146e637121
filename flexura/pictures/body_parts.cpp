#include <fmt/format.h>

#include <algorithm>

#include "flexura/pictures/outline.hpp"
#include "flexura/pictures/parts.hpp"

namespace flexura::pictures {
namespace {

/// Corners of what is drawn of a body: a closed hull, or arms where that would hide flexures.
struct BodyShape {
  std::vector<std::size_t> hull;
  std::vector<std::pair<std::size_t, std::size_t>> arms;
};

BodyShape shape_of(const Sheet& sheet, const Frame& frame, std::size_t body) {
  const std::vector<Vec2> places = outline_places(sheet, frame, body);
  BodyShape shape{convex_hull(places), {}};
  std::vector<Vec2> corners;
  for (const std::size_t i : shape.hull) corners.push_back(places[i]);
  const double margin = 0.01 * extent(sheet.drawing);
  const bool hides = std::ranges::any_of(frame.axes, [&](const std::vector<Vec2>& axis) {
    return std::ranges::any_of(axis, [&](Vec2 p) { return lies_inside(corners, p, margin); });
  });
  if (hides) shape = {{}, shortest_arms(places)};
  return shape;
}

PathData outline(const Sheet& sheet, const Frame& frame, std::size_t body, const BodyShape& shape,
                 double radius) {
  const std::vector<Vec2> places = outline_places(sheet, frame, body);
  PathData data(sheet.box, radius);
  for (const auto& [from, to] : shape.arms)
    data.move(sheet.screen(places[from])).line(sheet.screen(places[to]));
  for (std::size_t k = 0; k < shape.hull.size(); ++k) {
    const Vec2 corner = sheet.screen(places[shape.hull[k]]);
    k == 0 ? data.move(corner) : data.line(corner);
  }
  if (!shape.hull.empty()) data.close();
  return data;
}

double body_radius(const Sheet& sheet) {
  return std::clamp(0.011 * extent(sheet.drawing) * sheet.screen.scale, 4.0, 7.0);
}

std::string bodies_text(const Sheet& sheet, const std::vector<Frame>& frames, bool ghost) {
  std::string text;
  const double radius = body_radius(sheet);
  for (std::size_t b = 0; b < sheet.drawing.bodies.size(); ++b) {
    if (sheet.drawing.bodies[b].fixed) continue;
    const BodyShape shape = shape_of(sheet, sheet.course.ghosts.front(), b);
    std::vector<std::string> data;
    data.reserve(frames.size());
    for (const Frame& frame : frames)
      data.push_back(outline(sheet, frame, b, shape, radius).text());
    if (data.front().empty()) continue;
    Clock clock = sheet.clock;
    if (data.size() == 1) clock = {};
    const char* fill = shape.arms.empty() ? "" : " fill=\"none\"";
    if (ghost) {
      text += path_element(
          fmt::format("class=\"ghost-body\" stroke-width=\"{:.1f}\"{}", 2.0 * radius, fill), data,
          {}, clock);
      continue;
    }
    text += "<defs>" + path_element(fmt::format("id=\"body{}\"{}", b, fill), data, {}, clock);
    text += fmt::format(
        "</defs><use href=\"#body{0}\" class=\"edge\" stroke-width=\"{1:.1f}\"/>"
        "<use href=\"#body{0}\" class=\"body\" stroke-width=\"{2:.1f}\"/>\n",
        b, 2.0 * radius + 2.0, 2.0 * radius);
  }
  return text;
}

}  // namespace

std::vector<Vec2> outline_places(const Sheet& sheet, const Frame& frame, std::size_t body) {
  const Drawing& drawing = sheet.drawing;
  const DrawnBody& drawn = drawing.bodies[body];
  std::vector<Vec2> places;
  std::size_t end = 0;
  for (std::size_t f = 0; f < drawing.flexures.size(); ++f) {
    const DrawnFlexure& flexure = drawing.flexures[f];
    // Ends of axes are where the flexure has gone; a border has none.
    const bool strip = flexure.depth > 0.0;
    const auto add = [&](Vec2 tip) {
      places.push_back(strip ? tip : carried(drawing, frame, body, drawn.ends[end]));
      ++end;
    };
    if (flexure.base == drawn.name) add(frame.axes[f].front());
    if (flexure.action == drawn.name) add(frame.axes[f].back());
  }
  for (std::size_t p = 0; p < drawn.points.size(); ++p) {
    const std::string name = drawn.name + "." + drawn.point_names[p];
    const auto found = std::ranges::find(sheet.course.points, name);
    const auto index = static_cast<std::size_t>(found - sheet.course.points.begin());
    places.push_back(index < frame.points.size() ? frame.points[index]
                                                 : carried(drawing, frame, body, drawn.points[p]));
  }
  for (const DrawnJoint& joint : drawing.joints) {
    if (joint.action == drawn.name || (joint.base == drawn.name && !joint.direction))
      places.push_back(carried(drawing, frame, body, joint.at));
  }
  const bool has_shaft = std::ranges::find(sheet.course.shafts, body) != sheet.course.shafts.end();
  if (places.empty() || has_shaft) places.push_back(carried(drawing, frame, body, drawn.centre));
  return places;
}

std::string ghost_layer(const Sheet& sheet) {
  return bodies_text(sheet, sheet.course.ghosts, true) + ghost_flexures(sheet);
}

std::string body_layer(const Sheet& sheet) {
  return bodies_text(sheet, sheet.course.frames, false);
}

}  // namespace flexura::pictures

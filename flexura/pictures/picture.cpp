#include "flexura/pictures/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flexura/core/nearest_word.hpp"
#include "flexura/pictures/course.hpp"
#include "flexura/pictures/parts.hpp"
#include "flexura/pictures/svg.hpp"

namespace flexura {
namespace pictures {
namespace {

constexpr double most_wide = 620.0;  // pixels, of the mechanism itself
constexpr double most_high = 420.0;
constexpr double margin = 14.0;
constexpr double footer = 34.0;
constexpr double least_wide = 470.0;  // for the footer's words

constexpr std::size_t most_pieces = 16;
constexpr std::size_t still_pieces = 40;
constexpr std::size_t fewest_pieces = 6;
constexpr std::size_t most_bytes = 90000;  // of the flexures' pieces

constexpr const char* style =
    ".paper{fill:#fff}"
    ".ghost{stroke:#e3e7ec;fill:none;stroke-linejoin:round}"
    ".ghost-body{stroke:#eef0f3;fill:#eef0f3;stroke-linejoin:round;stroke-linecap:round}"
    ".ghost-body[fill=none]{fill:none}"
    ".ghost-link{fill:#e9ecf0}"
    ".ground-line{stroke:#3d4752;stroke-width:2;fill:none}"
    ".hatch{stroke:#3d4752;stroke-width:1;fill:none}"
    ".edge{stroke:#66727f;fill:#66727f;stroke-linejoin:round;stroke-linecap:round}"
    ".body{stroke:#c3ccd6;fill:#c3ccd6;stroke-linejoin:round;stroke-linecap:round}"
    ".strip{stroke:currentColor;fill:none;stroke-linecap:round}"
    ".solid{stroke:currentColor;fill:currentColor;stroke-width:1.2}"
    ".link{fill:#8fadd3}"  // a line round it would show the slits to its holes
    ".spring{fill:none;stroke:#3d4752;stroke-width:1.4;stroke-linejoin:round}"
    ".pin,.dot{fill:#fff;stroke:#3d4752;stroke-width:1.5}"
    ".slider{fill:#dfe4ea;stroke:#3d4752;stroke-width:1.5}"
    ".way{fill:none;stroke:#7a4fb5;stroke-width:1.3;stroke-dasharray:4 3}"
    ".dot{stroke:#7a4fb5}"
    ".load{stroke:#111;stroke-width:1.7}"
    "text{font:12px system-ui,sans-serif;fill:#4c5763}"
    ".bar{fill:none;stroke:#4c5763;stroke-width:1.3}";

Box box_of(const Course& course) {
  Box box;
  for (const auto* frames : {&course.frames, &course.ghosts, &course.way})
    for (const Frame& frame : *frames) {
      for (const std::vector<Vec2>& axis : frame.axes)
        for (const Vec2 p : axis) box.take(p);
      for (const Vec2 p : frame.points) box.take(p);
      if (frame.axes.empty())
        for (const BodyPlace& body : frame.bodies) box.take(body.at.position);
    }
  return box;
}

Screen fit(const Box& box) {
  const Vec2 size = box.high - box.low;
  const double tall = size.y > 0.0 ? most_high / size.y : most_wide;
  const double wide = size.x > 0.0 ? most_wide / size.x : tall;
  return {std::min(wide, tall), {box.low.x, box.high.y}};
}

Clock make_clock(const Course& course, bool moving) {
  Clock clock;
  clock.seconds = course.seconds;
  double largest = -1.0;
  for (std::size_t k = 0; k < course.frames.size(); ++k) {
    const Frame& ghost = course.ghosts[std::min(k, course.ghosts.size() - 1)];
    const double moved = distance(course.frames[k], ghost);
    if (moved <= largest * (1.0 + 1e-9)) continue;
    largest = moved;
    clock.still = k;
  }
  if (!moving || course.frames.size() == 1) return clock;
  clock.order.resize(course.frames.size());
  std::iota(clock.order.begin(), clock.order.end(), std::size_t{0});
  if (course.returns)
    for (std::size_t k = course.frames.size() - 1; k-- > 0;) clock.order.push_back(k);
  return clock;
}

/// Where nothing moves only one frame is drawn.
void keep_still(Course& course, Clock& clock) {
  if (course.ghosts.size() > 1) course.ghosts = {course.ghosts[clock.still]};
  course.frames = {course.frames[clock.still]};
  clock.still = 0;
}

/// As many as keep the picture small.
std::size_t count_pieces(const Drawing& drawing, const Screen& screen, const Clock& clock) {
  std::size_t bytes = 1;
  for (const DrawnFlexure& flexure : drawing.flexures) bytes += bytes_of_piece(flexure, screen);
  if (clock.order.empty()) return still_pieces;
  const std::size_t shown = clock.order.size();
  return std::clamp(most_bytes / (bytes * shown), fewest_pieces, most_pieces);
}

std::string colour_key(double right, double y) {
  constexpr double wide = 90.0;
  std::string text = "<defs><linearGradient id=\"heat\">";
  for (int k = 0; k <= 4; ++k)
    text += fmt::format("<stop offset=\"{}%\" stop-color=\"{}\"/>", 25 * k, heat_colour(0.25 * k));
  text += "</linearGradient></defs>";
  text += fmt::format(
      "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:g}\" height=\"8\" fill=\"url(#heat)\"/>"
      "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">bending</text>\n",
      right - wide, y - 8.0, wide, right - wide - 6.0, y);
  return text;
}

std::string scale_bar(const Screen& screen, const std::string& unit, double left, double y) {
  const double length = round_factor(130.0 / screen.scale);
  const double pixels = length * screen.scale;
  return fmt::format(
      "<path class=\"bar\" d=\"M{0:.1f} {1:.1f}v5h{2:.1f}v-5\"/>"
      "<text x=\"{3:.1f}\" y=\"{4:.1f}\">{5:g} {6}</text>\n",
      left, y - 6.0, pixels, left + pixels + 7.0, y, length, escape_xml(unit));
}

std::string footer_layer(const Result& result, const Course& course, const Screen& screen,
                         const Box& box) {
  const double y = box.high.y - 10.0;
  std::string text = scale_bar(screen, result.length_unit, box.low.x + margin, y);
  if (!course.caption.empty())
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                        0.5 * (box.low.x + box.high.x), y, escape_xml(course.caption));
  if (!result.drawing.flexures.empty()) text += colour_key(box.high.x - margin, y);
  return text;
}

std::string draw(const Result& result, const StudyResult& study, Course course, bool moving) {
  Clock clock = make_clock(course, moving);
  const Screen screen = fit(box_of(course));
  if (clock.order.empty()) keep_still(course, clock);
  Box box;
  const Sheet sheet{
      result.drawing, course, clock, screen, count_pieces(result.drawing, screen, clock), &box};
  const std::string layers = ghost_layer(sheet) + ground_layer(sheet) + body_layer(sheet) +
                             flexure_layer(sheet) + spring_layer(sheet) + joint_layer(sheet) +
                             way_layer(sheet) + load_layer(sheet, study.loads);
  box.take(box.low, margin);
  box.take(box.high, margin);
  const double lacking = std::max(0.0, least_wide - (box.high.x - box.low.x));
  box.low.x -= 0.5 * lacking;
  box.high.x += 0.5 * lacking;
  box.high.y += footer - margin;
  const Vec2 size = box.high - box.low;
  const std::string title = escape_xml(result.title.empty() ? study.name : result.title);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{0:.1f} {1:.1f} {2:.1f} "
             "{3:.1f}\" "
             "width=\"{2:.0f}\" height=\"{3:.0f}\" role=\"img\" aria-label=\"{4}\">\n"
             "<title>{4}</title>\n<style>{5}</style>\n"
             "<rect class=\"paper\" x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" "
             "height=\"{3:.1f}\" rx=\"8\"/>\n",
             box.low.x, box.low.y, size.x, size.y, title, style) +
         layers + footer_layer(result, course, screen, box) + "</svg>\n";
}

/// The labels of a study's modelings, and that of its reference.
struct Labels {
  std::vector<std::string> all;
  std::string reference;
};

Labels labels_of(const StudyResult& study) {
  Labels labels;
  std::visit(
      [&labels](const auto& content) {
        if constexpr (requires { content.modelings; }) {
          for (const auto& modeling : content.modelings) labels.all.push_back(modeling.label);
          if (content.reference < labels.all.size())
            labels.reference = labels.all[content.reference];
        }
      },
      study.content);
  return labels;
}

}  // namespace
}  // namespace pictures

bool can_be_drawn(const std::string& study_kind) {
  return study_kind != "linear" && study_kind != "response";
}

Picture make_picture(const Result& result, const PictureRequest& request) {
  const auto study = std::ranges::find(result.studies, request.study, &StudyResult::name);
  if (study == result.studies.end())
    return {{}, fmt::format("the result has no study '{}'", request.study)};
  if (!can_be_drawn(study->kind))
    return {{},
            fmt::format("study '{}' is of kind {}, which has no shape to draw", study->name,
                        study->kind)};
  const pictures::Labels labels = pictures::labels_of(*study);
  pictures::CourseRequest course;
  course.modeling = request.modeling.empty() ? labels.reference : request.modeling;
  course.exaggeration = request.exaggeration;
  course.mode = request.mode - 1;
  // A linkage that stopped at once has no methods; its drawing is shown.
  if (std::ranges::find(labels.all, course.modeling) == labels.all.end() && !labels.all.empty())
    return {{},
            fmt::format("study '{}' has no modeling '{}'{}", study->name, course.modeling,
                        suggestion(course.modeling, labels.all))};
  if (const auto* modes = std::get_if<ModeResult>(&study->content)) {
    const auto modeling =
        std::ranges::find(modes->modelings, course.modeling, &ModelingModes::label);
    const std::size_t count = modeling == modes->modelings.end() ? 0 : modeling->modes.size();
    if (request.mode == 0 || (request.mode > count && request.mode > 1))
      return {
          {},
          fmt::format("study '{}' has no mode {}; it found {}", study->name, request.mode, count)};
  }
  return {
      pictures::draw(result, *study, pictures::make_course(result, *study, course), request.moving),
      {}};
}

}  // namespace flexura

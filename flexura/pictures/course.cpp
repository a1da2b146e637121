#include "flexura/pictures/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace flexura::pictures {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t path_frames = 16;  // one way; they come closer where the motion turns
constexpr std::size_t mode_frames = 10;
constexpr std::size_t motion_frames = 90;
constexpr std::size_t most_way = 400;

template <class Modelings>
const auto& modeling_of(const Modelings& modelings, const std::string& label) {
  return *std::ranges::find_if(modelings, [&](const auto& m) { return m.label == label; });
}

/// A state of a path or a motion as a frame; by the modeling `linear` bodies move to first order.
template <class Names>
Frame frame_of(const Drawing& drawing, const Names& names, const PathState& state, bool linear) {
  Frame frame = drawn_frame(drawing);
  frame.axes = state.axes;
  for (std::size_t b = 0; b < names.bodies.size(); ++b) {
    const std::size_t body = find_body(drawing, names.bodies[b]);
    const Vec2 centre = drawing.bodies[body].centre;
    const Pose& pose = state.bodies[b];
    if (linear) {
      frame.bodies[body].further = {pose.position - centre, pose.rotation};
    } else {
      frame.bodies[body].at = pose;
    }
  }
  frame.points = state.points;
  frame.share = state.load_factor;
  frame.reactions = state.reactions;
  frame.reactions.resize(names.held.size());
  return frame;
}

/// Positions from 0 to `end`, slow where the motion turns back.
std::vector<double> there(double end, std::size_t count) {
  std::vector<double> positions;
  for (std::size_t k = 0; k <= count; ++k)
    positions.push_back(0.5 * end *
                        (1.0 - std::cos(pi * static_cast<double>(k) / static_cast<double>(count))));
  return positions;
}

std::vector<double> evenly(double begin, double end, std::size_t count) {
  std::vector<double> positions;
  for (std::size_t k = 0; k <= count; ++k)
    positions.push_back(begin +
                        (end - begin) * static_cast<double>(k) / static_cast<double>(count));
  return positions;
}

/// What moves too little to be seen is drawn several times as far.
void exaggerate(Course& course, const Drawing& drawing, const CourseRequest& request,
                const std::string& what) {
  const Frame from = course.ghosts.front();
  double largest = 0.0;
  for (const Frame& frame : course.frames) largest = std::max(largest, distance(frame, from));
  const double share = largest / extent(drawing);
  double factor = 1.0;
  if (share > 0.0 && share < 0.025) factor = round_factor(0.06 / share);
  if (request.exaggeration) factor = *request.exaggeration;
  if (factor == 1.0) return;
  for (auto* frames : {&course.frames, &course.way})
    for (Frame& frame : *frames) frame = exaggerated(frame, from, factor);
  course.caption = factor_words(what, factor);
}

Frame start_of(const Drawing& drawing, const std::vector<std::string>& points,
               std::size_t reactions) {
  Frame frame = drawn_frame(drawing);
  for (const std::string& name : points) {
    for (const DrawnBody& body : drawing.bodies) {
      for (std::size_t p = 0; p < body.points.size(); ++p)
        if (name == body.name + "." + body.point_names[p]) frame.points.push_back(body.points[p]);
    }
  }
  frame.reactions.resize(reactions);
  return frame;
}

Course path_course(const Result& result, const PathResult& path, const CourseRequest& request) {
  const ModelingPath& modeling = modeling_of(path.modelings, request.modeling);
  Course course;
  course.points = path.points;
  course.held = path.held;
  course.returns = true;
  course.ghosts = {start_of(result.drawing, path.points, path.held.size())};
  std::vector<Frame> states;
  std::vector<double> factors;
  for (const PathState& state : modeling.states) {
    states.push_back(frame_of(result.drawing, path, state, modeling.modeling == "linear"));
    factors.push_back(state.load_factor);
  }
  if (states.empty()) states = course.ghosts;
  match_axes(states);
  course.ghosts = {states.front()};
  // Over the load factor, or over the states where that turns back.
  const bool grows =
      factors.size() == states.size() && std::ranges::is_sorted(factors, std::less_equal<>());
  std::vector<double> times =
      grows ? factors : evenly(0.0, static_cast<double>(states.size() - 1), states.size() - 1);
  if (times.size() != states.size()) times = {0.0};
  course.frames =
      states.size() == 1 ? states : resample(states, times, there(times.back(), path_frames));
  course.way = states.size() == 1
                   ? states
                   : resample(states, times, evenly(0.0, times.back(), most_way / 4));
  exaggerate(course, result.drawing, request, "displacements");
  return course;
}

Course motion_course(const Result& result, const MotionResult& motion,
                     const CourseRequest& request) {
  const ModelingMotion& modeling = modeling_of(motion.modelings, request.modeling);
  Course course;
  course.points = motion.points;
  course.held = motion.held;
  course.seconds = 6.0;
  course.ghosts = {start_of(result.drawing, motion.points, motion.held.size())};
  std::vector<Frame> states;
  std::vector<double> times;
  for (const MotionState& state : modeling.states) {
    states.push_back(frame_of(result.drawing, motion, state.state, modeling.modeling == "linear"));
    states.back().share = 1.0;
    states.back().time = state.time;
    times.push_back(state.time);
  }
  if (!states.empty()) {  // the start need not be the mechanism as drawn
    states.insert(states.begin(), course.ghosts.front());
    match_axes(states);
    states.erase(states.begin());
  }
  course.frames = course.ghosts;
  if (states.size() == 1) course.frames = states;
  if (states.size() > 1) {
    const std::size_t count = std::min(motion_frames, states.size() - 1);
    course.frames = resample(states, times, evenly(times.front(), times.back(), count));
    course.way = resample(states, times, evenly(times.front(), times.back(), most_way));
  }
  exaggerate(course, result.drawing, request, "displacements");
  return course;
}

Frame swung(const Drawing& drawing, const ModeResult& names, const Mode& mode, double amplitude) {
  Frame frame = drawn_frame(drawing);
  frame.share = 1.0;
  frame.axes = mode.axes;
  for (std::size_t f = 0; f < frame.axes.size(); ++f)
    for (std::size_t k = 0; k < frame.axes[f].size(); ++k)
      frame.axes[f][k] = frame.axes[f][k] + amplitude * mode.shape.axes[f][k];
  for (std::size_t b = 0; b < names.bodies.size(); ++b) {
    const Pose& by = mode.shape.bodies[b];
    frame.bodies[find_body(drawing, names.bodies[b])] = {
        mode.bodies[b], {amplitude * by.position, amplitude * by.rotation}};
  }
  return frame;
}

std::string mode_words(const Result& result, const StudyResult& study, std::size_t number,
                       const Mode& mode) {
  if (study.kind == "buckling")
    return fmt::format("mode {}, load factor {:.4g}", number + 1, mode.value);
  const std::string unit = result.time_unit == "s" ? "Hz" : "1/" + result.time_unit;
  if (mode.value < 0.0) return fmt::format("mode {}, unstable", number + 1);
  return fmt::format("mode {}, {:.4g} {}", number + 1, mode.value / (2.0 * pi), unit);
}

Course mode_course(const Result& result, const StudyResult& study, const ModeResult& modes,
                   const CourseRequest& request) {
  const ModelingModes& modeling = modeling_of(modes.modelings, request.modeling);
  Course course;
  course.returns = true;
  course.seconds = 2.0;
  if (modeling.modes.empty()) {
    course.frames = course.ghosts = {drawn_frame(result.drawing)};
    course.caption = "no mode";
    return course;
  }
  const Mode& mode = modeling.modes[request.mode];
  course.ghosts = {swung(result.drawing, modes, mode, 0.0)};
  const double amplitude = request.exaggeration.value_or(0.08 * extent(result.drawing));
  for (std::size_t k = 0; k <= mode_frames; ++k) {
    const double phase = pi * static_cast<double>(k) / mode_frames;
    course.frames.push_back(swung(result.drawing, modes, mode, -amplitude * std::cos(phase)));
  }
  course.caption = mode_words(result, study, request.mode, mode);
  return course;
}

std::vector<std::size_t> find_shafts(const Drawing& drawing, const std::vector<Frame>& frames) {
  std::vector<std::size_t> shafts;
  for (std::size_t b = 0; b < drawing.bodies.size(); ++b) {
    const Pose& start = frames.front().bodies[b].at;
    bool turns = false;
    bool stays = true;
    for (const Frame& frame : frames) {
      const Pose& now = frame.bodies[b].at;
      stays = stays && norm(now.position - start.position) < 1e-6 * extent(drawing);
      turns = turns || now.rotation != start.rotation;
    }
    if (turns && stays) shafts.push_back(b);
  }
  return shafts;
}

}  // namespace

double extent(const Drawing& drawing) {
  std::optional<Vec2> low;
  Vec2 high;
  const auto take = [&](Vec2 p) {
    if (!low) low = high = p;
    low = Vec2{std::min(low->x, p.x), std::min(low->y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  };
  for (const DrawnFlexure& flexure : drawing.flexures) std::ranges::for_each(flexure.axis, take);
  for (const DrawnBody& body : drawing.bodies) {
    std::ranges::for_each(body.points, take);
    if (drawing.flexures.empty()) take(body.centre);
  }
  const double side = low ? std::max(high.x - low->x, high.y - low->y) : 0.0;
  return side > 0.0 ? side : 1.0;
}

double round_factor(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= 1.0001 * value) return step * power;
  return power;
}

std::string factor_words(const std::string& what, double factor) {
  return factor == 1.0 ? std::string() : fmt::format("{} ×{:g}", what, factor);
}

Course make_course(const Result& result, const StudyResult& study, const CourseRequest& request) {
  Course course;
  if (const auto* path = std::get_if<PathResult>(&study.content)) {
    course = path_course(result, *path, request);
  } else if (const auto* modes = std::get_if<ModeResult>(&study.content)) {
    course = mode_course(result, study, *modes, request);
  } else if (const auto* motion = std::get_if<MotionResult>(&study.content)) {
    course = motion_course(result, *motion, request);
  } else {
    course = make_linkage_course(result, std::get<LinkageResult>(study.content), request);
  }
  course.shafts = find_shafts(result.drawing, course.frames);
  return course;
}

}  // namespace flexura::pictures

#include <algorithm>
#include <cmath>

#include "flexura/pictures/course.hpp"

namespace flexura::pictures {
namespace {

constexpr std::size_t turn_frames = 48;

/// A frame of the line between the ends of an axis: places along it as shares, across as lengths.
struct Chord {
  Vec2 start;
  Vec2 along;
  double length = 0.0;

  explicit Chord(const std::vector<Vec2>& axis) : start(axis.front()) {
    const Vec2 span = axis.back() - axis.front();
    length = norm(span);
    along = (1.0 / length) * span;
  }
};

/// The border of a link of any shape goes with its chord: every point keeps its place along and
/// across it.
std::vector<Vec2> border_on(const std::vector<Vec2>& border, const std::vector<Vec2>& drawn,
                            const std::vector<Vec2>& now) {
  const Chord from(drawn);
  const Chord to(now);
  const double last = static_cast<double>(now.size()) - 1.0;
  std::vector<Vec2> moved;
  for (const Vec2 p : border) {
    const double share = dot(p - from.start, from.along) / from.length;
    const double across = cross(from.along, p - from.start);
    const double at = std::clamp(share, 0.0, 1.0) * last;
    const auto k = static_cast<std::size_t>(std::min(std::floor(at), last - 1.0));
    const Vec2 on = now[k] + (at - static_cast<double>(k)) * (now[k + 1] - now[k]);
    const double beyond = (share - at / last) * to.length;
    moved.push_back(on + beyond * to.along + across * perp(to.along));
  }
  return moved;
}

/// What the elastic motion adds to a position, `factor` times; nothing where the method stopped.
class Turn {
 public:
  Turn(const Drawing& drawing, const LinkageResult& linkage, const LinkageMotion& motion)
      : drawing_(drawing), linkage_(linkage), motion_(motion) {}

  bool moves() const { return motion_.displacements.size() == linkage_.positions.size(); }

  double largest_deflection() const {
    double largest = 0.0;
    for (const auto& position : motion_.displacements)
      for (const auto& axis : position)
        for (const Vec2 d : axis) largest = std::max(largest, norm(d));
    return largest;
  }

  Frame at(std::size_t k, double factor) const {
    const RigidPosition& position = linkage_.positions[k];
    Frame frame = drawn_frame(drawing_);
    frame.share = 1.0;
    frame.time = std::abs(position.angle);
    const bool moved = factor != 0.0 && moves();
    const auto by = [&](const auto& table, std::size_t i) {
      return moved && k < table.size() ? factor * table[k][i] : Vec2{};
    };
    for (std::size_t f = 0; f < frame.axes.size(); ++f) {
      std::vector<Vec2> axis = position.flexures[f];
      for (std::size_t i = 0; moved && i < axis.size(); ++i)
        axis[i] = axis[i] + factor * motion_.displacements[k][f][i];
      frame.axes[f] = drawing_.flexures[f].depth > 0.0
                          ? axis
                          : border_on(frame.axes[f], linkage_.positions.front().flexures[f], axis);
    }
    for (std::size_t b = 0; b < linkage_.bodies.size(); ++b)
      frame.bodies[find_body(drawing_, linkage_.bodies[b])] = {position.bodies[b],
                                                               {by(motion_.bodies, b), 0.0}};
    for (std::size_t p = 0; p < position.points.size(); ++p)
      frame.points.push_back(position.points[p] + by(motion_.points, p));
    return frame;
  }

 private:
  const Drawing& drawing_;
  const LinkageResult& linkage_;
  const LinkageMotion& motion_;
};

}  // namespace

Course make_linkage_course(const Result& result, const LinkageResult& linkage,
                           const CourseRequest& request) {
  Course course;
  course.points = linkage.points;
  course.seconds = 3.0;
  const auto motion = std::ranges::find(linkage.modelings, request.modeling, &LinkageMotion::label);
  if (linkage.positions.empty() || motion == linkage.modelings.end()) {
    course.frames = course.ghosts = {drawn_frame(result.drawing)};
    course.points.clear();
    return course;
  }
  const Turn turn(result.drawing, linkage, *motion);
  const double share = turn.largest_deflection() / extent(result.drawing);
  const double factor =
      request.exaggeration.value_or(share > 0.0 && share < 0.05 ? round_factor(0.05 / share) : 1.0);
  const std::size_t last = linkage.positions.size() - 1;
  const std::size_t count = std::max<std::size_t>(1, std::min(turn_frames, last));
  for (std::size_t n = 0; n <= count; ++n) {
    course.frames.push_back(turn.at(n * last / count, factor));
    course.ghosts.push_back(turn.at(n * last / count, 0.0));
  }
  for (std::size_t k = 0; k <= last; ++k) course.way.push_back(turn.at(k, factor));
  if (turn.moves()) course.caption = factor_words("deflections", factor);
  return course;
}

}  // namespace flexura::pictures

#include "flexura/pictures/frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace flexura::pictures {
namespace {

Pose sum(const Pose& a, double k, const Pose& b) {
  return {a.position + k * b.position, a.rotation + k * b.rotation};
}

Pose difference(const Pose& a, const Pose& b) { return sum(a, -1.0, b); }

/// Adds k times what `frame` has moved since `from`.
void add(Frame& to, double k, const Frame& frame, const Frame& from) {
  for (std::size_t f = 0; f < to.axes.size(); ++f) {
    const std::vector<Vec2>& axis = frame.axes[f];
    const std::vector<Vec2>& start = from.axes[f];
    for (std::size_t p = 0; p < axis.size(); ++p)
      to.axes[f][p] = to.axes[f][p] + k * (axis[p] - start[p]);
  }
  for (std::size_t b = 0; b < to.bodies.size(); ++b) {
    BodyPlace& body = to.bodies[b];
    body.at = sum(body.at, k, difference(frame.bodies[b].at, from.bodies[b].at));
    body.further =
        sum(body.further, k, difference(frame.bodies[b].further, from.bodies[b].further));
  }
  for (std::size_t p = 0; p < to.points.size(); ++p)
    to.points[p] = to.points[p] + k * (frame.points[p] - from.points[p]);
  to.share += k * (frame.share - from.share);
  to.time += k * (frame.time - from.time);
  for (std::size_t r = 0; r < to.reactions.size(); ++r) {
    const Reaction& end = frame.reactions[r];
    const Reaction& start = from.reactions[r];
    to.reactions[r].force = to.reactions[r].force + k * (end.force - start.force);
    to.reactions[r].moment += k * (end.moment - start.moment);
  }
}

/// Weights by which a quadratic through up to three frames gives its slope at frame j.
std::vector<Weight> slope_weights(const std::vector<double>& times, std::size_t j) {
  const std::size_t last = times.size() - 1;
  const std::size_t first = j == 0 || last < 2 ? 0 : std::min(j - 1, last - 2);
  std::vector<Weight> weights;
  for (std::size_t k = first; k <= std::min(first + 2, last); ++k) {
    double scale = 1.0;
    double slope = 0.0;
    std::size_t others = 0;
    for (std::size_t i = first; i <= std::min(first + 2, last); ++i) {
      if (i == k) continue;
      scale *= times[k] - times[i];
      slope += times[j] - times[i];
      ++others;
    }
    weights.push_back({k, (others == 1 ? 1.0 : slope) / scale});
  }
  return weights;
}

/// Weights of the cubic between frames i and i + 1, at t from 0 to 1 between them.
std::vector<Weight> cubic_weights(const std::vector<double>& times, std::size_t i, double t) {
  std::map<std::size_t, double> weights;
  const double step = times[i + 1] - times[i];
  weights[i] += (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
  weights[i + 1] += t * t * (3.0 - 2.0 * t);
  for (const Weight& w : slope_weights(times, i))
    weights[w.frame] += w.value * step * t * (1.0 - t) * (1.0 - t);
  for (const Weight& w : slope_weights(times, i + 1))
    weights[w.frame] += w.value * step * t * t * (t - 1.0);
  std::vector<Weight> list;
  list.reserve(weights.size());
  for (const auto& [frame, value] : weights) list.push_back({frame, value});
  return list;
}

}  // namespace

Frame drawn_frame(const Drawing& drawing) {
  Frame frame;
  for (const DrawnFlexure& flexure : drawing.flexures) frame.axes.push_back(flexure.axis);
  for (const DrawnBody& body : drawing.bodies) frame.bodies.push_back({{body.centre, 0.0}, {}});
  return frame;
}

Vec2 carried(const Drawing& drawing, const Frame& frame, std::size_t body, Vec2 place) {
  const auto& [at, further] = frame.bodies[body];
  const Vec2 arm = rotate(at.rotation, place - drawing.bodies[body].centre);
  return at.position + further.position + arm + further.rotation * perp(arm);
}

std::size_t find_body(const Drawing& drawing, const std::string& name) {
  const auto found = std::ranges::find(drawing.bodies, name, &DrawnBody::name);
  return static_cast<std::size_t>(found - drawing.bodies.begin());
}

Frame blend(const std::vector<Frame>& frames, const std::vector<Weight>& weights) {
  const Weight heaviest =
      *std::ranges::max_element(weights, {}, [](const Weight& w) { return std::abs(w.value); });
  // From the heaviest frame on, so that what does not move stays where it is to the last digit.
  const Frame& from = frames[heaviest.frame];
  Frame blended = from;
  for (const Weight& w : weights) add(blended, w.value, frames[w.frame], from);
  return blended;
}

void match_axes(std::vector<Frame>& frames) {
  for (Frame& frame : frames) {
    for (std::size_t f = 0; f < frame.axes.size(); ++f) {
      const std::vector<Vec2> from = frame.axes[f];
      std::vector<Vec2>& axis = frame.axes[f];
      axis.resize(frames.front().axes[f].size());
      if (axis.size() == from.size() || from.empty()) continue;
      for (std::size_t k = 0; k < axis.size(); ++k) {
        const double at = static_cast<double>(k * (from.size() - 1)) /
                          static_cast<double>(std::max<std::size_t>(1, axis.size() - 1));
        const auto before = std::min(static_cast<std::size_t>(at), from.size() - 1);
        const std::size_t after = std::min(before + 1, from.size() - 1);
        axis[k] = from[before] + (at - static_cast<double>(before)) * (from[after] - from[before]);
      }
    }
  }
}

Frame exaggerated(const Frame& frame, const Frame& from, double factor) {
  Frame result = from;
  add(result, factor, frame, from);
  result.share = frame.share;
  result.time = frame.time;
  result.reactions = frame.reactions;
  return result;
}

double distance(const Frame& a, const Frame& b) {
  double largest = 0.0;
  for (std::size_t f = 0; f < a.axes.size(); ++f)
    for (std::size_t k = 0; k < std::min(a.axes[f].size(), b.axes[f].size()); ++k)
      largest = std::max(largest, norm(a.axes[f][k] - b.axes[f][k]));
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const auto place = [i](const Frame& f) {
      return f.bodies[i].at.position + f.bodies[i].further.position;
    };
    largest = std::max(largest, norm(place(a) - place(b)));
  }
  for (std::size_t p = 0; p < std::min(a.points.size(), b.points.size()); ++p)
    largest = std::max(largest, norm(a.points[p] - b.points[p]));
  return largest;
}

std::vector<Frame> resample(const std::vector<Frame>& frames, const std::vector<double>& times,
                            const std::vector<double>& positions) {
  std::vector<Frame> result;
  for (const double position : positions) {
    const auto after = std::ranges::upper_bound(times, position);
    const auto next = static_cast<std::size_t>(after - times.begin());
    if (next == 0 || next == times.size()) {
      result.push_back(next == 0 ? frames.front() : frames.back());
      continue;
    }
    const double t = (position - times[next - 1]) / (times[next] - times[next - 1]);
    result.push_back(blend(frames, cubic_weights(times, next - 1, t)));
  }
  return result;
}

}  // namespace flexura::pictures

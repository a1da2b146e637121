#include "flexura/studies/mode_shape.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/studies/path_record.hpp"

namespace flexura {
namespace {

double largest(const ModeShape& shape) {
  double size = 0.0;
  for (const Pose& body : shape.bodies) size = std::max(size, norm(body.position));
  for (const Vec2 point : shape.points) size = std::max(size, norm(point));
  for (const auto& axis : shape.axes)
    for (const Vec2 place : axis) size = std::max(size, norm(place));
  return size;
}

/// Half the difference of two states, over `step`.
ModeShape rate_between(const PathState& behind, const PathState& ahead, double step) {
  const double factor = 0.5 / step;
  const auto poses = [&](const std::vector<Pose>& a, const std::vector<Pose>& b) {
    std::vector<Pose> rate;
    for (std::size_t i = 0; i < a.size(); ++i)
      rate.push_back(
          {factor * (b[i].position - a[i].position), factor * (b[i].rotation - a[i].rotation)});
    return rate;
  };
  const auto places = [&](const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    std::vector<Vec2> rate;
    for (std::size_t i = 0; i < a.size(); ++i) rate.push_back(factor * (b[i] - a[i]));
    return rate;
  };
  ModeShape shape{poses(behind.bodies, ahead.bodies),
                  places(behind.points, ahead.points),
                  poses(behind.mids, ahead.mids),
                  {}};
  for (std::size_t k = 0; k < behind.axes.size(); ++k)
    shape.axes.push_back(places(behind.axes[k], ahead.axes[k]));
  return shape;
}

void scale(ModeShape& shape, double factor) {
  const auto scale_poses = [&](std::vector<Pose>& poses) {
    for (Pose& pose : poses) pose = {factor * pose.position, factor * pose.rotation};
  };
  scale_poses(shape.bodies);
  scale_poses(shape.mids);
  for (Vec2& point : shape.points) point = factor * point;
  for (auto& axis : shape.axes)
    for (Vec2& place : axis) place = factor * place;
}

}  // namespace

Mode make_mode(const std::function<PathState(double)>& moved, double step, double value) {
  Mode mode;
  mode.value = value;
  mode.shape = rate_between(moved(-step), moved(step), step);
  const double most = largest(mode.shape);
  if (most > 0.0) scale(mode.shape, 1.0 / most);
  const PathState state = moved(0.0);
  mode.bodies = state.bodies;
  mode.axes = state.axes;
  return mode;
}

Mode make_mode(const Model& model, const System& system, const std::vector<double>& z,
               const std::vector<double>& direction, double value) {
  // the direction of a flexure that buckles alone moves no body: sized by all unknowns
  double size = std::sqrt(system.inner(direction, direction));
  for (std::size_t i = system.first_internal(); i < direction.size(); ++i)
    size = std::max(size, std::abs(direction[i]));
  const auto moved = [&](double by) {
    std::vector<double> at = z;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += by * direction[i];
    return make_path_state(model, system, at, 0.0);
  };
  return make_mode(moved, 1e-5 / size, value);
}

Mode make_mode(const Model& model, const MotionSystem& system, const Moment& moment,
               const Eigen::VectorXd& direction, double value) {
  const auto moved = [&](double by) {
    Moment at = moment;
    at.q += by * direction;
    return make_path_state(model, MovingState(system, at), 0.0);
  };
  return make_mode(moved, 1e-5 / system.size_of(direction), value);
}

}  // namespace flexura

#include "tests/report/sample_chain.hpp"

#include <Eigen/Dense>
#include <numbers>

namespace flexura::sample {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double bending_stiffness = 0.175;  // N mm2
constexpr int axis_points = 49;

struct Arc {
  const char* name;
  Vec2 centre;
  double radius, start, sweep;

  Vec2 at(double fraction) const { return centre + radius * unit(start + fraction * sweep); }
};

constexpr std::size_t arc_count = 3;
constexpr Arc arcs[arc_count] = {
    {"e12", {0.0, 3.0}, 3.0, -pi / 2, -4 * pi / 3},
    {"e23", {9.093, 8.25}, 3.5, -5 * pi / 6, 5 * pi / 6},
    {"e34", {12.593, 15.75}, 2.5, -pi / 2, -3 * pi / 2},
};
const char* const bodies[] = {"ground", "link2", "link3", "link4"};

Drawing make_drawing(Vec2 tip) {
  Drawing drawing;
  for (std::size_t i = 0; i <= arc_count; ++i) {
    DrawnBody body{bodies[i], i == 0, {}, {}, {}, {}};
    if (i > 0) body.ends.push_back(arcs[i - 1].at(1.0));
    if (i < arc_count) body.ends.push_back(arcs[i].at(0.0));
    body.centre = body.ends.front();
    drawing.bodies.push_back(body);
  }
  drawing.bodies.back().point_names = {"E"};
  drawing.bodies.back().points = {tip};
  for (std::size_t i = 0; i < arc_count; ++i) {
    DrawnFlexure flexure{arcs[i].name, bodies[i], bodies[i + 1], false, false, {}, 0.1};
    for (int k = 0; k < axis_points; ++k) flexure.axis.push_back(arcs[i].at(k / 48.0));
    drawing.flexures.push_back(flexure);
  }
  return drawing;
}

/// The rigid motion left behind after some joints have turned: x -> origin + R(angle) x.
struct Motion {
  Vec2 origin;
  double angle = 0.0;
  bool small = false;

  Vec2 operator()(Vec2 x) const {
    return small ? x + origin + angle * perp(x) : origin + rotate(angle, x);
  }
  void turn_about(Vec2 joint, double rotation) {
    const Vec2 centre = (*this)(joint);
    if (small) {
      origin = origin - rotation * perp(joint);
    } else {
      origin = centre + rotate(rotation, origin - centre);
    }
    angle += rotation;
  }
};

/// The motions of the ground and of what follows each joint.
std::vector<Motion> motions_of(const Chain& chain, const std::vector<double>& rotations,
                               bool small) {
  std::vector<Motion> motions{{{}, 0.0, small}};
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    motions.push_back(motions.back());
    motions.back().turn_about(chain.joints[j].at, rotations[j]);
  }
  return motions;
}

}  // namespace

Chain make_chain(std::size_t joints_per_flexure, double stiffness_factor) {
  Chain chain;
  chain.tip = {19.093, 15.75};
  chain.joints_per_flexure = joints_per_flexure;
  chain.drawing = make_drawing(chain.tip);
  const auto n = static_cast<double>(joints_per_flexure);
  for (std::size_t i = 0; i < arc_count; ++i) {
    const double length = arcs[i].radius * std::abs(arcs[i].sweep);
    for (std::size_t k = 0; k < joints_per_flexure; ++k) {
      chain.joints.push_back({arcs[i].at((static_cast<double>(k) + 0.5) / n),
                              length / n / (bending_stiffness * stiffness_factor), i});
    }
  }
  return chain;
}

std::vector<double> solve_chain(const Chain& chain, const TipLoad& load,
                                std::vector<double> start) {
  const auto n = static_cast<Eigen::Index>(chain.joints.size());
  for (int iteration = 0; iteration < 50; ++iteration) {
    const std::vector<Motion> motions = motions_of(chain, start, false);
    const Vec2 tip = motions.back()(chain.tip);
    Eigen::VectorXd residual(n);
    Eigen::MatrixXd tangent(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec2 arm = tip - motions[k](chain.joints[k].at);
      residual[i] = start[k] / chain.joints[k].compliance - cross(arm, load.force) - load.moment;
      const double geometric = dot(arm, load.force);
      for (Eigen::Index j = 0; j <= i; ++j) tangent(i, j) = tangent(j, i) = geometric;
      tangent(i, i) += 1.0 / chain.joints[k].compliance;
    }
    const Eigen::VectorXd step = tangent.ldlt().solve(residual);
    for (Eigen::Index i = 0; i < n; ++i) start[static_cast<std::size_t>(i)] -= step[i];
    if (step.norm() < 1e-12) break;
  }
  return start;
}

std::vector<double> solve_linear(const Chain& chain, const TipLoad& load) {
  std::vector<double> rotations;
  for (const Joint& joint : chain.joints) {
    const double moment = cross(chain.tip - joint.at, load.force) + load.moment;
    rotations.push_back(joint.compliance * moment);
  }
  return rotations;
}

PathState make_state(const Chain& chain, const std::vector<double>& rotations, double load_factor,
                     bool small) {
  const std::vector<Motion> motions = motions_of(chain, rotations, small);
  const std::size_t n = chain.joints_per_flexure;
  PathState state;
  state.load_factor = load_factor;
  for (std::size_t b = 1; b <= arc_count; ++b) {
    const Motion& motion = motions[b * n];
    state.bodies.push_back({motion(chain.drawing.bodies[b].centre), motion.angle});
  }
  state.points.push_back(motions.back()(chain.tip));
  for (std::size_t i = 0; i < arc_count; ++i) {
    const std::vector<Vec2>& axis = chain.drawing.flexures[i].axis;
    std::vector<Vec2> drawn{motions[i * n](axis.front())};
    for (std::size_t k = 0; k < n; ++k)
      drawn.push_back(motions[i * n + k](chain.joints[i * n + k].at));
    drawn.push_back(motions[(i + 1) * n](axis.back()));
    const Motion& middle = motions[i * n + (n + 1) / 2];
    state.mids.push_back({middle(axis[axis.size() / 2]), middle.angle});
    state.axes.push_back(drawn);
  }
  return state;
}

std::vector<std::vector<MemberStation>> make_members(const PathState& state, const TipLoad& load) {
  std::vector<std::vector<MemberStation>> members(arc_count);
  for (std::size_t i = 0; i < arc_count; ++i) {
    const std::vector<Vec2>& axis = state.axes[i];
    double s = 0.0;
    for (std::size_t k = 0; k < axis.size(); ++k) {
      const Vec2 ahead = k + 1 < axis.size() ? axis[k + 1] - axis[k] : axis[k] - axis[k - 1];
      if (k > 0) s += norm(axis[k] - axis[k - 1]);
      const Vec2 tangent = (1.0 / norm(ahead)) * ahead;
      const double moment = cross(state.points[0] - axis[k], load.force) + load.moment;
      const double axial = dot(load.force, tangent);
      members[i].push_back({s,
                            {axis[k], 0.0},
                            axial,
                            dot(load.force, perp(tangent)),
                            moment,
                            std::abs(moment) * 600.0 + std::abs(axial) * 10.0});
    }
  }
  return members;
}

}  // namespace flexura::sample

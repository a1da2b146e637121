#include "flexura/assembly/rigid_linkage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexura {
namespace {

constexpr double longest_step = 2.0 * std::numbers::pi / 180.0;
constexpr double shortest_step = 1e-7;
constexpr double closed = 1e-13;       // gap, as a share of the size
constexpr double same_rank = 1e-9;     // of singular values
constexpr double change_point = 1e-6;  // likewise: closer to one, digits of the motion are lost
constexpr double near_change_point = 1e-2;  // where steps end for good
constexpr double largest_change = 0.2;      // of a prediction by Newton's method: a part of a step

Vec2 arm(const RigidLinkageLayout& layout, const RigidState& state, std::size_t part, Vec2 at) {
  return rotate(state.parts[part].turn, at - layout.parts[part].centre);
}

}  // namespace

RigidLinkage::RigidLinkage(RigidLinkageLayout layout) : layout_(std::move(layout)) {
  for (std::size_t p = 0; p < layout_.parts.size(); ++p) {
    const bool held = p == 0 || p == layout_.driven;
    first_.push_back(held ? -1 : unknowns_);
    if (!held) unknowns_ += layout_.parts[p].turns ? 3 : 2;
  }
  rows_ = static_cast<int>(2 * layout_.pins.size() + 2 * layout_.slides.size());
}

PartMotion RigidLinkage::point(const RigidState& state, std::size_t part, Vec2 drawn) const {
  PartMotion motion = state.parts[part];
  const Vec2 r = arm(layout_, state, part, drawn);
  motion.displacement = layout_.parts[part].centre + motion.displacement + r;
  motion.first = motion.first + motion.first_turn * perp(r);
  motion.second =
      motion.second + motion.second_turn * perp(r) - (motion.first_turn * motion.first_turn) * r;
  return motion;
}

Eigen::VectorXd RigidLinkage::gaps(const RigidState& state) const {
  Eigen::VectorXd g(rows_);
  int row = 0;
  for (const auto& pin : layout_.pins) {
    const Vec2 gap = point(state, pin.first, pin.at).displacement -
                     point(state, pin.second, pin.at).displacement;
    g[row++] = gap.x / layout_.size;
    g[row++] = gap.y / layout_.size;
  }
  for (const auto& slide : layout_.slides) {
    const Vec2 apart = point(state, slide.action, slide.at).displacement -
                       point(state, slide.base, slide.at).displacement;
    const Vec2 normal = rotate(state.parts[slide.base].turn, perp(slide.direction));
    g[row++] = dot(apart, normal) / layout_.size;
    g[row++] = state.parts[slide.action].turn - state.parts[slide.base].turn;
  }
  return g;
}

/// Displacements count in sizes of the linkage.
Eigen::MatrixXd RigidLinkage::jacobian(const RigidState& state) const {
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows_, unknowns_ + 1);  // last: by the driven turn
  const double size = layout_.size;
  int row = 0;
  const auto turn_column = [&](std::size_t part) {
    if (part == layout_.driven) return unknowns_;
    return first_[part] < 0 || !layout_.parts[part].turns ? -1 : first_[part] + 2;
  };
  const auto add = [&](std::size_t part, Vec2 at, double sign, Vec2 along) {
    if (first_[part] >= 0) {
      j(row, first_[part]) += sign * along.x;
      j(row, first_[part] + 1) += sign * along.y;
    }
    if (const int turn = turn_column(part); turn >= 0)
      j(row, turn) += sign * dot(perp(arm(layout_, state, part, at)), along) / size;
  };
  for (const auto& pin : layout_.pins)
    for (const Vec2 along : {Vec2{1, 0}, Vec2{0, 1}}) {
      add(pin.first, pin.at, 1.0, along);
      add(pin.second, pin.at, -1.0, along);
      ++row;
    }
  for (const auto& slide : layout_.slides) {
    const Vec2 apart = point(state, slide.action, slide.at).displacement -
                       point(state, slide.base, slide.at).displacement;
    const Vec2 normal = rotate(state.parts[slide.base].turn, perp(slide.direction));
    add(slide.action, slide.at, 1.0, normal);
    add(slide.base, slide.at, -1.0, normal);
    if (const int turn = turn_column(slide.base); turn >= 0)
      j(row, turn) += dot(apart, perp(normal)) / size;
    ++row;
    if (const int turn = turn_column(slide.action); turn >= 0) j(row, turn) += 1.0;
    if (const int turn = turn_column(slide.base); turn >= 0) j(row, turn) -= 1.0;
    ++row;
  }
  return j;
}

Eigen::VectorXd RigidLinkage::centripetal(const RigidState& state) const {
  Eigen::VectorXd c(rows_);
  int row = 0;
  const auto inward = [&](std::size_t part, Vec2 at) {
    const double spin = state.parts[part].first_turn;
    return -(spin * spin) * arm(layout_, state, part, at);
  };
  for (const auto& pin : layout_.pins) {
    const Vec2 gap = inward(pin.first, pin.at) - inward(pin.second, pin.at);
    c[row++] = gap.x / layout_.size;
    c[row++] = gap.y / layout_.size;
  }
  for (const auto& slide : layout_.slides) {
    const PartMotion action = point(state, slide.action, slide.at);
    const PartMotion base = point(state, slide.base, slide.at);
    const double spin = state.parts[slide.base].first_turn;
    const Vec2 normal = rotate(state.parts[slide.base].turn, perp(slide.direction));
    const Vec2 apart = action.displacement - base.displacement;
    const Vec2 parting = action.first - base.first;
    const Vec2 pull = inward(slide.action, slide.at) - inward(slide.base, slide.at);
    c[row++] = (dot(pull, normal) + 2.0 * spin * dot(parting, perp(normal)) -
                spin * spin * dot(apart, normal)) /
               layout_.size;
    c[row++] = 0.0;
  }
  return c;
}

template <class Use>
void RigidLinkage::for_unknowns(RigidState& state, const Use& use) const {
  for (std::size_t p = 0; p < state.parts.size(); ++p)
    if (first_[p] >= 0) use(state.parts[p], first_[p], layout_.parts[p].turns);
}

/// Newton's method; constraints that depend on one another are kept in the least-squares sense and
/// must close all the same.
bool RigidLinkage::close(RigidState& state) const {
  if (unknowns_ == 0) return true;
  double change = 0.0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::VectorXd g = gaps(state);
    if (g.lpNorm<Eigen::Infinity>() <= closed) return true;
    // a gap of a few roundings does not get smaller
    if (iteration > 3 && change < 1e-12) return g.lpNorm<Eigen::Infinity>() < 1e2 * closed;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(same_rank);
    solver.compute(jacobian(state).leftCols(unknowns_));
    const Eigen::VectorXd step = -solver.solve(g);
    change = step.lpNorm<Eigen::Infinity>();
    if (!step.allFinite() || change > largest_change) return false;
    for_unknowns(state, [&](PartMotion& part, int first, bool turns) {
      part.displacement = part.displacement + layout_.size * Vec2{step[first], step[first + 1]};
      if (turns) part.turn += step[first + 2];
    });
  }
  return gaps(state).lpNorm<Eigen::Infinity>() < 1e2 * closed;
}

bool RigidLinkage::differentiate(RigidState& state) const {
  state.freedom = 1.0;
  if (unknowns_ == 0) return true;
  const Eigen::MatrixXd j = jacobian(state);
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(j.leftCols(unknowns_),
                                        Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(change_point);
  const Eigen::VectorXd values = svd.singularValues();
  state.freedom = values.size() < unknowns_ ? 0.0 : values[unknowns_ - 1] / values[0];
  if (svd.rank() < unknowns_) return false;
  const Eigen::VectorXd v = svd.solve(-j.col(unknowns_));
  if ((j.leftCols(unknowns_) * v + j.col(unknowns_)).lpNorm<Eigen::Infinity>() > 1e-6) return false;
  for_unknowns(state, [&](PartMotion& part, int first, bool turns) {
    part.first = layout_.size * Vec2{v[first], v[first + 1]};
    if (turns) part.first_turn = v[first + 2];
  });
  const Eigen::VectorXd a = svd.solve(-centripetal(state));
  for_unknowns(state, [&](PartMotion& part, int first, bool turns) {
    part.second = layout_.size * Vec2{a[first], a[first + 1]};
    if (turns) part.second_turn = a[first + 2];
  });
  return true;
}

std::optional<RigidState> RigidLinkage::drawn() const {
  RigidState state;
  state.parts.resize(layout_.parts.size());
  state.parts[layout_.driven].first_turn = 1.0;
  if (!close(state) || !differentiate(state)) return {};
  return state;
}

std::optional<RigidState> RigidLinkage::follow(RigidState state, double angle,
                                               RigidFailure& failure) const {
  double step = longest_step;
  while (state.angle != angle) {
    const double left = angle - state.angle;
    const double h = std::copysign(std::min(std::abs(left), step), left);
    RigidState next = state;
    next.angle = std::abs(left) <= step ? angle : state.angle + h;
    next.parts[layout_.driven].turn = next.angle;
    for_unknowns(next, [&](PartMotion& part, int, bool turns) {
      part.displacement = part.displacement + h * part.first + (0.5 * h * h) * part.second;
      if (turns) part.turn += h * part.first_turn + 0.5 * h * h * part.second_turn;
    });
    if (close(next) && differentiate(next)) {
      state = std::move(next);
      step = std::min(longest_step, 2.0 * step);
      continue;
    }
    step *= 0.5;
    if (step < shortest_step) {
      const bool in_line = state.freedom < near_change_point;
      failure = {state.angle,
                 in_line ? RigidFailure::Kind::change_point : RigidFailure::Kind::open};
      return {};
    }
  }
  return state;
}

std::vector<RigidState> RigidLinkage::trace(const std::vector<double>& angles,
                                            std::optional<RigidFailure>& failure) const {
  std::vector<RigidState> states;
  std::optional<RigidState> state = drawn();
  if (!state) {
    failure = RigidFailure{0.0, RigidFailure::Kind::ungoverned};
    return states;
  }
  for (const double angle : angles) {
    RigidFailure why;
    state = follow(std::move(*state), angle, why);
    if (!state) {
      failure = why;
      return states;
    }
    states.push_back(*state);
  }
  return states;
}

}  // namespace flexura

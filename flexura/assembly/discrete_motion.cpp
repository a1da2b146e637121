#include "flexura/assembly/discrete_motion.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

Vec2 multiply(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
/// conj(a) b: b in axes turned (and scaled) by a.
Vec2 multiply_back(Vec2 a, Vec2 b) { return {a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x}; }

}  // namespace

DiscreteMotion::DiscreteMotion(MotionSystem& system) : system_(system) {
  for (std::size_t k = 0; k < system_.member_count(); ++k) {
    first_point_.push_back(inertias_.size());
    const MotionPort& port = system_.port(k);
    for (const MassPoint& point : port.points()) inertias_.push_back(point.inertia);
    Ends ends{sized_work(port), sized_work(port), sized_work(port), {}, {}, {}, {}, {}, {}};
    ends.y_middle.resize(port.internal_size());
    ends.change.resize(port.internal_size());
    ends.residual.resize(port.internal_size());
    ends_.push_back(std::move(ends));
  }
  first_point_.push_back(inertias_.size());
  for (const auto& body : system_.layout().mechanism.bodies) {
    inertias_.push_back(body.mass);
    inertias_.push_back(body.inertia);
  }
}

void DiscreteMotion::place(const Eigen::VectorXd& q, std::vector<Vec2>& places) {
  places.resize(inertias_.size());
  for (std::size_t k = 0; k < system_.member_count(); ++k) {
    const MotionPort& port = system_.port(k);
    Ends& ends = ends_[k];
    const double* y = system_.internal(k, q);
    port.evaluate(Eigen::Vector3d::Zero(), y, y, y, ends.to);  // rates are not asked for
    const Pose base = system_.base_section(k, q);
    Vec2* out = places.data() + first_point_[k];
    for (std::size_t g = 0; g < port.points().size(); ++g) {
      const Vec2 turned = rotate(base.rotation, ends.to.places[g]);
      out[g] = port.points()[g].direction ? turned : base.position + turned;
    }
  }
  Vec2* out = places.data() + first_point_.back();
  for (std::size_t b = 0; b < system_.layout().mechanism.bodies.size(); ++b) {
    const Pose pose = system_.pose(b, q);
    *out++ = pose.position;
    *out++ = unit(pose.rotation);
  }
}

void DiscreteMotion::velocities(const Moment& moment, std::vector<Vec2>& velocities) {
  velocities.resize(inertias_.size());
  Eigen::VectorXd r;
  system_.residual(moment, r);
  for (std::size_t k = 0; k < system_.member_count(); ++k)
    system_.member_velocities(k, moment, velocities.data() + first_point_[k]);
  Vec2* out = velocities.data() + first_point_.back();
  const auto& bodies = system_.numbering().bodies;
  for (const Numbering::Body& index : bodies) {
    const double spin = index.rotation >= 0 ? moment.v[index.rotation] : 0.0;
    const double turn = index.rotation >= 0 ? moment.q[index.rotation] : 0.0;
    *out++ =
        index.position >= 0 ? Vec2{moment.v[index.position], moment.v[index.position + 1]} : Vec2{};
    *out++ = spin * perp(unit(turn));
  }
}

auto DiscreteMotion::momenta(const std::vector<Vec2>& places,
                             const std::vector<Vec2>& velocities) const -> Momenta {
  Momenta sum;
  const auto add = [&](std::size_t g, bool direction) {
    const Vec2 momentum = inertias_[g] * velocities[g];
    sum.kinetic += 0.5 * dot(momentum, velocities[g]);
    sum.angular += cross(places[g], momentum);
    if (!direction) sum.linear = sum.linear + momentum;
  };
  for (std::size_t k = 0; k < system_.member_count(); ++k)
    for (std::size_t g = 0; g < system_.port(k).points().size(); ++g)
      add(first_point_[k] + g, system_.port(k).points()[g].direction);
  for (std::size_t g = first_point_.back(); g < inertias_.size(); ++g)
    add(g, (g - first_point_.back()) % 2 == 1);
  return sum;
}

auto DiscreteMotion::turn_of(int unknown, const Moment& from, const Moment& to) const -> Turn {
  Turn turn;
  if (unknown >= 0) {
    turn.from = from.q[unknown];
    turn.to = to.q[unknown];
  }
  const double change = turn.to - turn.from;
  turn.tangent = 2.0 * std::tan(0.5 * change);
  turn.ratio = change != 0.0 ? change / turn.tangent : 1.0;
  turn.mean = 0.5 * (unit(turn.from) + unit(turn.to));
  return turn;
}

void DiscreteMotion::push(std::size_t body, Vec2 arm, Vec2 force, const Moment& from,
                          const Moment& to, Eigen::VectorXd& r) const {
  const Numbering::Body& index = system_.numbering().bodies[body];
  if (index.position < 0) return;
  r[index.position] += force.x;
  r[index.position + 1] += force.y;
  if (index.rotation < 0) return;
  const Turn turn = turn_of(index.rotation, from, to);
  r[index.rotation] += dot(force, perp(multiply(turn.mean, arm)));
}

void DiscreteMotion::residual(const Moment& from, const Moment& to, const std::vector<Vec2>& change,
                              Eigen::VectorXd& r) {
  const double h = to.time - from.time;
  r.setZero(system_.size());
  work_ = dissipated_ = 0.0;
  for (std::size_t k = 0; k < system_.member_count(); ++k)
    add_member(k, from, to, h, change.data() + first_point_[k], r);
  add_bodies(from, to, h, change.data() + first_point_.back(), r);
  add_springs(from, to, h, r);
  add_loads(from, to, r);
  add_prescribed(from, to, r);
  add_joints(from, to, r);
  const Eigen::Index n = system_.coordinates();
  for (const ModalForce& mode : system_.modal_damping()) {
    const double rate = mode.momentum.dot(to.q - from.q) / h;
    r.head(n) += mode.damping * rate * mode.momentum;
    dissipated_ += mode.damping * rate * rate * h;
  }
}

void DiscreteMotion::add_member(std::size_t member, const Moment& from, const Moment& to, double h,
                                const Vec2* change, Eigen::VectorXd& r) {
  const auto& m = system_.layout().mechanism.members[member];
  const auto& unknowns = system_.numbering().members[member].unknowns;
  Frame frame;
  frame.start_from = system_.base_section(member, from.q).position;
  frame.start_to = system_.base_section(member, to.q).position;
  frame.turn = turn_of(unknowns[PortUnknown::base_section], from, to);
  frame.body = turn_of(system_.numbering().bodies[m.base].rotation, from, to);

  Ends& ends = ends_[member];
  const MotionPort& port = system_.port(member);
  const double* y0 = system_.internal(member, from.q);
  const double* y1 = system_.internal(member, to.q);
  for (std::size_t i = 0; i < ends.change.size(); ++i) {
    ends.change[i] = y1[i] - y0[i];
    ends.y_middle[i] = 0.5 * (y0[i] + y1[i]);
  }
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  // rates are not asked for: any numbers do
  ends.answer_from = port.evaluate(none, y0, y0, y0, ends.from);
  ends.answer_middle = port.evaluate(none, ends.y_middle.data(), y0, y0, ends.middle);
  ends.answer_to = port.evaluate(none, y1, y0, y0, ends.to);
  port.linearize(none, ends.y_middle.data(), nullptr, ends.middle);
  // the energy's discrete derivative
  double squared = 0.0, predicted = 0.0;
  for (std::size_t i = 0; i < ends.change.size(); ++i) {
    ends.residual[i] = ends.middle.columns[4 * i];
    squared += ends.change[i] * ends.change[i];
    predicted += ends.residual[i] * ends.change[i];
  }
  if (squared > 0.0) {
    const double lack = (ends.answer_to.energy - ends.answer_from.energy - predicted) / squared;
    for (std::size_t i = 0; i < ends.change.size(); ++i) ends.residual[i] += lack * ends.change[i];
  }
  const double stiffness = system_.layout().stiffness_damping;
  if (stiffness > 0.0) {
    std::vector<double> rate(ends.change.size());
    multiply_symmetric(ends.middle.tangent.data(), port.layout(), ends.change.data(), rate.data());
    for (std::size_t i = 0; i < rate.size(); ++i) {
      ends.residual[i] += stiffness / h * rate[i];
      dissipated_ += stiffness / h * rate[i] * ends.change[i];
    }
  }
  add_places(member, frame, from, to, h, change, r);
  add_closure(member, frame, from, to, r);
  double* out = r.data() + (y0 - from.q.data());
  for (std::size_t i = 0; i < ends.residual.size(); ++i) out[i] += ends.residual[i];
}

/// Inertia, gravity and dead forces of the mass points, by the discrete derivatives of their
/// places.
void DiscreteMotion::add_places(std::size_t member, const Frame& frame, const Moment& from,
                                const Moment& to, double h, const Vec2* change,
                                Eigen::VectorXd& r) {
  Ends& ends = ends_[member];
  const auto& m = system_.layout().mechanism.members[member];
  const auto& points = system_.port(member).points();
  const Vec2 e0 = unit(frame.turn.from), e1 = unit(frame.turn.to);
  const double stretch = 1.0 + 0.25 * frame.turn.tangent * frame.turn.tangent;
  const double damping = system_.layout().mass_damping;
  Vec2 sum;
  double torque = 0.0;
  const Vec2* slope = ends.middle.slopes.data();
  for (std::size_t g = 0; g < points.size(); slope += points[g].count, ++g) {
    const MassPoint& point = points[g];
    const Vec2 before = multiply(e0, ends.from.places[g]);
    const Vec2 after = multiply(e1, ends.to.places[g]);
    Vec2 force = (point.inertia / h) * change[g];
    if (!point.direction) force = force - point.inertia * system_.layout().gravity - point.force;
    if (damping > 0.0) {
      Vec2 moved = after - before;
      if (!point.direction) moved = moved + frame.start_to - frame.start_from;
      force = force + (damping * point.inertia / h) * moved;
      dissipated_ += damping * point.inertia / h * dot(moved, moved);
    }
    if (!point.direction) sum = sum + force;
    torque += dot(force, perp(0.5 * (before + after)));
    const Vec2 seen = stretch * multiply_back(frame.turn.mean, force);
    double squared = 0.0;
    Vec2 lack = ends.to.places[g] - ends.from.places[g];
    for (std::size_t j = 0; j < point.count; ++j) {
      const double d = ends.change[point.first + j];
      squared += d * d;
      lack = lack - d * slope[j];
    }
    const double correction = squared > 0.0 ? dot(seen, lack) / squared : 0.0;
    for (std::size_t j = 0; j < point.count; ++j)
      ends.residual[point.first + j] +=
          dot(seen, slope[j]) + correction * ends.change[point.first + j];
  }
  push(m.base, m.arms.base, sum, from, to, r);
  const int own = system_.numbering().members[member].unknowns[PortUnknown::base_section];
  if (own >= 0) r[own] += torque;
}

/// Forces that hold the tip on its action body, and the closure at the end of the step.
void DiscreteMotion::add_closure(std::size_t member, const Frame& frame, const Moment& from,
                                 const Moment& to, Eigen::VectorXd& r) {
  Ends& ends = ends_[member];
  const auto& m = system_.layout().mechanism.members[member];
  const auto& unknowns = system_.numbering().members[member].unknowns;
  const Eigen::Vector3d load = system_.member_load(member, to.multipliers);
  const Vec2 force = rotate(0.5 * (frame.turn.from + frame.turn.to), {load[0], load[1]});
  const double moment = load[2];
  const auto tip = [](const MotionPort::Answer& a) { return Vec2{a.tip[0], a.tip[1]}; };
  const Vec2 before = tip(ends.answer_from), after = tip(ends.answer_to);

  push(m.action, m.arms.action + m.misfit, force, from, to, r);
  push(m.base, m.arms.base, -force, from, to, r);
  const int own_action = unknowns[action_section];
  const Turn action = turn_of(own_action, from, to);
  const Vec2 tip_arm = rotate(m.misfit_rotation, m.arms.tip);
  if (own_action >= 0) r[own_action] += dot(force, perp(multiply(action.mean, tip_arm))) + moment;
  const Vec2 mean_tip =
      0.5 * (multiply(unit(frame.turn.from), before) + multiply(unit(frame.turn.to), after));
  const int own_base = unknowns[PortUnknown::base_section];
  if (own_base >= 0) r[own_base] -= dot(force, perp(mean_tip)) + moment;

  // on y: the tip's discrete derivative, its angle by the tangent of half of it
  const double change = ends.answer_to.tip[2] - ends.answer_from.tip[2];
  const double tangent = 2.0 * std::tan(0.5 * change);
  const double square = 1.0 + 0.25 * frame.turn.tangent * frame.turn.tangent;
  const Vec2 seen = square * multiply_back(frame.turn.mean, force);
  const double twist = moment * square / (1.0 - 0.25 * frame.turn.tangent * tangent) *
                       (change != 0.0 ? tangent / change : 1.0);
  double squared = 0.0;
  Eigen::Vector3d lack = ends.answer_to.tip - ends.answer_from.tip;
  for (std::size_t i = 0; i < ends.change.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> minus(ends.middle.columns.data() + 4 * i + 1);
    squared += ends.change[i] * ends.change[i];
    lack += ends.change[i] * minus;
  }
  const Eigen::Vector3d all(seen.x, seen.y, twist);
  const double correction = squared > 0.0 ? all.dot(lack) / squared : 0.0;
  for (std::size_t i = 0; i < ends.change.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> minus(ends.middle.columns.data() + 4 * i + 1);
    ends.residual[i] += all.dot(minus) - correction * ends.change[i];
  }
  r.segment<3>(system_.coordinates() + system_.load_row(member)) =
      system_.relative_pose_at(member, to.q).value - ends.answer_to.tip;
}

}  // namespace flexura

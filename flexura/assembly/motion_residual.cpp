#include <cmath>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/spring_potential.hpp"

namespace flexura {

BaseMotion MotionSystem::base_motion(std::size_t member, const Moment& moment,
                                     Placed& placed) const {
  const auto& m = layout_.mechanism.members[member];
  const BodyMotion body = body_motion(m.base, moment);
  const int own = numbering_.members[member].unknowns[PortUnknown::base_section];
  BaseMotion base;
  if (own >= 0) {
    placed.turn = moment.q[own];
    base.spin = moment.v[own];
    base.spin_rate = moment.a[own];
  } else {
    placed.turn = 0.0;
  }
  base.turn = placed.turn;
  const bool small = linearised();
  placed.arm = small ? m.arms.base : rotate(body.pose.rotation, m.arms.base);
  Vec2 acceleration = body.acceleration + body.spin_rate * perp(placed.arm) - layout_.gravity;
  if (!small) acceleration = acceleration - body.spin * body.spin * placed.arm;
  const Vec2 velocity = body.velocity + body.spin * perp(placed.arm);
  base.velocity = small ? velocity : rotate(-placed.turn, velocity);
  base.acceleration = small ? acceleration : rotate(-placed.turn, acceleration);
  return base;
}

MemberForces MotionSystem::evaluate_member(std::size_t member, const Moment& moment) {
  const BaseMotion base = base_motion(member, moment, placed_[member]);
  const Eigen::Index first = internal_[member];
  return members_[member].evaluate(member_load(member, moment.multipliers), moment.q.data() + first,
                                   moment.v.data() + first, moment.a.data() + first, base,
                                   layout_.mass_damping, layout_.stiffness_damping);
}

void MotionSystem::member_velocities(std::size_t member, const Moment& moment,
                                     Vec2* velocities) const {
  Placed placed;
  const BaseMotion base = base_motion(member, moment, placed);
  const MemberWork& work = members_[member].work();
  const auto& points = port(member).points();
  for (std::size_t g = 0; g < points.size(); ++g) {
    Vec2 velocity = base.spin * perp(work.places[g]) + work.rates[g];
    if (!points[g].direction) velocity = velocity + base.velocity;
    velocities[g] = rotate(placed.turn, velocity);
  }
}

void MotionSystem::add_member(std::size_t member, const Moment& moment, Eigen::VectorXd& r) {
  const MemberForces forces = evaluate_member(member, moment);
  Placed& placed = placed_[member];
  const Eigen::Vector3d load = member_load(member, moment.multipliers);
  placed.relative = relative_pose_of(member, moment.q, load);
  placed.force = linearised() ? forces.force : rotate(placed.turn, forces.force);
  placed.torque = forces.torque;
  const auto& inner = members_[member].residual();
  for (std::size_t i = 0; i < inner.size(); ++i)
    r[internal_[member] + static_cast<Eigen::Index>(i)] += inner[i];
  r.segment<3>(coordinates_ + load_row(member)) = placed.relative.value - forces.tip;

  Eigen::Matrix<double, port_unknowns, 1> outer = placed.relative.jacobian.transpose() * load;
  outer[base_x] += placed.force.x;
  outer[base_y] += placed.force.y;
  outer[base_turn] += cross(placed.arm, placed.force);
  outer[PortUnknown::base_section] += placed.torque;
  const auto& unknowns = numbering_.members[member].unknowns;
  for (int i = 0; i < port_unknowns; ++i)
    if (unknowns[i] >= 0) r[unknowns[i]] += outer[i];
}

void MotionSystem::add_body(std::size_t body, const Moment& moment, Eigen::VectorXd& r) const {
  const Numbering::Body& index = numbering_.bodies[body];
  const auto& rigid = layout_.mechanism.bodies[body];
  if (index.position < 0) return;
  const BodyMotion motion = body_motion(body, moment);
  const Vec2 force =
      rigid.mass * (motion.acceleration - layout_.gravity + layout_.mass_damping * motion.velocity);
  r[index.position] += force.x;
  r[index.position + 1] += force.y;
  if (index.rotation >= 0)
    r[index.rotation] += rigid.inertia * (motion.spin_rate + layout_.mass_damping * motion.spin);
}

void MotionSystem::add_springs(const Moment& moment, Eigen::VectorXd& r) const {
  const SystemLayout& mechanism = layout_.mechanism;
  for (const auto& spring : mechanism.springs) {
    const Pose a = pose(spring.base, moment.q);
    const Pose b = pose(spring.action, moment.q);
    Jet2<6> energy = spring_potential(mechanism, spring, a, b, 1.0);
    const auto unknowns = pair_unknowns(spring.base, spring.action);
    const double damping = layout_.damping_along(spring);
    if (damping > 0.0) {
      const Jet2<6> length = spring_length(mechanism, spring, a, b);
      double rate = 0.0;
      for (std::size_t i = 0; i < 6; ++i)
        if (unknowns[i] >= 0) rate += length.gradient[i] * moment.v[unknowns[i]];
      for (std::size_t i = 0; i < 6; ++i) energy.gradient[i] += damping * rate * length.gradient[i];
    }
    for (std::size_t i = 0; i < 6; ++i)
      if (unknowns[i] >= 0) r[unknowns[i]] += energy.gradient[i];
  }
}

void MotionSystem::add_loads(const Moment& moment, Eigen::VectorXd& r) const {
  const auto& loads = layout_.mechanism.loads;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto& load = loads[i];
    const Numbering::Body& index = numbering_.bodies[load.body];
    if (index.position < 0) continue;
    const double factor = evaluate_history(layout_.loads[i], moment.time).value;
    const double turn = linearised() ? 0.0 : pose(load.body, moment.q).rotation;
    const Vec2 arm = rotate(turn, load.arm);
    const Vec2 force = load.follower ? rotate(turn, load.force) : load.force;
    r[index.position] -= factor * force.x;
    r[index.position + 1] -= factor * force.y;
    if (index.rotation >= 0) r[index.rotation] -= factor * (cross(arm, force) + load.moment);
  }
}

auto MotionSystem::prescribed_place(std::size_t i, const Eigen::VectorXd& q) const
    -> PrescribedPlace {
  using Component = SystemLayout::Prescribed::Component;
  const auto& prescribed = layout_.mechanism.prescribed[i];
  const Numbering::Body& index = numbering_.bodies[prescribed.body];
  if (prescribed.component == Component::rotation)
    return {{index.rotation, -1}, {1.0, 0.0}, pose(prescribed.body, q).rotation, 0.0};
  const bool along_x = prescribed.component == Component::x;
  const Vec2 drawn = layout_.mechanism.bodies[prescribed.body].centre + prescribed.arm;
  const Vec2 moved = moved_point(prescribed.body, drawn, q) - drawn;
  const double turn = linearised() ? 0.0 : pose(prescribed.body, q).rotation;
  const Vec2 arm = rotate(turn, prescribed.arm);
  return {{index.position + (along_x ? 0 : 1), index.rotation},
          {1.0, along_x ? -arm.y : arm.x},
          along_x ? moved.x : moved.y,
          linearised() ? 0.0 : -(along_x ? arm.x : arm.y)};
}

void MotionSystem::add_prescribed(const Moment& moment, Eigen::VectorXd& r) const {
  for (std::size_t i = 0; i < prescribed_count(); ++i) {
    const PrescribedPlace place = prescribed_place(i, moment.q);
    const double target = layout_.mechanism.prescribed[i].value *
                          evaluate_history(layout_.prescribed[i], moment.time).value;
    const double reaction = prescribed_reaction(i, moment.multipliers);
    r[coordinates_ + static_cast<Eigen::Index>(i)] = target - place.displacement;
    for (int c = 0; c < 2; ++c)
      if (place.unknowns[c] >= 0) r[place.unknowns[c]] -= reaction * place.slopes[c];
  }
}

void MotionSystem::add_joints(const Moment& moment, Eigen::VectorXd& r) const {
  const auto& joints = layout_.mechanism.joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto gaps = gaps_of(i, moment.q);
    const auto unknowns = pair_unknowns(joints[i].base, joints[i].action);
    for (std::size_t c = 0; c < 2; ++c) {
      const Eigen::Index row = joint_row(i) + static_cast<Eigen::Index>(c);
      r[coordinates_ + row] = -gaps[c].value;
      for (std::size_t j = 0; j < 6; ++j)
        if (unknowns[j] >= 0) r[unknowns[j]] -= moment.multipliers[row] * gaps[c].gradient[j];
    }
  }
}

void MotionSystem::residual(const Moment& moment, Eigen::VectorXd& r) {
  r.setZero(size());
  for (std::size_t k = 0; k < members_.size(); ++k) add_member(k, moment, r);
  for (std::size_t b = 0; b < layout_.mechanism.bodies.size(); ++b) add_body(b, moment, r);
  add_springs(moment, r);
  add_loads(moment, r);
  add_prescribed(moment, r);
  add_joints(moment, r);
  for (const ModalForce& mode : modal_damping_)
    r.head(coordinates_) += mode.damping * mode.momentum.dot(moment.v) * mode.momentum;
}

}  // namespace flexura

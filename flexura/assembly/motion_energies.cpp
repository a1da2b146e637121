#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/spring_potential.hpp"

namespace flexura {

/// What gravity and dead forces along a flexure have done since the drawn state.
double MotionSystem::dead_work_on(std::size_t member, const Eigen::VectorXd& q) const {
  const MemberMotion& motion = members_[member];
  const auto& m = layout_.mechanism.members[member];
  const Vec2 start = layout_.mechanism.bodies[m.base].centre + m.arms.base;
  const Vec2 moved = moved_point(m.base, start, q) - start;
  const double turn = placed_[member].turn;
  double work = 0.0;
  const auto& points = motion.port().points();
  const std::vector<Vec2>& now = motion.work().places;
  const std::vector<Vec2>& drawn = motion.drawn_places();
  for (std::size_t g = 0; g < points.size(); ++g) {
    if (points[g].direction) continue;
    const Vec2 force = points[g].inertia * layout_.gravity + points[g].force;
    const Vec2 place = linearised() ? now[g] + turn * perp(drawn[g]) : rotate(turn, now[g]);
    work += dot(force, moved + place - drawn[g]);
  }
  return work;
}

MotionEnergies MotionSystem::energies(const Moment& moment) {
  MotionEnergies sum;
  const SystemLayout& mechanism = layout_.mechanism;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberForces forces = evaluate_member(k, moment);
    const Vec2 momentum = linearised() ? forces.momentum : rotate(placed_[k].turn, forces.momentum);
    sum.strain += forces.strain_energy;
    sum.kinetic += forces.kinetic_energy;
    sum.momentum = sum.momentum + momentum;
    sum.angular_momentum +=
        cross(base_section(k, moment.q).position, momentum) + forces.angular_momentum;
    sum.dead_work += dead_work_on(k, moment.q);
  }
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
    const auto& rigid = mechanism.bodies[b];
    const BodyMotion motion = body_motion(b, moment);
    if (numbering_.bodies[b].position < 0) continue;
    sum.kinetic += 0.5 * rigid.mass * dot(motion.velocity, motion.velocity) +
                   0.5 * rigid.inertia * motion.spin * motion.spin;
    sum.momentum = sum.momentum + rigid.mass * motion.velocity;
    sum.angular_momentum +=
        rigid.mass * cross(motion.pose.position, motion.velocity) + rigid.inertia * motion.spin;
    sum.dead_work += rigid.mass * dot(layout_.gravity, motion.pose.position - rigid.centre);
  }
  for (const auto& spring : mechanism.springs)
    sum.strain += spring_potential(mechanism, spring, pose(spring.base, moment.q),
                                   pose(spring.action, moment.q), 1.0)
                      .value;
  add_dead_loads(moment, sum);
  return sum;
}

void MotionSystem::add_dead_loads(const Moment& moment, MotionEnergies& sum) const {
  const SystemLayout& mechanism = layout_.mechanism;
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    const auto& load = mechanism.loads[i];
    if (!is_dead(load, layout_.loads[i])) continue;
    const Vec2 drawn = mechanism.bodies[load.body].centre + load.arm;
    sum.dead_work += dot(load.force, moved_point(load.body, drawn, moment.q) - drawn) +
                     load.moment * pose(load.body, moment.q).rotation;
  }
}

bool MotionSystem::has_power() const {
  const SystemLayout& mechanism = layout_.mechanism;
  bool any =
      layout_.mass_damping != 0.0 || layout_.stiffness_damping != 0.0 || !modal_damping_.empty();
  for (const auto& spring : mechanism.springs) any = any || spring.damping > 0.0;
  for (const auto& prescribed : mechanism.prescribed) any = any || prescribed.value != 0.0;
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i)
    any = any || !is_dead(mechanism.loads[i], layout_.loads[i]);
  return any;
}

MotionPower MotionSystem::power(const Moment& moment) {
  MotionPower power;
  const SystemLayout& mechanism = layout_.mechanism;
  if (layout_.mass_damping != 0.0 || layout_.stiffness_damping != 0.0) {
    power.damping = 2.0 * layout_.mass_damping * energies(moment).kinetic;
    for (std::size_t k = 0; k < members_.size(); ++k)
      power.damping += members_[k].elastic_damping_power(moment.v.data() + internal_[k],
                                                         layout_.stiffness_damping);
  }
  for (const ModalForce& mode : modal_damping_) {
    const double rate = mode.momentum.dot(moment.v);
    power.damping += mode.damping * rate * rate;
  }
  for (const auto& spring : mechanism.springs) {
    const double damping = layout_.damping_along(spring);
    if (damping == 0.0) continue;
    const Jet2<6> length = spring_length(mechanism, spring, pose(spring.base, moment.q),
                                         pose(spring.action, moment.q));
    const auto unknowns = pair_unknowns(spring.base, spring.action);
    double rate = 0.0;
    for (std::size_t i = 0; i < 6; ++i)
      if (unknowns[i] >= 0) rate += length.gradient[i] * moment.v[unknowns[i]];
    power.damping += damping * rate * rate;
  }
  add_load_power(moment, power);
  return power;
}

void MotionSystem::add_load_power(const Moment& moment, MotionPower& power) const {
  const SystemLayout& mechanism = layout_.mechanism;
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    const auto& load = mechanism.loads[i];
    if (is_dead(load, layout_.loads[i])) continue;
    const BodyMotion motion = body_motion(load.body, moment);
    const double turn = linearised() ? 0.0 : motion.pose.rotation;
    const Vec2 arm = rotate(turn, load.arm);
    const Vec2 force = load.follower ? rotate(turn, load.force) : load.force;
    power.loads +=
        evaluate_history(layout_.loads[i], moment.time).value *
        (dot(force, motion.velocity + motion.spin * perp(arm)) + load.moment * motion.spin);
  }
  for (std::size_t i = 0; i < prescribed_count(); ++i)
    power.loads += prescribed_reaction(i, moment.multipliers) * mechanism.prescribed[i].value *
                   evaluate_history(layout_.prescribed[i], moment.time).rate;
}

}  // namespace flexura

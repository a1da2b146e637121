#include <cmath>

#include "flexura/assembly/discrete_motion.hpp"

// What acts on bodies, over a step of a DiscreteMotion.

namespace flexura {
namespace {

Vec2 turned(Vec2 mean, Vec2 arm) {
  return {mean.x * arm.x - mean.y * arm.y, mean.x * arm.y + mean.y * arm.x};
}

}  // namespace

void DiscreteMotion::add_bodies(const Moment& from, const Moment& to, double h, const Vec2* change,
                                Eigen::VectorXd& r) {
  const auto& rigid = system_.layout().mechanism.bodies;
  const double damping = system_.layout().mass_damping;
  for (std::size_t b = 0; b < rigid.size(); ++b, change += 2) {
    const Numbering::Body& index = system_.numbering().bodies[b];
    if (index.position < 0) continue;
    const Vec2 moved = system_.pose(b, to.q).position - system_.pose(b, from.q).position;
    Vec2 force = (rigid[b].mass / h) * change[0] - rigid[b].mass * system_.layout().gravity;
    force = force + (damping * rigid[b].mass / h) * moved;
    dissipated_ += damping * rigid[b].mass / h * dot(moved, moved);
    r[index.position] += force.x;
    r[index.position + 1] += force.y;
    if (index.rotation < 0) continue;
    const Turn turn = turn_of(index.rotation, from, to);
    const Vec2 swung = unit(turn.to) - unit(turn.from);
    const Vec2 direction = (rigid[b].inertia / h) * (change[1] + damping * swung);
    dissipated_ += damping * rigid[b].inertia / h * dot(swung, swung);
    r[index.rotation] += dot(direction, perp(turn.mean));
  }
}

/// A spring of length l pulls along the mean of its vectors: the difference of l^2 is twice the
/// mean's product with their difference.
void DiscreteMotion::add_springs(const Moment& from, const Moment& to, double h,
                                 Eigen::VectorXd& r) {
  for (const auto& spring : system_.layout().mechanism.springs) {
    const double damping = system_.layout().damping_along(spring);
    const Numbering::Body& a = system_.numbering().bodies[spring.base];
    const Numbering::Body& b = system_.numbering().bodies[spring.action];
    if (spring.torsional) {
      const Turn base = turn_of(a.rotation, from, to);
      const Turn action = turn_of(b.rotation, from, to);
      const double change = action.to - action.from - base.to + base.from;
      const double mean = 0.5 * (action.from + action.to - base.from - base.to);
      const double moment = spring.stiffness * (mean - spring.free) + damping * change / h;
      dissipated_ += damping * change * change / h;
      if (b.rotation >= 0) r[b.rotation] += moment * action.ratio;
      if (a.rotation >= 0) r[a.rotation] -= moment * base.ratio;
      continue;
    }
    const auto& bodies = system_.layout().mechanism.bodies;
    const auto vector_at = [&](const Eigen::VectorXd& q) {
      return system_.moved_point(spring.action, bodies[spring.action].centre + spring.action_arm,
                                 q) -
             system_.moved_point(spring.base, bodies[spring.base].centre + spring.base_arm, q);
    };
    const Vec2 before = vector_at(from.q), after = vector_at(to.q);
    const double mean = 0.5 * (norm(before) + norm(after));
    const double rate = (norm(after) - norm(before)) / h;
    double pull = spring.stiffness;
    if (mean > 0.0) pull = (spring.stiffness * (mean - spring.free) + damping * rate) / mean;
    dissipated_ += damping * rate * rate * h;
    const Vec2 force = pull * 0.5 * (before + after);
    push(spring.action, spring.action_arm, force, from, to, r);
    push(spring.base, spring.base_arm, -force, from, to, r);
  }
}

void DiscreteMotion::add_loads(const Moment& from, const Moment& to, Eigen::VectorXd& r) {
  const auto& loads = system_.layout().mechanism.loads;
  const double middle = 0.5 * (from.time + to.time);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto& load = loads[i];
    const Numbering::Body& index = system_.numbering().bodies[load.body];
    if (index.position < 0) continue;
    const double factor = evaluate_history(system_.layout().loads[i], middle).value;
    const Turn turn = turn_of(index.rotation, from, to);
    const Vec2 force =
        factor * (load.follower ? rotate(0.5 * (turn.from + turn.to), load.force) : load.force);
    push(load.body, load.arm, -force, from, to, r);
    if (index.rotation >= 0) r[index.rotation] -= factor * load.moment * turn.ratio;
    if (is_dead(load, system_.layout().loads[i])) continue;
    const Vec2 drawn = system_.layout().mechanism.bodies[load.body].centre + load.arm;
    const Vec2 moved =
        system_.moved_point(load.body, drawn, to.q) - system_.moved_point(load.body, drawn, from.q);
    work_ += dot(force, moved) + factor * load.moment * (turn.to - turn.from);
  }
}

void DiscreteMotion::add_prescribed(const Moment& from, const Moment& to, Eigen::VectorXd& r) {
  using Component = SystemLayout::Prescribed::Component;
  const auto& all = system_.layout().mechanism.prescribed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& prescribed = all[i];
    const Numbering::Body& index = system_.numbering().bodies[prescribed.body];
    const auto row = static_cast<Eigen::Index>(i);
    const double reaction = to.multipliers[row];
    const auto target = [&](double time) {
      return prescribed.value * evaluate_history(system_.layout().prescribed[i], time).value;
    };
    work_ += reaction * (target(to.time) - target(from.time));
    if (prescribed.component == Component::rotation) {
      const Turn turn = turn_of(index.rotation, from, to);
      r[index.rotation] -= reaction * turn.ratio;
      r[system_.coordinates() + row] = target(to.time) - turn.to;
      continue;
    }
    const bool along_x = prescribed.component == Component::x;
    const Vec2 force = along_x ? Vec2{reaction, 0.0} : Vec2{0.0, reaction};
    push(prescribed.body, prescribed.arm, -force, from, to, r);
    const Vec2 drawn = system_.layout().mechanism.bodies[prescribed.body].centre + prescribed.arm;
    const Vec2 moved = system_.moved_point(prescribed.body, drawn, to.q) - drawn;
    r[system_.coordinates() + row] = target(to.time) - (along_x ? moved.x : moved.y);
  }
}

void DiscreteMotion::add_joints(const Moment& from, const Moment& to, Eigen::VectorXd& r) {
  const auto& joints = system_.layout().mechanism.joints;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& joint = joints[k];
    const Eigen::Index row = system_.joint_row(k);
    const Vec2 force{to.multipliers[row], to.multipliers[row + 1]};
    const auto gaps = joint_gaps(system_.layout().mechanism, joint, system_.pose(joint.base, to.q),
                                 system_.pose(joint.action, to.q));
    r[system_.coordinates() + row] = -gaps[0].value;
    r[system_.coordinates() + row + 1] = -gaps[1].value;
    if (joint.kind == SystemLayout::Joint::Kind::revolute) {
      push(joint.action, joint.action_arm, -force, from, to, r);
      push(joint.base, joint.base_arm, force, from, to, r);
      continue;
    }
    const Numbering::Body& a = system_.numbering().bodies[joint.base];
    const Numbering::Body& b = system_.numbering().bodies[joint.action];
    const Turn base = turn_of(a.rotation, from, to);
    const Turn action = turn_of(b.rotation, from, to);
    const Vec2 across = turned(base.mean, perp(joint.direction));
    const auto apart = [&](const Eigen::VectorXd& q) {
      return system_.pose(joint.action, q).position - system_.pose(joint.base, q).position;
    };
    push(joint.action, {}, -force.x * across, from, to, r);
    push(joint.base, {}, force.x * across, from, to, r);
    const Vec2 mean = 0.5 * (apart(from.q) + apart(to.q));
    if (a.rotation >= 0) r[a.rotation] -= force.x * dot(perp(across), mean) - force.y * base.ratio;
    if (b.rotation >= 0) r[b.rotation] -= force.y * action.ratio;
  }
}

}  // namespace flexura

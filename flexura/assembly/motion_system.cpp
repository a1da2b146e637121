#include "flexura/assembly/motion_system.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/assembly/mechanism_scale.hpp"

namespace flexura {

MotionSystem::MotionSystem(MotionLayout layout)
    : layout_(std::move(layout)), numbering_(layout_.mechanism) {
  const SystemLayout& mechanism = layout_.mechanism;
  moving_ = static_cast<Eigen::Index>(numbering_.moving);
  coordinates_ = moving_;
  for (std::size_t k = 0; k < mechanism.members.size(); ++k) {
    members_.emplace_back(layout_.ports[k], mechanism.linearised);
    internal_.push_back(coordinates_);
    coordinates_ += static_cast<Eigen::Index>(layout_.ports[k]->internal_size());
  }
  placed_.resize(members_.size());
  multipliers_ = load_row(members_.size());
  const Eigen::Index reduced = moving_ + multipliers_;
  stiffness_.setZero(reduced, reduced);
  damping_.setZero(reduced, reduced);
  mass_.setZero(moving_);
  set_scale();
  if (!mechanism.linearised) return;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(coordinates_);
  for (std::size_t k = 0; k < members_.size(); ++k)
    drawn_.push_back(relative_pose_of(k, rest, Eigen::Vector3d::Zero()));
}

/// As System does: displacements by the flexures' mean length, energies by that of bending one.
void MotionSystem::set_scale() {
  const SystemLayout& mechanism = layout_.mechanism;
  const MechanismScale scale = scale_of(mechanism);
  length_ = scale.length;
  const double turn = 1.0 / std::sqrt(scale.energy);
  scale_.setConstant(moving_ + multipliers_, turn);
  weights_.setOnes(coordinates_);
  gap_lengths_.setOnes(multipliers_);
  for (const auto& body : numbering_.bodies) {
    if (body.position < 0) continue;
    scale_.segment<2>(body.position).setConstant(length_ * turn);
    weights_.segment<2>(body.position).setConstant(1.0 / length_);
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const std::vector<double> own = port(k).weights();
    std::copy(own.begin(), own.end(), weights_.data() + internal_[k]);
  }
  for (std::size_t i = 0; i < prescribed_count(); ++i) {
    const bool turns =
        mechanism.prescribed[i].component == SystemLayout::Prescribed::Component::rotation;
    scale_[moving_ + static_cast<Eigen::Index>(i)] = 1.0 / (turns ? turn : length_ * turn);
    if (turns) gap_lengths_[static_cast<Eigen::Index>(i)] = length_;
  }
  for (std::size_t i = 0; i < mechanism.joints.size(); ++i) {
    const bool slides = mechanism.joints[i].kind == SystemLayout::Joint::Kind::prismatic;
    scale_[moving_ + joint_row(i)] = 1.0 / (length_ * turn);
    scale_[moving_ + joint_row(i) + 1] = 1.0 / (slides ? turn : length_ * turn);
    if (slides) gap_lengths_[joint_row(i) + 1] = length_;
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& member = mechanism.members[k];
    const double root = std::sqrt(member.bending_stiffness / member.length);
    scale_.segment<3>(moving_ + load_row(k)) << root / member.length, root / member.length, root;
    gap_lengths_[load_row(k) + 2] = length_;
  }
}

Moment MotionSystem::drawn_moment() const {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(coordinates_);
  return {0.0, zero, zero, zero, Eigen::VectorXd::Zero(multipliers_)};
}

Pose MotionSystem::pose(std::size_t body, const Eigen::VectorXd& q) const {
  const Numbering::Body& index = numbering_.bodies[body];
  Pose pose{layout_.mechanism.bodies[body].centre, 0.0};
  if (index.position >= 0)
    pose.position = pose.position + Vec2{q[index.position], q[index.position + 1]};
  if (index.rotation >= 0) pose.rotation = q[index.rotation];
  return pose;
}

Vec2 MotionSystem::moved_point(std::size_t body, Vec2 drawn, const Eigen::VectorXd& q) const {
  const Pose at = pose(body, q);
  const Vec2 arm = drawn - layout_.mechanism.bodies[body].centre;
  if (linearised()) return at.position + arm + at.rotation * perp(arm);
  return at.position + rotate(at.rotation, arm);
}

Pose MotionSystem::base_section(std::size_t member, const Eigen::VectorXd& q) const {
  const auto& m = layout_.mechanism.members[member];
  const int own = numbering_.members[member].unknowns[PortUnknown::base_section];
  return {moved_point(m.base, layout_.mechanism.bodies[m.base].centre + m.arms.base, q),
          own >= 0 ? q[own] : 0.0};
}

auto MotionSystem::body_motion(std::size_t body, const Moment& moment) const -> BodyMotion {
  const Numbering::Body& index = numbering_.bodies[body];
  BodyMotion motion;
  motion.pose = pose(body, moment.q);
  if (index.position >= 0) {
    motion.velocity = {moment.v[index.position], moment.v[index.position + 1]};
    motion.acceleration = {moment.a[index.position], moment.a[index.position + 1]};
  }
  if (index.rotation >= 0) {
    motion.spin = moment.v[index.rotation];
    motion.spin_rate = moment.a[index.rotation];
  }
  return motion;
}

RelativePose MotionSystem::relative_pose_of(std::size_t member, const Eigen::VectorXd& q,
                                            const Eigen::Vector3d& load) const {
  const auto& m = layout_.mechanism.members[member];
  const auto& bodies = layout_.mechanism.bodies;
  const auto& unknowns = numbering_.members[member].unknowns;
  // Positions count from the base body's drawn centre: differences of small numbers stay exact.
  const Vec2 apart = bodies[m.action].centre - bodies[m.base].centre;
  double at[port_unknowns];
  for (int i = 0; i < port_unknowns; ++i) at[i] = unknowns[i] >= 0 ? q[unknowns[i]] : 0.0;
  const bool as_drawn = linearised() && drawn_.size() <= member;  // what is linearised about
  if (!as_drawn) at[action_section] += m.misfit_rotation;
  if (!linearised() || as_drawn) {
    at[action_x] += apart.x;
    at[action_y] += apart.y;
    const Vec2 misfit = as_drawn ? Vec2{} : m.misfit;
    return relative_pose(at, {m.arms.base, m.arms.action + misfit, m.arms.tip}, load);
  }
  RelativePose pose = drawn_[member];
  pose.value += pose.jacobian * Eigen::Map<const Eigen::Matrix<double, port_unknowns, 1>>(at);
  pose.value.head<2>() += Eigen::Vector2d(m.misfit.x, m.misfit.y);
  return pose;
}

std::array<Jet2<6>, 2> MotionSystem::gaps_of(std::size_t joint, const Eigen::VectorXd& q) const {
  const SystemLayout& mechanism = layout_.mechanism;
  const SystemLayout::Joint& j = mechanism.joints[joint];
  const Pose a = pose(j.base, q);
  const Pose b = pose(j.action, q);
  return linearised() ? linearised_joint_gaps(mechanism, j, a, b) : joint_gaps(mechanism, j, a, b);
}

std::array<int, 6> MotionSystem::pair_unknowns(std::size_t base, std::size_t action) const {
  const Numbering::Body& a = numbering_.bodies[base];
  const Numbering::Body& b = numbering_.bodies[action];
  return {a.position, a.position < 0 ? -1 : a.position + 1, a.rotation,
          b.position, b.position < 0 ? -1 : b.position + 1, b.rotation};
}

double MotionSystem::size_of(const Eigen::Ref<const Eigen::VectorXd>& change) const {
  if (change.size() == 0) return 0.0;
  const double size = change.cwiseProduct(weights_).lpNorm<Eigen::Infinity>();
  return std::isfinite(size) ? size : INFINITY;
}

double MotionSystem::largest_gap(const Eigen::VectorXd& r) const {
  return multipliers_ == 0
             ? 0.0
             : r.tail(multipliers_).cwiseProduct(gap_lengths_).lpNorm<Eigen::Infinity>();
}

void MotionSystem::set_load_history(const TimeHistory& history) {
  for (TimeHistory& load : layout_.loads) load = history;
}

std::unique_ptr<MotionSystem> MotionSystem::refined() const {
  MotionLayout finer = layout_;
  bool any = false;
  for (auto& port : finer.ports)
    if (auto fine = port->refined()) {
      port = std::move(fine);
      any = true;
    }
  if (!any) return nullptr;
  return std::make_unique<MotionSystem>(std::move(finer));
}

Moment MotionSystem::prolong(const Moment& moment, const MotionSystem& refined) const {
  Moment out = refined.drawn_moment();
  out.time = moment.time;
  out.multipliers = moment.multipliers;
  const auto carry = [&](const Eigen::VectorXd& from, Eigen::VectorXd& to) {
    to.head(moving_) = from.head(moving_);
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const std::size_t coarse = port(k).internal_size();
      const std::size_t fine = refined.port(k).internal_size();
      port(k).prolong({from.data() + internal_[k], coarse},
                      {to.data() + refined.internal_[k], fine});
    }
  };
  carry(moment.q, out.q);
  // rates by a difference, exact where places are carried over linearly
  const double size = size_of(moment.v);
  if (size == 0.0) return out;
  const double span = 1e-4 / size;
  Eigen::VectorXd before = out.q, after = out.q;
  carry(moment.q - span * moment.v, before);
  carry(moment.q + span * moment.v, after);
  out.v = (after - before) / (2.0 * span);
  return out;
}

}  // namespace flexura

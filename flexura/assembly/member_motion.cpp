#include "flexura/assembly/member_motion.hpp"

#include <algorithm>

namespace flexura {

MemberMotion::MemberMotion(std::shared_ptr<const MotionPort> port, bool linearised)
    : port_(std::move(port)), linearised_(linearised), work_(sized_work(*port_)) {
  const std::size_t m = port_->internal_size();
  residual_.resize(m);
  elastic_rate_.assign(m, 0.0);
  mass_.resize(work_.tangent.size());
  forces_.resize(work_.places.size());
  stiffness_coupling_.setZero(static_cast<Eigen::Index>(m), outer);
  mass_coupling_.setZero(static_cast<Eigen::Index>(m), outer);
  const std::vector<double> rest(m, 0.0);
  port_->evaluate(Eigen::Vector3d::Zero(), rest.data(), rest.data(), rest.data(), work_);
  drawn_ = work_.places;
}

MemberForces MemberMotion::evaluate(const Eigen::Vector3d& load, const double* y, const double* v,
                                    const double* a, const BaseMotion& base, double mass_damping,
                                    double stiffness_damping) {
  MemberForces sum;
  const MotionPort::Answer answer = port_->evaluate(load, y, v, a, work_);
  sum.tip = answer.tip;
  sum.strain_energy = answer.energy;
  for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] = work_.columns[4 * i];
  if (stiffness_damping != 0.0) add_stiffness_damping(y, v, stiffness_damping);
  for (std::size_t g = 0; g < forces_.size(); ++g) move_point(g, base, mass_damping, sum);
  port_->add_forces(forces_.data(), work_, residual_.data());
  return sum;
}

void MemberMotion::move_point(std::size_t g, const BaseMotion& base, double mass_damping,
                              MemberForces& sum) {
  const MassPoint& point = port_->points()[g];
  const double spin = base.spin;
  const Vec2 rate = work_.rates[g];
  const Vec2 arm = linearised_ ? drawn_[g] : work_.places[g];
  Vec2 velocity = spin * perp(arm) + rate;
  Vec2 acceleration = base.spin_rate * perp(arm) + work_.seconds[g];
  if (!linearised_) acceleration = acceleration - spin * spin * arm + 2.0 * spin * perp(rate);
  if (!point.direction) {
    velocity = velocity + base.velocity;
    acceleration = acceleration + base.acceleration;
  }
  Vec2 force = point.inertia * (acceleration + mass_damping * velocity);
  if (point.force != Vec2{}) force = force - rotate(linearised_ ? 0.0 : -base.turn, point.force);
  forces_[g] = force;
  sum.torque += cross(arm, force);
  sum.kinetic_energy += 0.5 * point.inertia * dot(velocity, velocity);
  sum.angular_momentum += point.inertia * cross(work_.places[g], velocity);
  if (point.direction) return;
  sum.force = sum.force + force;
  sum.momentum = sum.momentum + point.inertia * velocity;
}

/// The elastic forces' rate is that of the energy's gradient along v.
void MemberMotion::add_stiffness_damping(const double* y, const double* v, double factor) {
  port_->linearize_energy(y, work_);
  multiply_symmetric(work_.tangent.data(), port_->layout(), v, elastic_rate_.data());
  for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] += factor * elastic_rate_[i];
}

double MemberMotion::elastic_damping_power(const double* v, double stiffness_damping) const {
  double power = 0.0;
  for (std::size_t i = 0; i < elastic_rate_.size(); ++i)
    power += stiffness_damping * elastic_rate_[i] * v[i];
  return power;
}

/// A point's force keeps its direction in the plane while the base section turns, hence the
/// geometric terms: seen from the base section it turns back.
void MemberMotion::linearize(const Eigen::Vector3d& load, const double* y, bool with_elastic) {
  const BandLayout layout = port_->layout();
  elastic_.clear();
  if (with_elastic) {
    port_->linearize_energy(y, work_);
    elastic_ = work_.tangent;
  }
  std::fill(mass_.begin(), mass_.end(), 0.0);
  stiffness_coupling_.setZero();
  mass_coupling_.setZero();
  outer_stiffness_.setZero();
  outer_mass_.setZero();
  for (std::size_t i = 0; i < layout.n; ++i)
    stiffness_coupling_.row(static_cast<Eigen::Index>(i)).head<3>() = minus_tip_slope(i);
  port_->linearize(load, y, linearised_ ? nullptr : forces_.data(), work_);

  const auto& points = port_->points();
  const Vec2* slope = work_.slopes.data();
  for (std::size_t g = 0; g < points.size(); slope += points[g].count, ++g) {
    const MassPoint& point = points[g];
    const Vec2 arm = linearised_ ? drawn_[g] : work_.places[g];
    const Vec2 turned = linearised_ ? Vec2{} : perp(forces_[g]);
    const Vec2 swept = point.inertia * perp(arm);
    for (std::size_t j = 0; j < point.count; ++j) {
      const std::size_t unknown = point.first + j;
      const auto row = static_cast<Eigen::Index>(unknown);
      const Vec2 heavy = point.inertia * slope[j];
      double* entries = layout.row(mass_.data(), unknown) + point.first;
      for (std::size_t k = 0; k <= j; ++k) entries[k] += dot(heavy, slope[k]);
      stiffness_coupling_(row, 5) -= dot(slope[j], turned);
      mass_coupling_(row, 5) += dot(slope[j], swept);
      if (point.direction) continue;
      mass_coupling_(row, 3) += heavy.x;
      mass_coupling_(row, 4) += heavy.y;
    }
    if (!linearised_) outer_stiffness_(5, 5) -= dot(arm, forces_[g]);
    outer_mass_(5, 5) += dot(perp(arm), swept);
    if (point.direction) continue;
    outer_mass_(3, 3) += point.inertia;
    outer_mass_(4, 4) += point.inertia;
    outer_mass_(3, 5) += swept.x;
    outer_mass_(4, 5) += swept.y;
  }
  outer_mass_(5, 3) = outer_mass_(3, 5);
  outer_mass_(5, 4) = outer_mass_(4, 5);
}

}  // namespace flexura

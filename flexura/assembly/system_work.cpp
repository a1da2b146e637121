#include <cmath>

#include "flexura/assembly/system.hpp"

// Work along a path: the potential is linear in the load factor, Pi = stored - load factor *
// displacement, be the factor that of the loads or the share of assembly.

namespace flexura {

bool System::has_misfit(std::size_t member) const {
  const SystemLayout::Member& m = layout_.members[member];
  return norm(m.misfit) > 0.0 || m.misfit_rotation != 0.0;
}

bool System::needs_assembly() const {
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (has_misfit(k)) return true;
  for (const auto& spring : layout_.springs)
    if (spring.misfit != 0.0) return true;
  for (const auto& load : layout_.loads)
    if (load.constant) return true;
  return layout_.constant_fields && feels_surroundings_;
}

void System::set_assembling(bool assembling) {
  assembling_ = assembling;
  assembly_ = assembling ? 0.0 : 1.0;
  load_factor_ = 0.0;
}

/// Of the relative pose, by the load factor while assembling.
Eigen::Vector3d System::misfit_rate(std::size_t member, const std::vector<double>& z,
                                    const RelativePose& pose) const {
  const SystemLayout::Member& m = layout_.members[member];
  Vec2 moved = m.misfit;
  if (!layout_.linearised)
    moved = rotate(this->pose(m.action, z).rotation - base_section(member, z).rotation, m.misfit);
  return Eigen::Vector3d(moved.x, moved.y, 0.0) +
         m.misfit_rotation * pose.jacobian.col(action_section);
}

/// The misfit enters the relative pose, so its rate enters the closure as minus that of a tip, and
/// the forces on the bodies through load . pose.
void System::add_misfit_rate(std::size_t member, const std::vector<double>& z,
                             const RelativePose& pose) {
  tangents_[member].field.tip_by_factor -= misfit_rate(member, z, pose);
  if (layout_.linearised) return;
  const SystemLayout::Member& m = layout_.members[member];
  const Vec2 moved = rotate(this->pose(m.action, z).rotation, m.misfit);
  // the arm of the tip turns with the misfit: there the potential is not quite linear in its share
  misfit_rate_ -=
      m.misfit_rotation * m.misfit_rotation * pose.hessian(action_section, action_section);
  const Eigen::Vector3d load = member_load(member, z);
  const Vec2 force = rotate(base_section(member, z).rotation, {load[0], load[1]});
  Eigen::Matrix<double, port_unknowns, 1> rate =
      m.misfit_rotation * pose.hessian.col(action_section);
  rate[action_turn] += dot(force, perp(moved));
  rate[PortUnknown::base_section] += dot(perp(force), moved);
  for (int i = 0; i < port_unknowns; ++i) {
    const int row = members_[member].unknowns[i];
    if (row >= 0) load_vector_[row] -= rate[i];
  }
}

/// Of the dead loads that grow, or of those that do not.
double System::dead_work(bool growing, const std::vector<double>& z) const {
  double work = 0.0;
  for (const auto& load : layout_.loads) {
    if (grows(load) != growing) continue;
    const Vec2 drawn = layout_.bodies[load.body].centre + load.arm;
    work += dot(load.force, moved_point(load.body, drawn, z) - drawn) +
            load.moment * pose(load.body, z).rotation;
  }
  return work + (fields_grow() == growing ? field_displacement_ : 0.0);
}

double System::load_displacement(const std::vector<double>& z) const {
  double work = dead_work(true, z);
  if (!assembling_) {
    for (std::size_t i = 0; i < layout_.prescribed.size(); ++i)
      work -= layout_.prescribed[i].value * prescribed_reaction(i, z);
    return work;
  }
  // a spring that shortens as it is assembled pulls with a force that grows, through its length
  for (const auto& spring : layout_.springs)
    if (spring.misfit != 0.0)
      work += spring.stiffness * spring.misfit *
              (spring_length(spring, z).value - (spring.free - spring.misfit));
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (has_misfit(k)) work -= member_load(k, z).dot(misfit_rate(k, z, relative_pose_of(k, z)));
  return work;
}

double System::stored_energy(const std::vector<double>& z) const {
  double energy = strain_energy_;
  if (!assembling_) {
    energy -= dead_work(false, z);
    for (std::size_t i = 0; i < layout_.prescribed.size(); ++i)
      energy -= load_factor_ * layout_.prescribed[i].value * prescribed_reaction(i, z);
    return energy;
  }
  for (const auto& spring : layout_.springs) {
    if (spring.misfit == 0.0) continue;
    const double pull = assembly_ * spring.stiffness * spring.misfit;
    energy += pull * (spring_length(spring, z).value - (spring.free - spring.misfit) -
                      0.5 * assembly_ * spring.misfit);
  }
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (has_misfit(k))
      energy -= assembly_ * member_load(k, z).dot(misfit_rate(k, z, relative_pose_of(k, z)));
  return energy;
}

double System::load_rate(const std::vector<double>& direction) const {
  const auto primary = static_cast<Eigen::Index>(primary_);
  double rate =
      load_vector_.head(primary).dot(Eigen::Map<const Eigen::VectorXd>(direction.data(), primary));
  if (!assembling_) return rate;
  rate += misfit_rate_;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!has_misfit(k)) continue;
    const MemberTangent& tangent = tangents_[k];
    const Eigen::Vector3d& closing = tangent.field.tip_by_factor;
    if (tangent.kept >= 0)
      rate += closing.dot(Eigen::Map<const Eigen::Vector3d>(direction.data() + members_[k].load));
    else
      rate -= closing.dot(tangent.stiffness * closing);
  }
  return rate;
}

}  // namespace flexura

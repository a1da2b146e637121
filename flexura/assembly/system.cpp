#include "flexura/assembly/system.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flexura/assembly/mechanism_scale.hpp"

namespace flexura {
System::System(SystemLayout layout) : layout_(std::move(layout)) {
  for (const auto& body : layout_.bodies) held_.push_back({body.centre, 0.0});
  follower_ = !layout_.linearised && std::any_of(layout_.loads.begin(), layout_.loads.end(),
                                                 [](const auto& load) { return load.follower; });
  for (const auto& member : layout_.members)
    feels_surroundings_ = feels_surroundings_ || member.port->feels_surroundings();
  number_unknowns();
  const auto most = static_cast<Eigen::Index>(primary_ + 3 * members_.size());
  tangent_.setZero(most, most);
  residual_.setZero(most);
  load_vector_.setZero(most);
  scale_.resize(most);
  tangents_.resize(members_.size());
  set_scale();
  if (layout_.linearised) {
    const std::vector<double> start = initial_state();
    assembly_ = 0.0;
    for (std::size_t k = 0; k < layout_.members.size(); ++k) {
      double q[port_unknowns];
      gather(k, start, q);
      drawn_.push_back(relative_pose(q, layout_.members[k].arms, Eigen::Vector3d::Zero()));
    }
    assembly_ = 1.0;
  }
}

std::size_t System::modeled_size() const {
  std::size_t size = size_;
  for (const auto& member : layout_.members)
    size -= member.port->internal_size() - member.port->nodal_size();
  return size;
}

void System::number_unknowns() {
  Numbering numbering(layout_);
  bodies_ = std::move(numbering.bodies);
  for (const Numbering::Member& member : numbering.members) {
    MemberIndex index{};
    index.unknowns = member.unknowns;
    members_.push_back(index);
  }
  moving_ = numbering.moving;
  primary_ = moving_ + layout_.prescribed.size() + 2 * layout_.joints.size();
  size_ = primary_ + 3 * members_.size();
  std::size_t scratch = 0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    members_[k].load = primary_ + 3 * k;
    members_[k].internal = size_;
    members_[k].scratch = scratch;
    size_ += layout_.members[k].port->internal_size();
    scratch += layout_.members[k].port->scratch_size();
  }
  scratch_.resize(scratch);
}

void System::set_scale() {
  const MechanismScale scale = scale_of(layout_);
  length_ = scale.length;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& member = layout_.members[k];
    const double root = std::sqrt(member.bending_stiffness / member.length);
    members_[k].force_scale = root / member.length;
    members_[k].moment_scale = root;
  }
  const double turn = 1.0 / std::sqrt(scale.energy);
  turn_scale_ = turn;
  scale_.setConstant(turn);
  step_weight_.setOnes(static_cast<Eigen::Index>(moving_));
  for (const BodyIndex& body : bodies_) {
    if (body.position < 0) continue;
    scale_.segment<2>(body.position).setConstant(length_ * turn);
    step_weight_.segment<2>(body.position).setConstant(1.0 / length_);
  }
  for (std::size_t i = 0; i < layout_.prescribed.size(); ++i) {
    const bool turns =
        layout_.prescribed[i].component == SystemLayout::Prescribed::Component::rotation;
    scale_[static_cast<Eigen::Index>(moving_ + i)] = 1.0 / (turns ? turn : length_ * turn);
  }
  for (std::size_t i = 0; i < layout_.joints.size(); ++i) {
    const bool slides = layout_.joints[i].kind == SystemLayout::Joint::Kind::prismatic;
    const auto row = static_cast<Eigen::Index>(joint_index(i));
    scale_[row] = 1.0 / (length_ * turn);
    scale_[row + 1] = 1.0 / (slides ? turn : length_ * turn);
  }
}

Pose System::pose(std::size_t body, const std::vector<double>& z) const {
  const BodyIndex& index = bodies_[body];
  Pose pose = held_[body];
  if (index.position >= 0) {
    const auto k = static_cast<std::size_t>(index.position);
    pose.position = layout_.bodies[body].centre + Vec2{z[k], z[k + 1]};
  }
  if (index.rotation >= 0) pose.rotation = z[static_cast<std::size_t>(index.rotation)];
  return pose;
}

Vec2 System::moved_point(std::size_t body, Vec2 drawn, const std::vector<double>& z) const {
  const Pose at = pose(body, z);
  const Vec2 arm = drawn - layout_.bodies[body].centre;
  if (layout_.linearised) return at.position + arm + at.rotation * perp(arm);
  return at.position + rotate(at.rotation, arm);
}

Pose System::base_section(std::size_t member, const std::vector<double>& z) const {
  const auto& m = layout_.members[member];
  const Pose body = pose(m.base, z);
  const int own = members_[member].unknowns[PortUnknown::base_section];
  const double turn = own >= 0 ? z[static_cast<std::size_t>(own)] : body.rotation;
  return {moved_point(m.base, layout_.bodies[m.base].centre + m.arms.base, z), turn};
}

Surroundings System::surroundings(std::size_t member, const std::vector<double>& z) const {
  return {base_section(member, z).rotation, layout_.constant_fields ? assembly_ : load_factor_,
          layout_.linearised};
}

Eigen::Vector3d System::member_load(std::size_t member, const std::vector<double>& z) const {
  return Eigen::Map<const Eigen::Vector3d>(z.data() + members_[member].load);
}

std::span<const double> System::internal(std::size_t member, const std::vector<double>& z) const {
  return std::span(z).subspan(members_[member].internal,
                              layout_.members[member].port->internal_size());
}

void System::gather(std::size_t member, const std::vector<double>& z,
                    double (&q)[port_unknowns]) const {
  const auto& m = layout_.members[member];
  const Pose base = pose(m.base, z);
  const Pose action = pose(m.action, z);
  // Positions count from the base body's drawn centre: differences of small numbers stay exact.
  const Vec2 origin = layout_.bodies[m.base].centre;
  const Vec2 a = base.position - origin;
  const Vec2 b = action.position - origin;
  const double values[port_unknowns] = {a.x, a.y, base.rotation,   base.rotation,
                                        b.x, b.y, action.rotation, action.rotation};
  std::copy(std::begin(values), std::end(values), std::begin(q));
  const auto& unknowns = members_[member].unknowns;
  for (const int own : {PortUnknown::base_section, PortUnknown::action_section})
    if (unknowns[own] >= 0) q[own] = z[static_cast<std::size_t>(unknowns[own])];
  q[action_section] += assembly_ * m.misfit_rotation;
}

RelativePose System::relative_pose_of(std::size_t member, const std::vector<double>& z) const {
  double q[port_unknowns];
  gather(member, z, q);
  const auto& m = layout_.members[member];
  const Vec2 misfit = assembly_ * m.misfit;
  if (!layout_.linearised)
    return relative_pose(q, {m.arms.base, m.arms.action + misfit, m.arms.tip},
                         member_load(member, z));
  const Vec2 apart = layout_.bodies[m.action].centre - layout_.bodies[m.base].centre;
  q[action_x] -= apart.x;
  q[action_y] -= apart.y;
  RelativePose pose = drawn_[member];
  pose.value += pose.jacobian * Eigen::Map<const Eigen::Matrix<double, port_unknowns, 1>>(q);
  pose.value.head<2>() += Eigen::Vector2d(misfit.x, misfit.y);
  return pose;
}

double System::inner(const std::vector<double>& a, const std::vector<double>& b) const {
  double sum = 0.0;
  for (const BodyIndex& body : bodies_) {
    const auto k = static_cast<std::size_t>(std::max(body.position, 0));
    if (body.position >= 0) sum += (a[k] * b[k] + a[k + 1] * b[k + 1]) / (length_ * length_);
    if (body.rotation >= 0) sum += a[k + 2] * b[k + 2];
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto first = static_cast<std::ptrdiff_t>(members_[k].internal);
    const auto count = static_cast<std::ptrdiff_t>(layout_.members[k].port->internal_size());
    if (count > 0)
      sum +=
          std::inner_product(a.begin() + first, a.begin() + first + count, b.begin() + first, 0.0) /
          static_cast<double>(count);
  }
  return sum;
}

double System::distance(const std::vector<double>& a, const std::vector<double>& b) const {
  double largest = 0.0;
  for (const BodyIndex& body : bodies_) {
    const auto k = static_cast<std::size_t>(std::max(body.position, 0));
    if (body.position >= 0)
      largest = std::max(largest, std::hypot(a[k] - b[k], a[k + 1] - b[k + 1]) / length_);
    if (body.rotation >= 0) largest = std::max(largest, std::abs(a[k + 2] - b[k + 2]));
  }
  return largest;
}

double System::largest_turn(const std::vector<double>& z) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < members_.size(); ++k)
    largest = std::max(largest, std::abs(relative_pose_of(k, z).value[2]));
  return largest;
}

Eigen::Vector3d System::reaction(std::size_t body, const std::vector<double>& z) const {
  Eigen::Vector3d sum = spring_reaction(body, z) + joint_reaction(body, z);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& member = layout_.members[k];
    if (member.base != body && member.action != body) continue;
    const RelativePose pose = relative_pose_of(k, z);
    const Eigen::Matrix<double, port_unknowns, 1> force =
        pose.jacobian.transpose() * member_load(k, z);
    if (member.base == body) {
      sum += force.segment<3>(base_x);
      if (!member.pinned_base) sum[2] += force[PortUnknown::base_section];
    }
    if (member.action == body) {
      sum += force.segment<3>(action_x);
      if (!member.pinned_action) sum[2] += force[PortUnknown::action_section];
    }
  }
  return sum;
}

std::unique_ptr<System> System::refined() const {
  SystemLayout finer = layout_;
  bool any = false;
  for (auto& member : finer.members) {
    if (auto port = member.port->refined()) {
      member.port = std::move(port);
      any = true;
    }
  }
  if (!any) return nullptr;
  auto system = std::make_unique<System>(std::move(finer));
  system->hold_as(*this);
  return system;
}

std::vector<double> System::prolong(const std::vector<double>& z, const System& refined) const {
  std::vector<double> out(refined.size_, 0.0);
  std::copy_n(z.begin(), primary_ + 3 * members_.size(), out.begin());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& fine = refined.members_[k];
    const std::size_t count = refined.layout_.members[k].port->internal_size();
    layout_.members[k].port->prolong(internal(k, z), std::span(out).subspan(fine.internal, count));
  }
  return out;
}

}  // namespace flexura

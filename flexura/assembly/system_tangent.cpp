#include "flexura/assembly/system.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/ldlt.hpp"

namespace flexura {
namespace {

constexpr double regular_flexibility = 1e-8;  // least over largest pivot, scaled

/// Inverts a symmetric 3 x 3 matrix through L D L^T; false where its pivots say it is nearly
/// singular. `negative` counts negative eigenvalues.
bool invert(const Eigen::Matrix3d& matrix, Eigen::Matrix3d& inverse, int& negative) {
  Eigen::Matrix3d factor = matrix;  // symmetric: row- and column-major are the same
  double* a = factor.data();
  double column[3];
  const LdltInertia inertia = factorize_ldlt(a, dense_layout(3), column);
  negative = inertia.negative;
  if (inertia.weak) return false;
  const double d[3] = {std::abs(a[0]), std::abs(a[4]), std::abs(a[8])};
  if (!(*std::min_element(d, d + 3) > regular_flexibility * *std::max_element(d, d + 3)))
    return false;
  inverse.setIdentity();
  solve_ldlt<3>(a, dense_layout(3), inverse.data());
  return true;
}

}  // namespace

/// Leaves the load among the unknowns of the reduced matrix: its flexibility has no inverse.
void System::keep_load(std::size_t member, const Eigen::Matrix3d& flexibility) {
  const MemberIndex& index = members_[member];
  MemberTangent& tangent = tangents_[member];
  const auto row = reduced_;
  tangent.kept = static_cast<int>(row);
  reduced_ += 3;
  tangent_.middleRows<3>(row).setZero();
  tangent_.middleCols<3>(row).setZero();
  tangent_.block<3, 3>(row, row) = -flexibility;
  residual_.segment<3>(row) = tangent.gap;
  scale_.segment<3>(row) << index.force_scale, index.force_scale, index.moment_scale;
  for (int i = 0; i < port_unknowns; ++i) {
    if (index.unknowns[i] < 0) continue;
    // added: both ends of a flexure may share an unknown
    tangent_.block<3, 1>(row, index.unknowns[i]) += tangent.jacobian.col(i);
    tangent_.block<1, 3>(index.unknowns[i], row) += tangent.jacobian.col(i).transpose();
  }
}

TipResponse System::respond(std::size_t member, const std::vector<double>& z) {
  const MemberIndex& index = members_[member];
  const TwoPort& port = *layout_.members[member].port;
  const Eigen::Vector3d load = member_load(member, z);
  const double* internal = z.data() + index.internal;
  double* scratch = scratch_.data() + index.scratch;
  if (!port.feels_surroundings()) return port.linearize(load, internal, scratch);
  FieldResponse& field = tangents_[member].field;
  TipResponse response = port.linearize_in(surroundings(member, z), load, internal, scratch, field);
  field_displacement_ -= field.by_factor;
  if (fields_grow()) return response;
  field.tip_by_factor.setZero();
  field.turn_factor = 0.0;
  return response;
}

/// What a growing load factor does through a flexure that feels it: added to the loads' rate, once
/// the residual has been taken from that.
void System::add_field_rate(std::size_t member) {
  const MemberTangent& tangent = tangents_[member];
  const MemberIndex& index = members_[member];
  if (!layout_.members[member].port->feels_surroundings() && !has_misfit(member)) return;
  const Eigen::Vector3d& tip = tangent.field.tip_by_factor;
  const int turn = index.unknowns[PortUnknown::base_section];
  if (turn >= 0) load_vector_[turn] -= tangent.field.turn_factor;
  if (tangent.kept >= 0) {
    load_vector_.segment<3>(tangent.kept) += tip;
    return;
  }
  const Eigen::Matrix<double, port_unknowns, 1> force =
      tangent.jacobian.transpose() * (tangent.stiffness * tip);
  for (int i = 0; i < port_unknowns; ++i)
    if (index.unknowns[i] >= 0) load_vector_[index.unknowns[i]] += force[i];
}

bool System::add_member(std::size_t member, const std::vector<double>& z) {
  const MemberIndex& index = members_[member];
  MemberTangent& tangent = tangents_[member];
  const Eigen::Vector3d load = member_load(member, z);
  tangent.field = {};
  const TipResponse response = respond(member, z);
  if (response.singular || !response.tip.allFinite()) return false;
  eliminated_negative_ += response.negative;
  strain_energy_ += response.strain_energy;

  const RelativePose pose = relative_pose_of(member, z);
  tangent.jacobian = pose.jacobian;
  tangent.gap = pose.value - response.tip;
  tangent.kept = -1;

  // scaled, so that "nearly singular" does not depend on units
  const Eigen::Vector3d s(index.force_scale, index.force_scale, index.moment_scale);
  const Eigen::Matrix3d flexibility = s.asDiagonal() * response.flexibility * s.asDiagonal();
  int negative = 0;
  RelativePose::Hessian stiffness = pose.hessian;
  Eigen::Matrix<double, port_unknowns, 1> force = pose.jacobian.transpose() * load;
  if (layout_.members[member].port->feels_surroundings()) {
    tangent.jacobian.col(PortUnknown::base_section) -= tangent.field.tip_by_turn;
    stiffness(PortUnknown::base_section, PortUnknown::base_section) += tangent.field.turn_turn;
    force[PortUnknown::base_section] += tangent.field.by_turn;
  }
  if (assembling_ && has_misfit(member)) add_misfit_rate(member, z, pose);
  if (invert(flexibility, tangent.stiffness, negative)) {
    tangent.stiffness = s.asDiagonal() * tangent.stiffness * s.asDiagonal();
    eliminated_negative_ += 3 - negative;  // of minus the flexibility
    const RelativePose::Jacobian kj = tangent.stiffness * tangent.jacobian;
    stiffness.noalias() += tangent.jacobian.transpose() * kj;
    force.noalias() += kj.transpose() * tangent.gap;
  } else {
    keep_load(member, response.flexibility);
  }
  for (int i = 0; i < port_unknowns; ++i) {
    const int row = index.unknowns[i];
    if (row < 0) continue;
    residual_[row] += force[i];
    for (int j = 0; j < port_unknowns; ++j)
      if (index.unknowns[j] >= 0) tangent_(row, index.unknowns[j]) += stiffness(i, j);
  }
  return true;
}

void System::add_load(const SystemLayout::Load& load, const std::vector<double>& z) {
  const BodyIndex& index = bodies_[load.body];
  if (index.position < 0) return;
  const double turn = layout_.linearised ? 0.0 : pose(load.body, z).rotation;
  const Vec2 arm = rotate(turn, load.arm);
  const Vec2 force = load.follower ? rotate(turn, load.force) : load.force;
  const double factor = load.constant ? assembly_ : load_factor_;
  const auto push = [&](int row, double value) {
    residual_[row] -= factor * value;
    if (grows(load)) load_vector_[row] += value;
  };
  push(index.position, force.x);
  push(index.position + 1, force.y);
  if (index.rotation < 0) return;
  push(index.rotation, cross(arm, force) + load.moment);
  if (layout_.linearised) return;
  if (load.follower) {
    const Vec2 change = factor * perp(force);
    tangent_(index.position, index.rotation) -= change.x;
    tangent_(index.position + 1, index.rotation) -= change.y;
  } else {
    tangent_(index.rotation, index.rotation) += factor * dot(arm, force);
  }
}

/// The row and column of a reaction, from -reaction (displacement - load factor * value).
void System::add_prescribed(std::size_t i, const std::vector<double>& z) {
  using Component = SystemLayout::Prescribed::Component;
  const SystemLayout::Prescribed& prescribed = layout_.prescribed[i];
  const BodyIndex& index = bodies_[prescribed.body];
  const auto row = static_cast<Eigen::Index>(moving_ + i);
  const double reaction = prescribed_reaction(i, z);
  load_vector_[row] = assembling_ ? 0.0 : -prescribed.value;
  const double target = load_factor_ * prescribed.value;
  const auto couple = [&](int unknown, double slope) {
    tangent_(row, unknown) -= slope;
    tangent_(unknown, row) -= slope;
    residual_[unknown] -= reaction * slope;
  };
  if (prescribed.component == Component::rotation) {
    residual_[row] = target - pose(prescribed.body, z).rotation;
    couple(index.rotation, 1.0);
    return;
  }
  const bool along_x = prescribed.component == Component::x;
  const Vec2 drawn = layout_.bodies[prescribed.body].centre + prescribed.arm;
  const Vec2 moved = moved_point(prescribed.body, drawn, z) - drawn;
  residual_[row] = target - (along_x ? moved.x : moved.y);
  couple(index.position + (along_x ? 0 : 1), 1.0);
  if (index.rotation < 0) return;
  const double turn = layout_.linearised ? 0.0 : pose(prescribed.body, z).rotation;
  const Vec2 arm = rotate(turn, prescribed.arm);
  couple(index.rotation, along_x ? -arm.y : arm.x);
  if (!layout_.linearised)
    tangent_(index.rotation, index.rotation) += reaction * (along_x ? arm.x : arm.y);
}

bool System::linearize(const std::vector<double>& z) {
  reduced_ = static_cast<Eigen::Index>(primary_);
  tangent_.topLeftCorner(reduced_, reduced_).setZero();
  residual_.head(reduced_).setZero();
  load_vector_.setZero();
  eliminated_negative_ = 0;
  strain_energy_ = 0.0;
  field_displacement_ = 0.0;
  misfit_rate_ = 0.0;
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (!add_member(k, z)) return false;
  for (const auto& spring : layout_.springs) add_spring(spring, z);
  for (const auto& load : layout_.loads) add_load(load, z);
  for (std::size_t i = 0; i < layout_.prescribed.size(); ++i) add_prescribed(i, z);
  for (std::size_t i = 0; i < layout_.joints.size(); ++i) add_joint(i, z);
  if (feels_surroundings_ || assembling_)
    for (std::size_t k = 0; k < members_.size(); ++k) add_field_rate(k);
  return residual_.head(reduced_).allFinite() && factorize();
}

bool System::factorize() {
  auto k = tangent_.topLeftCorner(reduced_, reduced_);
  const auto s = scale_.head(reduced_);
  for (Eigen::Index j = 0; j < reduced_; ++j) k.col(j).array() *= s[j] * s.array();
  if (!follower_) {
    const bool regular = factor_.factorize(k);
    pivot_ratio_ = factor_.pivot_ratio();
    return regular;
  }
  Eigen::MatrixXd balanced = k;
  lu_balance_ = balance_rows(balanced);
  lu_.compute(balanced);
  const Eigen::VectorXd pivots = lu_.matrixLU().diagonal().cwiseAbs();
  pivot_ratio_ = pivots.size() == 0 ? 1.0 : pivots.minCoeff() / pivots.maxCoeff();
  return std::isfinite(pivot_ratio_) && pivot_ratio_ > 0.0;
}

void System::solve_scaled(Eigen::VectorXd& b) const {
  b.array() *= scale_.head(reduced_).array();
  solve_factored(b);
  b.array() *= scale_.head(reduced_).array();
}

void System::solve_factored(Eigen::VectorXd& b) const {
  if (follower_)
    b = lu_balance_.cwiseProduct(lu_.solve(lu_balance_.cwiseProduct(b)));
  else
    factor_.solve(b);
}

/// Singular mechanisms have pivots of nothing but rounding, below 1e-15 of the largest. Those of
/// very slender flexures have weak ones, too, yet solving for a known solution gives it back.
bool System::is_singular() const {
  if (pivot_ratio_ >= 1e-13) return false;
  if (!(pivot_ratio_ >= 1e-15)) return true;
  const auto k = tangent_.topLeftCorner(reduced_, reduced_);
  const Eigen::VectorXd known = Eigen::VectorXd::LinSpaced(reduced_, 1.0, 2.0);
  Eigen::VectorXd found = follower_ ? Eigen::VectorXd(k * known)
                                    : Eigen::VectorXd(k.selfadjointView<Eigen::Lower>() * known);
  solve_factored(found);
  return !((found - known).norm() < 0.1 * known.norm());
}

void System::expand(const Eigen::VectorXd& reduced, Along along, std::vector<double>& step) const {
  const double residual = along == Along::residual ? 1.0 : 0.0;
  const double growth = along == Along::load ? 1.0 : 0.0;
  step.resize(size_);
  std::copy_n(reduced.data(), primary_, step.begin());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberIndex& index = members_[k];
    const MemberTangent& tangent = tangents_[k];
    Eigen::Map<Eigen::Vector3d> load(step.data() + index.load);
    if (tangent.kept >= 0) {
      load = reduced.segment<3>(tangent.kept);
    } else {
      Eigen::Vector3d closing = residual * tangent.gap - growth * tangent.field.tip_by_factor;
      for (int i = 0; i < port_unknowns; ++i)
        if (index.unknowns[i] >= 0) closing += tangent.jacobian.col(i) * reduced[index.unknowns[i]];
      load = tangent.stiffness * closing;
    }
    const std::size_t m = layout_.members[k].port->internal_size();
    const double* u = scratch_.data() + index.scratch;
    double* out = step.data() + index.internal;
    layout_.members[k].port->advance(u, residual, load, out);
    if (!layout_.members[k].port->feels_surroundings()) continue;
    u += 4 * m;
    const int own = index.unknowns[PortUnknown::base_section];
    const double turn = own >= 0 ? reduced[own] : 0.0;
    const double field_growth = fields_grow() ? growth : 0.0;
    for (std::size_t i = 0; i < m; ++i, u += 4) out[i] -= u[0] * turn + u[1] * field_growth;
  }
}

double System::newton_step(std::vector<double>& step) const {
  work_ = -residual_.head(reduced_);
  solve_scaled(work_);
  expand(work_, Along::residual, step);
  const auto moving = static_cast<Eigen::Index>(moving_);
  double size = work_.head(moving).cwiseProduct(step_weight_).lpNorm<Eigen::Infinity>();
  const std::size_t first_internal = primary_ + 3 * members_.size();
  for (std::size_t i = first_internal; i < size_; ++i) size = std::max(size, std::abs(step[i]));
  return std::isfinite(size) ? size : INFINITY;
}

void System::load_direction(std::vector<double>& direction) const {
  work_ = load_vector_.head(reduced_);
  solve_scaled(work_);
  expand(work_, Along::load, direction);
}

int System::unstable_directions() const {
  const int closures = 3 * static_cast<int>(members_.size()) +
                       static_cast<int>(layout_.prescribed.size() + 2 * layout_.joints.size());
  if (!follower_) return factor_.negative() + eliminated_negative_ - closures;
  int sign = lu_.permutationP().determinant() > 0 ? 0 : 1;
  for (Eigen::Index i = 0; i < lu_.rows(); ++i)
    if (lu_.matrixLU()(i, i) < 0.0) ++sign;
  return (sign + eliminated_negative_ + closures) % 2;
}

std::optional<std::size_t> System::softest_body() const {
  // Inverse iteration, shifted by a little so that an exactly singular matrix can be factorized.
  Eigen::MatrixXd shifted = tangent_.topLeftCorner(reduced_, reduced_);
  shifted.diagonal().array() += 1e-10;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(shifted);
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(reduced_, 1.0, 2.0);
  for (int k = 0; k < 3; ++k) v = lu.solve(v.normalized()).eval();
  const auto moving = static_cast<Eigen::Index>(moving_);
  const double loads = reduced_ > moving ? v.tail(reduced_ - moving).cwiseAbs().maxCoeff() : 0.0;
  std::optional<std::size_t> softest;
  double largest = 1e-6 * loads;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].position < 0) continue;
    double motion = v.segment<2>(bodies_[b].position).norm();
    if (bodies_[b].rotation >= 0) motion += std::abs(v[bodies_[b].rotation]);
    if (motion > largest) {
      largest = motion;
      softest = b;
    }
  }
  return softest;
}

Eigen::Matrix3d System::body_compliance(std::size_t body) const {
  const BodyIndex& index = bodies_[body];
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();
  if (index.position < 0) return compliance;
  const int rows[3] = {index.position, index.position + 1, index.rotation};
  for (int c = 0; c < 3; ++c) {
    if (rows[c] < 0) continue;
    work_.setZero(reduced_);
    work_[rows[c]] = 1.0;
    solve_scaled(work_);
    for (int r = 0; r < 3; ++r)
      if (rows[r] >= 0) compliance(r, c) = work_[rows[r]];
  }
  return compliance;
}

}  // namespace flexura

#include "flexura/assembly/system.hpp"

#include <cmath>

namespace flexura {

Eigen::MatrixXd System::hessian(const std::vector<double>& z) {
  reduced_ = static_cast<Eigen::Index>(primary_);
  tangent_.topLeftCorner(reduced_, reduced_).setZero();
  residual_.head(reduced_).setZero();
  load_vector_.setZero();
  for (const auto& spring : layout_.springs) add_spring(spring, z);
  for (const auto& load : layout_.loads) add_load(load, z);
  for (std::size_t i = 0; i < layout_.prescribed.size(); ++i) add_prescribed(i, z);
  for (std::size_t i = 0; i < layout_.joints.size(); ++i) add_joint(i, z);

  const auto n = static_cast<Eigen::Index>(size_);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n, n);
  h.topLeftCorner(reduced_, reduced_) = tangent_.topLeftCorner(reduced_, reduced_);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberIndex& index = members_[k];
    const RelativePose pose = relative_pose_of(k, z);
    const auto load = static_cast<Eigen::Index>(index.load);
    for (int i = 0; i < port_unknowns; ++i) {
      if (index.unknowns[i] < 0) continue;
      h.block<3, 1>(load, index.unknowns[i]) += pose.jacobian.col(i);
      h.block<1, 3>(index.unknowns[i], load) += pose.jacobian.col(i).transpose();
      for (int j = 0; j < port_unknowns; ++j)
        if (index.unknowns[j] >= 0) h(index.unknowns[i], index.unknowns[j]) += pose.hessian(i, j);
    }
    const Eigen::MatrixXd port =
        layout_.members[k].port->hessian(member_load(k, z), z.data() + index.internal);
    const auto m = port.rows() - 3;
    const auto first = static_cast<Eigen::Index>(index.internal);
    h.block(first, first, m, m) += port.topLeftCorner(m, m);
    h.block(first, load, m, 3) += port.topRightCorner(m, 3);
    h.block(load, first, 3, m) += port.bottomLeftCorner(3, m);
    h.block<3, 3>(load, load) += port.bottomRightCorner<3, 3>();
  }
  return h;
}

Eigen::VectorXd System::unknown_scale() const {
  Eigen::VectorXd scale(static_cast<Eigen::Index>(size_));
  const auto primary = static_cast<Eigen::Index>(primary_);
  scale.head(primary) = scale_.head(primary);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberIndex& index = members_[k];
    scale.segment<3>(static_cast<Eigen::Index>(index.load)) << index.force_scale, index.force_scale,
        index.moment_scale;
    scale
        .segment(static_cast<Eigen::Index>(index.internal),
                 static_cast<Eigen::Index>(layout_.members[k].port->internal_size()))
        .setConstant(1.0 / index.moment_scale);
  }
  return scale / turn_scale_;
}

/// Inverse iteration, in the scaled unknowns, across the directions that were found before.
std::vector<std::vector<double>> System::critical_directions(int count) const {
  const auto s = scale_.head(reduced_).array();
  std::vector<Eigen::VectorXd> found;
  std::vector<std::vector<double>> directions;
  for (int c = 0; c < count && c < reduced_; ++c) {
    work_ = Eigen::VectorXd::LinSpaced(reduced_, 1.0, 1.7);
    for (Eigen::Index i = 1; i < reduced_; i += 2 + c) work_[i] *= -0.6;
    for (int k = 0; k < 4; ++k) {
      work_.array() /= s;  // as a load
      solve_scaled(work_);
      work_.array() /= s;
      for (const Eigen::VectorXd& other : found) work_ -= other.dot(work_) * other;
      work_ /= work_.norm();
    }
    found.push_back(work_);
    work_.array() *= s;
    std::vector<double> direction;
    expand(work_, Along::nothing, direction);
    const double size = std::sqrt(inner(direction, direction));
    if (size > 0.0)
      for (double& d : direction) d /= size;
    directions.push_back(std::move(direction));
  }
  return directions;
}

void System::critical_direction(std::vector<double>& direction) const {
  direction = critical_directions(1).front();
}

/// The reduced matrix of the last linearization without the rows of reactions.
Eigen::MatrixXd System::place_compliance(std::span<const Place> places,
                                         const std::vector<double>& z) const {
  const auto moving = static_cast<Eigen::Index>(moving_);
  const auto first = moving + static_cast<Eigen::Index>(layout_.prescribed.size());
  const Eigen::Index kept = reduced_ - first;  // joints, loads
  const Eigen::Index n = moving + kept;
  Eigen::MatrixXd stiffness(n, n);
  stiffness.topLeftCorner(moving, moving) = tangent_.topLeftCorner(moving, moving);
  stiffness.bottomRightCorner(kept, kept) = tangent_.block(first, first, kept, kept);
  stiffness.topRightCorner(moving, kept) = tangent_.block(0, first, moving, kept);
  stiffness.bottomLeftCorner(kept, moving) = tangent_.block(first, 0, kept, moving);

  const auto columns = static_cast<Eigen::Index>(3 * places.size());
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(n, columns);  // of the places by the unknowns
  for (std::size_t p = 0; p < places.size(); ++p) {
    const BodyIndex& index = bodies_[places[p].body];
    if (index.position < 0) continue;
    const auto c = static_cast<Eigen::Index>(3 * p);
    const double turn = layout_.linearised ? 0.0 : pose(places[p].body, z).rotation;
    const Vec2 arm = rotate(turn, places[p].drawn - layout_.bodies[places[p].body].centre);
    motion(index.position, c) = motion(index.position + 1, c + 1) = scale_[index.position];
    if (index.rotation < 0) continue;
    motion.row(index.rotation).segment<3>(c) =
        scale_[index.rotation] * Eigen::RowVector3d(-arm.y, arm.x, 1.0);
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(stiffness);
  if (n == 0 || !lu.isInvertible()) return {};
  return motion.transpose() * lu.solve(motion);
}

}  // namespace flexura

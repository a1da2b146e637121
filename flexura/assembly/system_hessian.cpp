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
    expand(work_, false, direction);
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

}  // namespace flexura

#include "tests/report/sample_ellipse.hpp"

#include <Eigen/Dense>
#include <numbers>
#include <span>

namespace flexura::sample {
namespace {

using Joints = std::span<const Joint>;

Eigen::Matrix3d compliance_at(Joints joints, Vec2 at) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Joint& joint : joints) {
    const Vec2 arm = at - joint.at;
    const Eigen::Vector3d column(-arm.y, arm.x, 1.0);  // displacement per joint rotation
    sum += joint.compliance * column * column.transpose();
  }
  return sum;
}

Ellipse ellipse_of(Joints joints) {
  Ellipse ellipse;
  for (const Joint& joint : joints) {
    ellipse.weight += joint.compliance;
    ellipse.centre = ellipse.centre + joint.compliance * joint.at;
  }
  ellipse.centre = (1.0 / ellipse.weight) * ellipse.centre;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Joint& joint : joints) {
    const Vec2 d = joint.at - ellipse.centre;
    const Eigen::Vector2d v(d.x, d.y);
    spread += joint.compliance / ellipse.weight * v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  ellipse.minor = std::sqrt(eigen.eigenvalues()[0]);
  ellipse.major = std::sqrt(eigen.eigenvalues()[1]);
  ellipse.orientation = std::atan(eigen.eigenvectors()(1, 1) / eigen.eigenvectors()(0, 1));
  return ellipse;
}

/// The poles of all forces through `at`: (at - c) S^-1 (x - c) = -1, S the ellipse's squares.
Line2 antipolar_of(const Ellipse& ellipse, Vec2 at) {
  const Vec2 local = rotate(-ellipse.orientation, at - ellipse.centre);
  const Vec2 covector{local.x / (ellipse.major * ellipse.major),
                      local.y / (ellipse.minor * ellipse.minor)};
  const double size = norm(covector);
  return {ellipse.centre, rotate(ellipse.orientation, (1.0 / size) * covector), -1.0 / size};
}

ElasticityRecord make_record(ElasticityRecord::Of of, const std::string& name, Vec2 at,
                             Joints joints) {
  ElasticityRecord record;
  record.of = of;
  record.name = name;
  record.at = at;
  const Eigen::Matrix3d c = compliance_at(joints, at);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      record.compliance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = c(i, j);
    }
  }
  record.ellipse = ellipse_of(joints);
  record.antipolar = antipolar_of(*record.ellipse, at);
  const Eigen::Matrix2d single = c.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(single);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const auto greater_first = static_cast<std::size_t>(1 - k);
    record.principal_compliances[greater_first] = eigen.eigenvalues()[k];
    record.principal_directions[greater_first] = {eigen.eigenvectors()(0, k),
                                                  eigen.eigenvectors()(1, k)};
  }
  return record;
}

}  // namespace

LinearResult make_linear_result(const Chain& chain, const TipLoad& load) {
  const Joints joints(chain.joints);
  const std::size_t n = chain.joints_per_flexure;
  LinearResult linear;
  for (std::size_t i = 0; i < chain.drawing.flexures.size(); ++i) {
    const DrawnFlexure& flexure = chain.drawing.flexures[i];
    linear.records.push_back(make_record(ElasticityRecord::Of::flexure, flexure.name,
                                         flexure.axis.back(), joints.subspan(i * n, n)));
  }
  for (std::size_t b = 1; b < chain.drawing.bodies.size(); ++b) {
    const DrawnBody& body = chain.drawing.bodies[b];
    linear.records.push_back(
        make_record(ElasticityRecord::Of::body, body.name, body.centre, joints.first(b * n)));
  }
  linear.records.push_back(make_record(ElasticityRecord::Of::point, "link4.E", chain.tip, joints));

  const Eigen::Vector3d motion =
      compliance_at(joints, chain.tip) * Eigen::Vector3d(load.force.x, load.force.y, load.moment);
  PoleRecord pole{"link4.E", load.force, load.moment, {motion[0], motion[1]}, motion[2], {}};
  pole.pole = chain.tip + (1.0 / pole.rotation) * perp(pole.displacement);
  linear.poles.push_back(pole);
  return linear;
}

}  // namespace flexura::sample

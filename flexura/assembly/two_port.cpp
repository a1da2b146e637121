#include "flexura/assembly/two_port.hpp"

#include <algorithm>

namespace flexura {

void TwoPort::advance(const double* scratch, double residual, const Eigen::Vector3d& load,
                      double* step) const {
  const std::size_t m = internal_size();
  for (std::size_t i = 0; i < m; ++i, scratch += 4)
    step[i] =
        -residual * scratch[0] - scratch[1] * load[0] - scratch[2] * load[1] - scratch[3] * load[2];
}

std::vector<Vec2> TwoPort::drawn_axis(std::span<const SectionState> sections,
                                      std::span<const double> /*internal*/) const {
  std::vector<Vec2> axis;
  for (const SectionState& section : sections) axis.push_back(section.pose.position);
  return axis;
}

void TwoPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  std::copy(internal.begin(), internal.end(), refined.begin());
}

void add_eliminated(std::size_t m, const double* coupling, const double* solved,
                    TipResponse& response) {
  for (std::size_t i = 0; i < m; ++i) {
    const Eigen::Map<const Eigen::Vector3d> w(coupling + 4 * i + 1);
    const Eigen::Map<const Eigen::Vector3d> z(solved + 4 * i + 1);
    response.tip += solved[4 * i] * w;
    response.flexibility += w * z.transpose();
  }
}

void add_eliminated_field(std::size_t m, const double* coupling, const double* solved,
                          const double* field_coupling, const double* field_solved,
                          FieldResponse& field) {
  for (std::size_t i = 0; i < m; ++i) {
    const Eigen::Map<const Eigen::Vector3d> w(coupling + 4 * i + 1);
    const double* c = field_coupling + 4 * i;
    const double* z = field_solved + 4 * i;
    field.by_turn -= c[0] * solved[4 * i];
    field.tip_by_turn += z[0] * w;
    field.tip_by_factor += z[1] * w;
    field.turn_turn -= c[0] * z[0];
    field.turn_factor -= c[0] * z[1];
  }
}

Eigen::MatrixXd port_hessian(const double* columns, const BandLayout& layout, const double* tangent,
                             const Eigen::Matrix3d& by_load) {
  const std::size_t m = layout.n;
  const auto n = static_cast<Eigen::Index>(m);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n + 3, n + 3);
  for (std::size_t i = 0; i < m; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double* entries = layout.row(tangent, i);
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      hessian(row, column) = hessian(column, row) = entries[j];
    }
    for (Eigen::Index c = 0; c < 3; ++c)
      hessian(row, n + c) = hessian(n + c, row) = columns[4 * i + static_cast<std::size_t>(c) + 1];
  }
  hessian.bottomRightCorner<3, 3>() = by_load;
  return hessian;
}

}  // namespace flexura

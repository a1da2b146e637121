#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <vector>

#include "flexura/assembly/two_port.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// The 3x3 compliance matrix of a flexure held at its base, in global axes: displacement (x, y,
/// rotation) of the point `at`, thought fixed to the action end, per load (force x, force y,
/// moment) on it. By quadrature along the axis, to machine precision:
///     C = integral of v v^T/EI + (t,0)(t,0)^T/EA + (n,0)(n,0)^T/GA_s,
///     v = (-(y_at - y), x_at - x, 1).
Eigen::Matrix3d compliance_matrix(const FlexureProperties& flexure, Vec2 at);

/// The point about which a moment does not displace and at which a force does not turn; `at` is
/// where the matrix holds. Precondition: compliance(2, 2) > 0.
Vec2 elastic_centre(const Eigen::Matrix3d& compliance, Vec2 at);

/// A flexure whose tip answers its load by a constant compliance matrix: modelings `linear` and
/// `scmbm`, which differ in the kinematics around it.
class CompliantPort final : public TwoPort {
 public:
  /// `at` is the point of the tip that the matrix is about, as drawn.
  CompliantPort(const FlexureProperties& flexure, Vec2 at);

  std::size_t internal_size() const override { return 0; }
  std::size_t scratch_size() const override { return 0; }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& /*load*/,
                          const double* /*internal*/) const override {
    return -compliance_;
  }
  bool feels_surroundings() const override { return flexure_.field.acts(); }
  TipResponse linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                           const double* internal, double* scratch,
                           FieldResponse& field) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return sections_in({}, load, internal);
  }
  std::vector<SectionState> sections_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load,
                                        std::span<const double> internal) const override;

 private:
  using Load5 = Eigen::Matrix<double, 5, 1>;  // load, dead force as drawn, turned by a right angle
  void integrate_field();
  std::vector<SectionState> stations_of_link(const Eigen::Vector3d& load) const;

  FlexureProperties flexure_;
  Vec2 at_;  ///< from the base end
  Eigen::Matrix3d compliance_;
  // of what acts along it: complementary energy, potential as drawn and elongation by heat
  Eigen::Matrix<double, 5, 5> quadratic_ = Eigen::Matrix<double, 5, 5>::Zero();
  Load5 drawn_ = Load5::Zero();
  Load5 heat_ = Load5::Zero();
};

}  // namespace flexura

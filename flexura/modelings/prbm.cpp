#include "flexura/modelings/prbm.hpp"

#include <algorithm>

#include "flexura/assembly/angle_field.hpp"
#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// The chain as an angle field: its segments are the points, their lengths the weights, the angle
/// of a segment its drawn one plus all joint rotations before it.
constexpr auto rigid_potential = [](std::size_t, const auto& theta, const auto& fx,
                                    const auto& fy) {
  return reissner_mixed_potential(theta, fx, fy, 0.0, 0.0);
};

class PseudoRigidPort final : public TwoPort {
 public:
  PseudoRigidPort(const FlexureProperties& flexure, const PseudoRigidChain& chain);

  std::size_t internal_size() const override { return field_.unknowns; }
  std::size_t scratch_size() const override { return field_.scratch_size(); }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override;
  std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                               std::span<const double> internal) const override;

 private:
  FlexureProperties flexure_;
  std::vector<Vec2> vertices_;  // base end, joints, action end; from the base end
  std::vector<double> shares_;  // of the arc length whose bending each joint stands for, cumulative
  AngleField field_;
};

PseudoRigidPort::PseudoRigidPort(const FlexureProperties& flexure, const PseudoRigidChain& chain)
    : flexure_(flexure) {
  const Vec2 base = flexure.axis.position(0.0);
  const Vec2 chord = flexure.axis.position(flexure.axis.length()) - base;
  const std::size_t n = chain.joints.size();
  vertices_.push_back({});
  for (const Vec2 joint : chain.joints) vertices_.push_back(joint - base);
  vertices_.push_back(chord);

  double compliance = 0.0;
  for (const double k : chain.stiffness) compliance += 1.0 / k;
  shares_.push_back(0.0);
  for (const double k : chain.stiffness) shares_.push_back(shares_.back() + 1.0 / k / compliance);

  field_.unknowns = n;
  field_.stiffness.assign(n * n, 0.0);
  field_.tip_turn.assign(n, 1.0);
  field_.turns.assign((n + 1) * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) field_.stiffness[k * n + k] = chain.stiffness[k];
  Vec2 drawn;
  for (std::size_t segment = 0; segment <= n; ++segment) {
    const Vec2 link = vertices_[segment + 1] - vertices_[segment];
    field_.weights.push_back(norm(link));
    field_.angles.push_back(std::atan2(link.y, link.x));
    std::fill_n(field_.turns.begin() + static_cast<std::ptrdiff_t>(segment * n), segment, 1.0);
    drawn = drawn + field_.weights.back() * unit(field_.angles.back());
  }
  field_.offset = chord - drawn;
  field_.complete_pairs();
}

TipResponse PseudoRigidPort::linearize(const Eigen::Vector3d& load, const double* internal,
                                       double* scratch) const {
  return linearize_angle_field(field_, rigid_potential, load, internal, scratch);
}

Eigen::MatrixXd PseudoRigidPort::hessian(const Eigen::Vector3d& load,
                                         const double* internal) const {
  return angle_field_hessian(field_, rigid_potential, load, internal);
}

std::vector<Vec2> PseudoRigidPort::drawn_axis(std::span<const SectionState> /*sections*/,
                                              std::span<const double> internal) const {
  std::vector<Vec2> polyline{{}};
  for (std::size_t segment = 0; segment <= field_.unknowns; ++segment) {
    const Vec2 link = vertices_[segment + 1] - vertices_[segment];
    polyline.push_back(polyline.back() + rotate(field_.turn(segment, internal.data()), link));
  }
  return polyline;
}

/// A joint stands for the bending of its share of the flexure, so a section inside that share turns
/// with the part of the joint's rotation that lies before it, about the joint.
std::vector<SectionState> PseudoRigidPort::sections(const Eigen::Vector3d& load,
                                                    std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  const std::vector<Vec2> moved = drawn_axis({}, internal);
  const Vec2 f{load[0], load[1]};
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const double at = grid.s[k] / flexure_.axis.length();
    std::size_t joint = 0;
    while (joint + 1 < field_.unknowns && at > shares_[joint + 1]) ++joint;
    const double part = (at - shares_[joint]) / (shares_[joint + 1] - shares_[joint]);
    const double turn = field_.turn(joint, internal.data()) + part * internal[joint];
    const Vec2 position = moved[joint + 1] + rotate(turn, grid.positions[k] - vertices_[joint + 1]);
    const Vec2 t = unit(grid.angles[k] + turn);
    states.push_back({{position, turn},
                      dot(f, t),
                      dot(f, perp(t)),
                      load[2] + cross(moved.back() - position, f)});
  }
  return states;
}

}  // namespace

std::shared_ptr<const TwoPort> make_prbm_port(const FlexureProperties& flexure,
                                              const PseudoRigidChain& chain) {
  return std::make_shared<PseudoRigidPort>(flexure, chain);
}

}  // namespace flexura

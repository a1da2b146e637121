#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "flexura/assembly/motion_port.hpp"

namespace flexura {

/// How the base section of a flexure moves, in its own axes.
struct BaseMotion {
  Vec2 velocity;
  Vec2 acceleration;  ///< less gravity
  double spin = 0.0;
  double spin_rate = 0.0;
  double turn = 0.0;  ///< since the start: dead forces turn against it
};

/// What a flexure needs from outside to move so, in axes of its base section, and what it carries.
struct MemberForces {
  Eigen::Vector3d tip;
  Vec2 force;           ///< on the base section, besides that which holds the load on the tip
  double torque = 0.0;  ///< about the base end
  double strain_energy = 0.0;
  double kinetic_energy = 0.0;
  Vec2 momentum;
  double angular_momentum = 0.0;  ///< about the base end
};

/// One flexure in motion: residual of its internal unknowns and, for Newton's method, its stiffness
/// and mass as blocks. Outer unknowns of the blocks are the load on the tip (3), the base end's
/// displacement in axes of the base section (2) and that section's turn.
class MemberMotion {
 public:
  static constexpr int outer = 6;
  using Outer = Eigen::Matrix<double, outer, outer>;
  using Coupling = Eigen::Matrix<double, Eigen::Dynamic, outer, Eigen::RowMajor>;

  /// `linearised`: places to first order about the drawn state.
  MemberMotion(std::shared_ptr<const MotionPort> port, bool linearised);

  /// With y, its rates and second rates v and a. `mass_damping`: a force against the velocity of
  /// all mass, per mass; `stiffness_damping`: times the rate of the elastic forces.
  MemberForces evaluate(const Eigen::Vector3d& load, const double* y, const double* v,
                        const double* a, const BaseMotion& base, double mass_damping,
                        double stiffness_damping);
  /// Stiffness and mass at the last evaluation, by the accelerations it had. `with_elastic`: the
  /// stiffness of the energy by itself as well, which damping by the rate of elastic forces has.
  void linearize(const Eigen::Vector3d& load, const double* y, bool with_elastic);

  const MotionPort& port() const { return *port_; }
  const std::shared_ptr<const MotionPort>& shared_port() const { return port_; }
  std::size_t size() const { return residual_.size(); }

  // Of the last evaluation:
  const std::vector<double>& residual() const { return residual_; }
  /// Minus the derivative of the tip by an unknown.
  Eigen::Map<const Eigen::Vector3d> minus_tip_slope(std::size_t unknown) const {
    return Eigen::Map<const Eigen::Vector3d>(work_.columns.data() + 4 * unknown + 1);
  }
  const MemberWork& work() const { return work_; }
  /// Force that every mass point takes, axes of the base section.
  const std::vector<Vec2>& point_forces() const { return forces_; }

  const std::vector<Vec2>& drawn_places() const { return drawn_; }
  /// What damping by the rate of the elastic forces takes; 0 without.
  double elastic_damping_power(const double* v, double stiffness_damping) const;

  // Of the last linearization:
  const std::vector<double>& stiffness() const { return work_.tangent; }
  const std::vector<double>& elastic() const { return elastic_; }  ///< empty if not asked for
  const std::vector<double>& mass() const { return mass_; }
  const Coupling& stiffness_coupling() const { return stiffness_coupling_; }
  const Coupling& mass_coupling() const { return mass_coupling_; }
  const Outer& outer_stiffness() const { return outer_stiffness_; }
  const Outer& outer_mass() const { return outer_mass_; }

 private:
  void add_stiffness_damping(const double* y, const double* v, double factor);
  void move_point(std::size_t g, const BaseMotion& base, double mass_damping, MemberForces& sum);

  std::shared_ptr<const MotionPort> port_;
  bool linearised_;
  MemberWork work_;
  std::vector<Vec2> drawn_;  // places of the drawn state
  std::vector<Vec2> forces_;
  std::vector<double> residual_;
  std::vector<double> elastic_rate_;  // for damping
  std::vector<double> elastic_;
  std::vector<double> mass_;
  Coupling stiffness_coupling_;
  Coupling mass_coupling_;
  Outer outer_stiffness_;
  Outer outer_mass_;
};

}  // namespace flexura

#pragma once

#include <vector>

#include "flexura/assembly/motion_system.hpp"

namespace flexura {

/// A mechanism's equations between two moments such that energy and momenta are kept to rounding:
/// forces are differences of potentials over differences of coordinates (discrete derivatives).
/// With the complex numbers of the plane, a turn from psi0 to psi1 is counted by
/// tau = 2 tan((psi1 - psi0)/2), for which exactly
///     e1 - e0 = i tau (e0 + e1)/2,      e = exp(i psi),
/// so a place z = X + e rho moves by
///     dz = dX + tau i mean(e rho) + (1 + tau^2/4) mean(e) d(rho),
/// and turning everything by one (dX = i mean(X), tau = 1, d(rho) = 0) moves all places by
/// i mean(z): angular momentum is kept. d(rho) of internal unknowns y is Gonzalez' derivative (J.
/// Nonlinear Sci. 6, 1996), the slope at the middle corrected along d(y).
/// A linearised mechanism moves by the midpoint rule, which does all this.
class DiscreteMotion {
 public:
  explicit DiscreteMotion(MotionSystem& system);

  /// Places of all mass points, of flexures and bodies, and their inertias.
  void place(const Eigen::VectorXd& q, std::vector<Vec2>& places);
  const std::vector<double>& inertias() const { return inertias_; }
  /// Their velocities, by coordinates and rates.
  void velocities(const Moment& moment, std::vector<Vec2>& velocities);

  /// Residual of the step between two moments, during which the velocities of the mass points
  /// change by `change`. Multipliers are those of `to`: the loads on tips in axes that turned half
  /// as far as the base section does. Constraints are those at `to`.
  void residual(const Moment& from, const Moment& to, const std::vector<Vec2>& change,
                Eigen::VectorXd& r);

  /// Kinetic energy and momenta at places with velocities.
  struct Momenta {
    double kinetic = 0.0;
    Vec2 linear;
    double angular = 0.0;  ///< about the origin
  };
  Momenta momenta(const std::vector<Vec2>& places, const std::vector<Vec2>& velocities) const;
  /// Work of all loads that are not dead, and what damping takes, over the step of the last
  /// residual.
  double work() const { return work_; }
  double dissipated() const { return dissipated_; }
  MotionSystem& system() { return system_; }

 private:
  /// A rotation between two moments.
  struct Turn {
    double from = 0.0;
    double to = 0.0;
    double tangent = 0.0;  ///< tau
    double ratio = 1.0;    ///< (to - from)/tau
    Vec2 mean;             ///< of the two directions, as a complex number
  };
  struct Frame {
    Vec2 start_from, start_to;  // base end
    Turn turn;                  // of the base section
    Turn body;                  // of the base body
  };
  Turn turn_of(int unknown, const Moment& from, const Moment& to) const;
  void add_member(std::size_t member, const Moment& from, const Moment& to, double h,
                  const Vec2* change, Eigen::VectorXd& r);
  void add_places(std::size_t member, const Frame& frame, const Moment& from, const Moment& to,
                  double h, const Vec2* change, Eigen::VectorXd& r);
  void add_closure(std::size_t member, const Frame& frame, const Moment& from, const Moment& to,
                   Eigen::VectorXd& r);
  void add_bodies(const Moment& from, const Moment& to, double h, const Vec2* change,
                  Eigen::VectorXd& r);
  void add_springs(const Moment& from, const Moment& to, double h, Eigen::VectorXd& r);
  void add_loads(const Moment& from, const Moment& to, Eigen::VectorXd& r);
  void add_prescribed(const Moment& from, const Moment& to, Eigen::VectorXd& r);
  void add_joints(const Moment& from, const Moment& to, Eigen::VectorXd& r);
  /// Adds a force, on the place at an arm from a body's centre, to the body's rows.
  void push(std::size_t body, Vec2 arm, Vec2 force, const Moment& from, const Moment& to,
            Eigen::VectorXd& r) const;

  MotionSystem& system_;
  std::vector<double> inertias_;
  std::vector<std::size_t> first_point_;  // of every member, then of the bodies
  struct Ends {
    MemberWork from, middle, to;
    MotionPort::Answer answer_from, answer_middle, answer_to;
    std::vector<double> y_middle, change, residual;
  };
  std::vector<Ends> ends_;
  double work_ = 0.0;
  double dissipated_ = 0.0;
};

}  // namespace flexura

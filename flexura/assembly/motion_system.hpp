#pragma once

#include <Eigen/Dense>
#include <array>
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "flexura/assembly/joint.hpp"
#include "flexura/assembly/member_motion.hpp"
#include "flexura/assembly/motion_factor.hpp"
#include "flexura/assembly/numbering.hpp"
#include "flexura/assembly/system_layout.hpp"
#include "flexura/core/time_history.hpp"

namespace flexura {

/// Whether a load has a potential: it does not turn with its body, and is there from the start on.
inline bool is_dead(const SystemLayout::Load& load, const TimeHistory& history) {
  return !load.follower && is_constant(history);
}

/// How a mechanism is put together to move in time. Of `mechanism`, the members' ports are not used
/// (theirs are `ports`), nor what is said to be constant or to grow: every load and everything
/// prescribed is its value times its history.
struct MotionLayout {
  SystemLayout mechanism;
  std::vector<std::shared_ptr<const MotionPort>> ports;  ///< of the members
  std::vector<TimeHistory> loads;                        ///< of mechanism.loads
  std::vector<TimeHistory> prescribed;                   ///< of mechanism.prescribed
  Vec2 gravity;                                          ///< acceleration of all mass
  double mass_damping = 0.0;
  double stiffness_damping = 0.0;

  /// Against the rate of a spring's length: its damper's, and its share of Rayleigh's damping.
  double damping_along(const SystemLayout::Spring& spring) const {
    return spring.damping + stiffness_damping * spring.stiffness;
  }
};

/// A state of motion: coordinates q with first and second rates v and a, and the multipliers.
struct Moment {
  double time = 0.0;
  Eigen::VectorXd q, v, a;
  Eigen::VectorXd multipliers;
};

/// Energies and momenta at a moment. `dead_work`: what gravity and the loads without history have
/// done since the drawn state.
struct MotionEnergies {
  double kinetic = 0.0;
  double strain = 0.0;
  double dead_work = 0.0;
  Vec2 momentum;
  double angular_momentum = 0.0;  ///< about the origin
};

/// Damping of one mode: a force damping (momentum . v) against `momentum` = M shape.
struct ModalForce {
  Eigen::VectorXd momentum;
  double damping = 0.0;
};

/// Power of all loads that are not dead and of what is prescribed, and what damping takes.
struct MotionPower {
  double loads = 0.0;
  double damping = 0.0;
};

/// A mechanism in motion: Lagrange's equations, with forces between its parts as multipliers,
///     M(q) a + h(q, v) + C v + dPi/dq = 0,   dPi/d(multipliers) = 0.
/// Coordinates are displacements and rotations of the bodies (and rotations of pinned ends), then
/// every flexure's internal unknowns. Multipliers are the reactions of what is prescribed, two
/// forces per joint, and the loads on the flexures' tips (force x, y, moment, in axes of the base
/// section), whose equations close the flexures.
/// Evaluations keep what they found until the next one: one system per thread.
class MotionSystem {
 public:
  explicit MotionSystem(MotionLayout layout);

  Eigen::Index coordinates() const { return coordinates_; }
  Eigen::Index multipliers() const { return multipliers_; }
  /// Those of the coordinates that are the bodies' and the pinned ends': all that rigid motions
  /// need.
  Eigen::Index moving() const { return moving_; }
  Eigen::Index size() const { return coordinates_ + multipliers_; }
  /// At rest as drawn.
  Moment drawn_moment() const;

  /// Residual of the equations, coordinates first, into `r`.
  void residual(const Moment& moment, Eigen::VectorXd& r);
  /// Stiffness, damping and mass at the moment of the last residual, by blocks. (Terms with the
  /// first power of the rates are left out: they are small where steps resolve the motion.)
  void linearize(const Moment& moment);
  /// Of stiffness + mass * M + damping * C at the last linearization; false where it is singular.
  template <class T>
  bool factorize(T mass, T damping, MotionFactor<T>& factor) const;
  /// Negative eigenvalues of a factorized matrix among the motions that the constraints allow; none
  /// where it is singular.
  std::optional<int> negative(const MotionFactor<double>& factor) const;
  /// In place, coordinates first.
  template <class T>
  void solve(const MotionFactor<T>& factor, VectorX<T>& b) const;
  /// The matrices of the last linearization in full: K with the constraints bordered, and M.
  void dense(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& mass) const;
  /// M x at the last linearization.
  Eigen::VectorXd multiply_mass(const Eigen::VectorXd& x) const;
  /// Rates of the constraints (the equations of the multipliers) at the moment of the last
  /// residual: zero where v keeps them.
  Eigen::VectorXd constraint_rates(const Moment& moment) const;

  /// The largest change among displacements (in mean flexure lengths), rotations and internal
  /// unknowns.
  double size_of(const Eigen::Ref<const Eigen::VectorXd>& change) const;
  /// Scale of that: displacements in lengths, all else 1.
  const Eigen::VectorXd& weights() const { return weights_; }

  MotionEnergies energies(const Moment& moment);
  MotionPower power(const Moment& moment);
  /// Whether that is ever more than zero.
  bool has_power() const;
  /// The largest gap of a joint, a flexure's end or what is prescribed, at the last residual.
  double largest_gap(const Eigen::VectorXd& r) const;
  /// The same in mean flexure lengths.
  double relative_gap(const Eigen::VectorXd& r) const { return largest_gap(r) / length_; }

  Pose pose(std::size_t body, const Eigen::VectorXd& q) const;
  Vec2 moved_point(std::size_t body, Vec2 drawn, const Eigen::VectorXd& q) const;
  Pose base_section(std::size_t member, const Eigen::VectorXd& q) const;
  const double* internal(std::size_t member, const Eigen::VectorXd& q) const {
    return q.data() + internal_[member];
  }
  Eigen::Vector3d member_load(std::size_t member, const Eigen::VectorXd& multipliers) const {
    return multipliers.segment<3>(load_row(member));
  }
  /// Force (or moment) that holds the i-th prescribed displacement (or rotation).
  double prescribed_reaction(std::size_t i, const Eigen::VectorXd& multipliers) const {
    return multipliers[static_cast<Eigen::Index>(i)];
  }
  std::size_t member_count() const { return members_.size(); }
  const MotionPort& port(std::size_t member) const { return members_[member].port(); }
  /// Rows of the multipliers that belong to a joint and to the load on a member's tip.
  Eigen::Index joint_row(std::size_t joint) const {
    return static_cast<Eigen::Index>(prescribed_count() + 2 * joint);
  }
  Eigen::Index load_row(std::size_t member) const {
    return joint_row(layout_.mechanism.joints.size()) + static_cast<Eigen::Index>(3 * member);
  }
  /// Place in q of a member's first internal unknown.
  Eigen::Index first_internal(std::size_t member) const { return internal_[member]; }
  /// Where the member's action body asks its tip to be.
  RelativePose relative_pose_at(std::size_t member, const Eigen::VectorXd& q) const {
    return relative_pose_of(member, q, Eigen::Vector3d::Zero());
  }
  /// Velocities of a member's mass points, at the moment of the last residual.
  void member_velocities(std::size_t member, const Moment& moment, Vec2* velocities) const;
  const MotionLayout& layout() const { return layout_; }
  const Numbering& numbering() const { return numbering_; }
  bool linearised() const { return layout_.mechanism.linearised; }
  double mean_length() const { return length_; }

  /// Against the velocity of all mass, and the rate of the flexures' elastic forces.
  void set_rayleigh_damping(double mass, double stiffness) {
    layout_.mass_damping = mass;
    layout_.stiffness_damping = stiffness;
  }
  /// Forces that damp modes; not among the damping of `factorize`, to which they are small.
  void set_modal_damping(std::vector<ModalForce> damping) { modal_damping_ = std::move(damping); }
  const std::vector<ModalForce>& modal_damping() const { return modal_damping_; }

  /// Replaces the histories of all loads by the given one: how they act in a study without time.
  void set_load_history(const TimeHistory& history);

  /// The same mechanism with every flexure refined, null where nothing can be, and the moment that
  /// corresponds (accelerations are not carried over).
  std::unique_ptr<MotionSystem> refined() const;
  Moment prolong(const Moment& moment, const MotionSystem& refined) const;

 private:
  struct BodyMotion {
    Pose pose;
    Vec2 velocity;
    Vec2 acceleration;
    double spin = 0.0;
    double spin_rate = 0.0;
  };
  /// A flexure between its bodies at the last residual.
  struct Placed {
    RelativePose relative;
    Vec2 arm;           // of the base end, in the plane
    double turn = 0.0;  // of the base section
    Vec2 force;         // on the base section, in the plane
    double torque = 0.0;
  };

  std::size_t prescribed_count() const { return layout_.mechanism.prescribed.size(); }
  void set_scale();
  BodyMotion body_motion(std::size_t body, const Moment& moment) const;
  RelativePose relative_pose_of(std::size_t member, const Eigen::VectorXd& q,
                                const Eigen::Vector3d& load) const;
  std::array<Jet2<6>, 2> gaps_of(std::size_t joint, const Eigen::VectorXd& q) const;
  std::array<int, 6> pair_unknowns(std::size_t base, std::size_t action) const;
  BaseMotion base_motion(std::size_t member, const Moment& moment, Placed& placed) const;

  MemberForces evaluate_member(std::size_t member, const Moment& moment);
  void add_member(std::size_t member, const Moment& moment, Eigen::VectorXd& r);
  void add_body(std::size_t body, const Moment& moment, Eigen::VectorXd& r) const;
  void add_springs(const Moment& moment, Eigen::VectorXd& r) const;
  void add_loads(const Moment& moment, Eigen::VectorXd& r) const;
  void add_prescribed(const Moment& moment, Eigen::VectorXd& r) const;
  void add_joints(const Moment& moment, Eigen::VectorXd& r) const;
  struct PrescribedPlace {
    int unknowns[2];  // its displacement's own unknown and the body's rotation, -1 where held
    double slopes[2];
    double displacement = 0.0;
    double curvature = 0.0;  // second derivative by the rotation
  };
  PrescribedPlace prescribed_place(std::size_t i, const Eigen::VectorXd& q) const;

  double dead_work_on(std::size_t member, const Eigen::VectorXd& q) const;
  void add_dead_loads(const Moment& moment, MotionEnergies& sum) const;
  void add_load_power(const Moment& moment, MotionPower& power) const;
  void linearize_pairs(const Moment& moment);
  void linearize_rest(const Moment& moment);
  template <class T>
  void add_member_matrix(std::size_t member, T mass, T elastic, MotionFactor<T>& factor) const;
  /// Outer unknowns of a flexure by the reduced ones: rows of the load, base end and base section.
  struct OuterMap {
    std::array<int, 7> columns;  // load (3), base x, y, turn, section; -1 where held
    Eigen::Matrix<double, MemberMotion::outer, 7> matrix;
  };
  OuterMap outer_map(std::size_t member) const;

  MotionLayout layout_;
  Numbering numbering_;
  std::vector<MemberMotion> members_;
  std::vector<Eigen::Index> internal_;  // first internal unknown of a member, in q
  std::vector<RelativePose> drawn_;     // at the drawn state, for linearised kinematics
  Eigen::Index moving_ = 0;
  Eigen::Index coordinates_ = 0;
  Eigen::Index multipliers_ = 0;
  double length_ = 1.0;
  Eigen::VectorXd scale_;        // symmetric scaling of moving unknowns and multipliers
  Eigen::VectorXd weights_;      // of coordinates in the size of a change
  Eigen::VectorXd gap_lengths_;  // of constraints: angles count at a mean flexure length

  std::vector<ModalForce> modal_damping_;
  std::vector<Placed> placed_;
  // Of the last linearization, moving unknowns and multipliers:
  Eigen::MatrixXd stiffness_;
  Eigen::MatrixXd damping_;
  Eigen::VectorXd mass_;  // of bodies, diagonal
};

}  // namespace flexura

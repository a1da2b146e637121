#pragma once

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flexura/assembly/joint.hpp"
#include "flexura/assembly/numbering.hpp"
#include "flexura/assembly/port_kinematics.hpp"
#include "flexura/assembly/system_layout.hpp"
#include "flexura/core/jet2.hpp"
#include "flexura/core/symmetric_factor.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// A mechanism as unknowns, equilibrium equations and their tangent. The unknowns z are the
/// displacements and rotations of the bodies (and rotations of pinned ends), the reaction of
/// everything prescribed, the two forces of every joint, the load (force x, force y, moment, in
/// axes of the base section) of every flexure, and each flexure's internal unknowns; equilibrium is
/// a stationary point of the potential
///     sum_k [ W_k(y_k, load_k) + load_k . relative_pose_k(q) ] - load_factor * (work of loads)
///         - sum_i reaction_i (displacement_i(q) - load_factor * value_i) - sum_j force_j .
///         gap_j(q).
/// Internal unknowns are eliminated flexure by flexure, and so is the load of every flexure whose
/// flexibility is regular; the load of one that cannot stretch, say, stays. What remains is one
/// symmetric matrix, whose inertia tells stability. Follower loads make it unsymmetric.
class System {
 public:
  /// A point fixed to a body.
  struct Place {
    std::size_t body = 0;
    Vec2 drawn;
  };

  explicit System(SystemLayout layout);
  System(System&&) = default;

  /// Number of all unknowns, internal ones included.
  std::size_t size() const { return size_; }
  /// Likewise, but for those that only serve the iteration.
  std::size_t modeled_size() const;
  /// The unknowns of the undeformed, unloaded mechanism: zeros.
  std::vector<double> initial_state() const { return std::vector<double>(size_, 0.0); }

  /// While the mechanism is being assembled, the share of that.
  void set_load_factor(double load_factor) {
    (assembling_ ? assembly_ : load_factor_) = load_factor;
  }
  double load_factor() const { return assembling_ ? assembly_ : load_factor_; }
  /// Whether something acts before the loads grow: flexures or springs that do not fit as drawn,
  /// constant loads.
  bool needs_assembly() const;
  /// From the drawn state, the mechanism is assembled in proportion to the load factor, and what
  /// grows is absent and what is prescribed held. Afterwards, and by default, assembly is whole
  /// and the load factor that of the loads.
  void set_assembling(bool assembling);
  /// Puts a body that does not move by itself at a pose.
  void hold(std::size_t body, const Pose& pose) { held_[body] = pose; }
  /// The load factor and held poses of another system of the same mechanism.
  void hold_as(const System& other) {
    held_ = other.held_;
    load_factor_ = other.load_factor_;
    assembly_ = other.assembly_;
    assembling_ = other.assembling_;
  }

  /// Evaluates residual and tangent at z and factorizes. False where a pivot is exactly zero or a
  /// number is not finite.
  bool linearize(const std::vector<double>& z);
  /// Newton step of the last linearization; returns its size: the largest change of a displacement
  /// (in mean flexure lengths), rotation or internal unknown.
  double newton_step(std::vector<double>& step) const;
  /// dz / d(load factor) of the last linearization.
  void load_direction(std::vector<double>& direction) const;

  /// The direction of least resistance at the last linearization: at a critical state, its null
  /// vector. Unit length by `inner`.
  void critical_direction(std::vector<double>& direction) const;
  /// As many, across one another: where several give way at once.
  std::vector<std::vector<double>> critical_directions(int count) const;

  /// Second derivatives of the potential by all unknowns at z, none eliminated. Precondition: no
  /// follower loads.
  Eigen::MatrixXd hessian(const std::vector<double>& z);
  /// Changes of the unknowns that are alike in size: rotations and internal unknowns by one,
  /// displacements by a mean flexure length, loads by those that bend a flexure by a radian.
  Eigen::VectorXd unknown_scale() const;

  /// Scalar product of changes of z: displacements in mean flexure lengths, rotations in radians,
  /// and the mean over each flexure's internal unknowns, as a flexure may give way by itself.
  double inner(const std::vector<double>& a, const std::vector<double>& b) const;
  /// Largest change of a displacement or rotation of a body between two states, likewise.
  double distance(const std::vector<double>& a, const std::vector<double>& b) const;
  /// Largest rotation of a flexure's end sections against each other, beyond their rest.
  double largest_turn(const std::vector<double>& z) const;

  // Of the last linearization:
  /// Negative eigenvalues of the tangent on displacements that keep the flexures closed and what is
  /// prescribed where it is: 0 is stable. With follower loads only its parity is known (0 or 1).
  int unstable_directions() const;
  double strain_energy() const { return strain_energy_; }
  /// The strain energy less the work of what does not grow with the load factor, and of the
  /// reactions on what is prescribed: its change along a path is the load factor times that of
  /// `load_displacement`.
  double stored_energy(const std::vector<double>& z) const;
  /// Whether the mechanism can move without resistance, to rounding. Meant for the unloaded state:
  /// under load a flexure alone may be critical while the mechanism is not.
  bool is_singular() const;
  /// The moving body that the softest direction of the tangent moves most; absent where that
  /// direction moves none, but shifts loads between flexures that cannot stretch.
  std::optional<std::size_t> softest_body() const;

  Pose pose(std::size_t body, const std::vector<double>& z) const;
  /// Where a point of the body, given as drawn, has gone.
  Vec2 moved_point(std::size_t body, Vec2 drawn, const std::vector<double>& z) const;
  /// Pose of the base section of a member: origin and axes of its sections.
  Pose base_section(std::size_t member, const std::vector<double>& z) const;
  /// What the member's flexure feels at z and the load factor.
  Surroundings surroundings(std::size_t member, const std::vector<double>& z) const;
  Eigen::Vector3d member_load(std::size_t member, const std::vector<double>& z) const;
  std::span<const double> internal(std::size_t member, const std::vector<double>& z) const;
  /// Force (or moment) that holds the i-th prescribed displacement (or rotation).
  double prescribed_reaction(std::size_t i, const std::vector<double>& z) const {
    return z[reaction_index(i)];
  }
  /// Its place in z.
  std::size_t reaction_index(std::size_t i) const { return moving_ + i; }
  /// What a joint exerts on its action body: a force x, y, or a force across its direction and a
  /// moment.
  Vec2 joint_force(std::size_t i, const std::vector<double>& z) const {
    return {z[joint_index(i)], z[joint_index(i) + 1]};
  }
  /// Sum of dead loads' forces times the displacements of their points, less that of prescribed
  /// values times their reactions, at load factor 1: minus the derivative of the potential by the
  /// load factor. While assembling, of what assembly brings.
  double load_displacement(const std::vector<double>& z) const;
  /// The loads' work per load factor along a change of z, of the last linearization.
  double load_rate(const std::vector<double>& direction) const;
  bool has_follower_loads() const { return follower_; }
  /// Displacement (x, y, rotation) of a body's centre per load (force x, y, moment) there, about
  /// the last linearization; zero for a body that is held.
  Eigen::Matrix3d body_compliance(std::size_t body) const;
  /// Displacements (x, y, rotation) of points fixed to bodies, three rows per place, per load
  /// (force x, y, moment) at each of them, three columns per place, about the last linearization
  /// at z, with whatever is prescribed let go under its reaction. Empty where that is singular.
  Eigen::MatrixXd place_compliance(std::span<const Place> places,
                                   const std::vector<double>& z) const;
  /// Force x, y and moment about its centre that a body needs to stay at its pose.
  Eigen::Vector3d reaction(std::size_t body, const std::vector<double>& z) const;
  double mean_length() const { return length_; }
  /// Place in z of the first internal unknown of a flexure.
  std::size_t first_internal() const { return primary_ + 3 * members_.size(); }
  /// The linearised system moves points by u + rotation x arm.
  bool linearised() const { return layout_.linearised; }

  const SystemLayout& layout() const { return layout_; }
  /// The same mechanism with every flexure refined, and the state that corresponds to z; null
  /// where no flexure has anything to refine.
  std::unique_ptr<System> refined() const;
  std::vector<double> prolong(const std::vector<double>& z, const System& refined) const;

 private:
  using BodyIndex = Numbering::Body;
  struct MemberIndex {
    std::array<int, port_unknowns> unknowns;  // indices into z, -1 where held
    std::size_t load = 0;                     // into z
    std::size_t internal = 0;                 // into z
    std::size_t scratch = 0;
    double force_scale = 1.0;   // sqrt(EI/L)/L
    double moment_scale = 1.0;  // sqrt(EI/L)
  };
  // One member at the last linearization.
  struct MemberTangent {
    RelativePose::Jacobian jacobian;
    Eigen::Vector3d gap;        // relative pose less tip: what is left to close
    Eigen::Matrix3d stiffness;  // inverse of the flexibility, where that is regular
    FieldResponse field;        // where the flexure feels its surroundings
    int kept = -1;              // row of the load in the reduced matrix, -1 where eliminated
  };

  void number_unknowns();
  void gather(std::size_t member, const std::vector<double>& z, double (&q)[port_unknowns]) const;
  RelativePose relative_pose_of(std::size_t member, const std::vector<double>& z) const;
  void set_scale();
  bool add_member(std::size_t member, const std::vector<double>& z);
  TipResponse respond(std::size_t member, const std::vector<double>& z);
  void add_field_rate(std::size_t member);
  void keep_load(std::size_t member, const Eigen::Matrix3d& flexibility);
  void add_load(const SystemLayout::Load& load, const std::vector<double>& z);
  void add_prescribed(std::size_t i, const std::vector<double>& z);
  std::size_t joint_index(std::size_t i) const {
    return moving_ + layout_.prescribed.size() + 2 * i;
  }
  std::array<Jet2<6>, 2> gaps_of(std::size_t joint, const std::vector<double>& z) const;
  void add_joint(std::size_t i, const std::vector<double>& z);
  void add_misfit_rate(std::size_t member, const std::vector<double>& z, const RelativePose& pose);
  /// The tip's velocity against the closing body while the load factor grows, in base axes.
  Eigen::Vector3d misfit_rate(std::size_t member, const std::vector<double>& z,
                              const RelativePose& pose) const;
  bool has_misfit(std::size_t member) const;
  bool grows(const SystemLayout::Load& load) const { return load.constant == assembling_; }
  bool fields_grow() const { return layout_.constant_fields == assembling_; }
  double dead_work(bool growing, const std::vector<double>& z) const;
  void add_spring(const SystemLayout::Spring& spring, const std::vector<double>& z);
  Jet2<6> spring_length(const SystemLayout::Spring& spring, const std::vector<double>& z) const;
  Jet2<6> spring_potential(const SystemLayout::Spring& spring, const std::vector<double>& z) const;
  Eigen::Vector3d spring_reaction(std::size_t body, const std::vector<double>& z) const;
  Eigen::Vector3d joint_reaction(std::size_t body, const std::vector<double>& z) const;
  bool factorize();
  void solve_factored(Eigen::VectorXd& b) const;
  void solve_scaled(Eigen::VectorXd& b) const;
  /// What else an eliminated unknown follows, besides the reduced ones.
  enum class Along { nothing, residual, load };
  void expand(const Eigen::VectorXd& reduced, Along along, std::vector<double>& step) const;

  SystemLayout layout_;
  std::vector<BodyIndex> bodies_;
  std::vector<MemberIndex> members_;
  std::vector<Pose> held_;
  std::vector<RelativePose> drawn_;  // at the undeformed state, for linearised kinematics
  std::size_t moving_ = 0;           // unknowns of bodies and pinned ends
  std::size_t primary_ = 0;          // and reactions of what is prescribed, and of joints
  std::size_t size_ = 0;
  double load_factor_ = 0.0;
  double assembly_ = 1.0;  // share of it
  bool assembling_ = false;
  bool follower_ = false;

  double length_ = 1.0;          // mean length of the flexures
  double turn_scale_ = 1.0;      // of rotations in it
  Eigen::VectorXd scale_;        // symmetric scaling of the reduced unknowns
  Eigen::VectorXd step_weight_;  // of bodies' unknowns in the size of a Newton step
  std::vector<MemberTangent> tangents_;
  Eigen::Index reduced_ = 0;  // bodies' unknowns, reactions, joints, then kept loads
  Eigen::MatrixXd tangent_;   // its leading reduced_ rows and columns are in use
  Eigen::VectorXd residual_;
  Eigen::VectorXd load_vector_;  // of all loads at full load factor, at the last z
  std::vector<double> scratch_;
  SymmetricFactor factor_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd lu_balance_;
  int eliminated_negative_ = 0;  // negative pivots of all that was eliminated
  double strain_energy_ = 0.0;
  double misfit_rate_ = 0.0;         // of `load_displacement` by the load factor alone
  double field_displacement_ = 0.0;  // of dead loads along flexures, per load factor
  bool feels_surroundings_ = false;
  double pivot_ratio_ = 0.0;
  mutable Eigen::VectorXd work_;
};

}  // namespace flexura

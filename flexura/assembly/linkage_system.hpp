#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "flexura/assembly/elastic_link.hpp"
#include "flexura/assembly/rigid_linkage.hpp"
#include "flexura/core/time_history.hpp"

namespace flexura {

/// A linkage of elastic links upon its rigid motion. Unknowns U are displacements from where rigid
/// links take bodies and pinned ends, along fixed axes, and rotations; then what is inside links.
struct LinkageLayout {
  /// A place on a body: the body's unknowns (x, y, rotation; -1 where held), its centre and the
  /// place as drawn, and the rigid part they belong to.
  struct Place {
    std::size_t part = 0;
    std::array<int, 3> unknowns = {-1, -1, -1};
    Vec2 centre;
    Vec2 at;
  };
  struct Member {
    ElasticLink link;
    std::size_t part = 0;
    std::vector<int> unknowns;  ///< of U for each of the link's own, -1 where held
  };
  struct Mass {
    Place centre;
    double mass = 0.0;
    double inertia = 0.0;
  };
  struct Pin {
    Place first, second;
  };
  struct Slide {
    Place base, action;
    Vec2 direction;  ///< as drawn
  };
  struct Load {
    Place place;
    Vec2 force;
    double moment = 0.0;
    bool follower = false;
    TimeHistory history;  ///< over the angle of the drive
  };

  RigidLinkageLayout rigid;
  std::vector<Member> members;
  std::vector<Mass> masses;
  std::vector<Pin> pins;  ///< that need an equation
  std::vector<Slide> slides;
  std::vector<Load> loads;
  Vec2 gravity;  ///< acceleration of all mass
  int unknowns = 0;
};

/// The drive's rate over its mean, g = (d angle/dt)/w, at an angle, and dg/d(angle).
struct DriveRate {
  double rate = 1.0;
  double slope = 0.0;
};

/// At an angle of the drive, w its mean rate:
///     M U'' + (w C1 + C) U' + (K + w^2 K2) U = f + w^2 f2,
/// primes by time, C the damping that is chosen elsewhere.
struct LinkageMatrices {
  Eigen::MatrixXd mass;          ///< M
  Eigen::MatrixXd turning;       ///< C1: Coriolis' forces
  Eigen::MatrixXd carrying;      ///< K2: forces of inertia by displacements
  Eigen::MatrixXd stiffness;     ///< K, elastic
  Eigen::MatrixXd straining;     ///< times w: elastic forces of the rate that turning alone gives u
  Eigen::VectorXd inertia_load;  ///< f2: of the rigid links
  Eigen::VectorXd load;          ///< f
};

/// Elastic displacements q at one position, with their first and second derivatives by time.
struct ElasticState {
  Eigen::VectorXd q, first, second;
};

/// Kineto-elastodynamics: elastic displacements, linear, upon the motion of rigid links (Turcic and
/// Midha, ASME J. Dyn. Syst. Meas. Control 106, 1984, eqs. (1) to (14)). Constraints of joints are
/// eliminated: unknowns q are those of U that remain.
class LinkageSystem {
 public:
  explicit LinkageSystem(LinkageLayout layout);

  Eigen::Index size() const { return static_cast<Eigen::Index>(independent_.size()); }
  const RigidLinkage& rigid() const { return rigid_; }
  const LinkageLayout& layout() const { return layout_; }

  /// Without `coupling`, elastic displacements add to the forces of inertia by M U'' alone (their
  /// eq. (2)); with it by all that follows from the turning of the links (eq. (1)).
  LinkageMatrices matrices(const RigidState& state, const DriveRate& drive, bool coupling) const;
  /// Stress stiffening by the axial forces of a displacement (eq. (14)).
  Eigen::MatrixXd stress_stiffness(const RigidState& state, const Eigen::VectorXd& q) const;
  /// Whether a member has axial forces that stiffen it.
  bool stiffens() const;

  /// Unknowns of a member's link, in its own axes.
  Eigen::VectorXd member_unknowns(std::size_t member, const RigidState& state,
                                  const Eigen::VectorXd& q) const;
  /// Transverse forces of inertia per length at both ends of each of a member's elements.
  std::vector<Eigen::Vector2d> element_loads(std::size_t member, const RigidState& state,
                                             const DriveRate& drive, double speed,
                                             const ElasticState& elastic) const;
  /// Forces on the rigid parts of what they carry: of their inertia at a mean speed, less loads.
  struct PartForce {
    Vec2 force;
    double moment = 0.0;  ///< about the part's centre
  };
  std::vector<PartForce> inertia_forces(const RigidState& state, const DriveRate& drive,
                                        double speed) const;
  std::vector<PartForce> load_forces(const RigidState& state) const;
  /// By which a load is multiplied at an angle; histories begin anew with every turn.
  static double load_factor(const LinkageLayout::Load& load, double angle);
  /// Displacement (x, y, rotation) of a body's centre from its rigid motion.
  Eigen::Vector3d body_displacement(const LinkageLayout::Place& place, const RigidState& state,
                                    const Eigen::VectorXd& q) const;

 private:
  /// U = B q, and derivatives of B by the angle; empty where there are no constraints.
  struct Elimination {
    Eigen::MatrixXd b, first, second;
  };
  Elimination eliminate(const RigidState& state) const;
  struct Rows {
    Eigen::MatrixXd value, first, second;
  };
  Rows constraints(const RigidState& state) const;
  Eigen::VectorXd all_unknowns(const RigidState& state, const Eigen::VectorXd& q) const;
  /// A member's unknowns out of all, along fixed axes.
  Eigen::VectorXd gather(std::size_t member, const Eigen::VectorXd& all) const;
  /// Second derivative by time, in the link's axes, of a vector that is u there and moves with it.
  Eigen::VectorXd link_acceleration(std::size_t member, const RigidState& state,
                                    const DriveRate& drive, double speed,
                                    const ElasticState& elastic) const;
  void add_member(std::size_t member, const RigidState& state, const DriveRate& drive,
                  bool coupling, LinkageMatrices& sum) const;
  void add_mass(const LinkageLayout::Mass& mass, const RigidState& state, const DriveRate& drive,
                LinkageMatrices& sum) const;
  void add_load(const LinkageLayout::Load& load, const RigidState& state,
                LinkageMatrices& sum) const;

  LinkageLayout layout_;
  RigidLinkage rigid_;
  std::vector<LinkInertia> inertia_;
  std::vector<Eigen::MatrixXd> turning_;    // of members, in their own axes: mc - m G
  std::vector<Eigen::MatrixXd> carrying_;   // m P + 2 mc G + m
  std::vector<Eigen::MatrixXd> straining_;  // -k G
  std::vector<int> independent_, dependent_;
};

}  // namespace flexura

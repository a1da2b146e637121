#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexura/assembly/linkage_system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/solvers/periodic_oscillation.hpp"

namespace flexura {

/// A linkage over one turn of its drive: rigid motion and matrices at the angles asked for. Angles
/// are those that the drive has gone through, positive in either sense.
class LinkageTurn {
 public:
  /// `refined`: with finer flexures.
  LinkageTurn(const Model& model, const LinkageStudy& study, bool refined);

  /// Follows the rigid motion through these angles (any order, within one turn) as well as those
  /// before; false where the linkage cannot follow its drive.
  bool visit(std::vector<double> angles);
  const std::optional<RigidFailure>& failure() const { return failure_; }
  /// 1 counter-clockwise, -1 clockwise.
  double sense() const { return sense_; }

  /// Of an angle visited before.
  const RigidState& state(double angle) const { return at(angle).state; }
  DriveRate drive(double angle) const;
  const LinkageMatrices& matrices(double angle) const { return at(angle).matrices; }
  const LinkageSystem& system() const { return system_; }

  /// Displacements that the loads of inertia and all others would cause at rest.
  Eigen::VectorXd static_displacement(double angle, double speed) const;
  /// K with the geometric stiffness that the study asks for, of the quasi-static axial forces.
  Eigen::MatrixXd stiffness(double angle, double speed) const;
  /// The same, of the axial forces of displacements.
  Eigen::MatrixXd stiffness_of(double angle, const Eigen::VectorXd& displacement) const;
  /// Forces of damping by velocities, for a stiffness; nothing where that is not positive definite.
  std::optional<Eigen::MatrixXd> damping(double angle, const Eigen::MatrixXd& stiffness) const;
  /// Of the oscillation over the angle. Modes that damp are those of `damped`, which is the
  /// stiffness itself or, where links buckle at rest, the elastic one; throws Buckled where it is
  /// not positive definite.
  OscillationMatrices oscillation(double angle, double speed, const Eigen::MatrixXd& stiffness,
                                  const Eigen::MatrixXd& damped) const;
  struct Buckled {
    double angle = 0.0;
  };

  /// Ends of intervals: the study's positions, cut where loads jump or kink, and each into as many
  /// parts.
  std::vector<double> interval_ends(int parts) const;
  /// Those and the stages of Radau's rule between them.
  static std::vector<double> stage_angles(const std::vector<double>& ends, int stages);
  std::vector<double> positions() const;

 private:
  struct Visit {
    double angle = 0.0;
    RigidState state;
    LinkageMatrices matrices;
  };
  const Visit& at(double angle) const;

  const LinkageStudy& study_;
  double sense_;
  LinkageSystem system_;
  std::vector<Visit> visits_;  // by ascending angle
  std::optional<RigidFailure> failure_;
};

}  // namespace flexura

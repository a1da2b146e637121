#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "flexura/core/ldlt.hpp"
#include "flexura/core/stress_field.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// A flexure's section in axes fixed to its base body (parallel to the global axes as drawn,
/// origin at the base end): its pose, rotation since the start, and the forces it carries.
struct SectionState {
  Pose pose;
  double axial_force = 0.0;
  double shear_force = 0.0;
  double bending_moment = 0.0;
};

/// What a flexure, held at its base and loaded at its tip by (force x, force y, moment), answers
/// once its internal unknowns are eliminated: to first order in a change of the load,
/// tip = tip + flexibility * d(load). Everything in axes fixed to the base body.
struct TipResponse {
  Eigen::Vector3d tip;  ///< x, y from the base end, rotation since the start
  Eigen::Matrix3d flexibility;
  double strain_energy = 0.0;
  int negative = 0;  ///< negative eigenvalues of the internal tangent at constant load
  bool singular = false;
};

/// What a flexure feels besides the load on its tip. Dead loads along it and temperature grow with
/// the load factor; dead loads keep their direction while its base section turns.
struct Surroundings {
  double turn = 0.0;  ///< of the base section since the start
  double load_factor = 0.0;
  bool linearised = false;  ///< small displacements: `turn` to first order
};

/// The rest of what a flexure answers that feels its surroundings, internal unknowns eliminated:
/// the first derivatives of W by turn and load factor, and its second ones, W_load,turn being minus
/// d(tip)/d(turn).
struct FieldResponse {
  double by_turn = 0.0;
  double by_factor = 0.0;
  Eigen::Vector3d tip_by_turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d tip_by_factor = Eigen::Vector3d::Zero();
  double turn_turn = 0.0;
  double turn_factor = 0.0;
};

/// How a modeling stores energy in one flexure. The flexure is a cantilever held by its base body;
/// the load its action body puts on the tip is an unknown of the mechanism, and closing the tip
/// onto the action body is that unknown's equation. So compliances may vanish (inextensible,
/// unshearable, rigid) and every modeling is the same to the assembly.
///
/// With W(y, load) = energy(y) - load . tip, the internal unknowns y (dimensionless, of order one)
/// satisfy dW/dy = 0. All calls are const; the caller owns the scratch, so threads share the port.
class TwoPort {
 public:
  virtual ~TwoPort() = default;

  /// Number m of internal unknowns; they start at zero.
  virtual std::size_t internal_size() const = 0;
  /// How many of them count as unknowns of the modeling: all but those that serve the iteration.
  virtual std::size_t nodal_size() const { return internal_size(); }
  /// Doubles of scratch that `linearize` needs, 4 m or more unless `advance` is the port's own.
  virtual std::size_t scratch_size() const = 0;

  /// Evaluates at (load, internal) and eliminates the internal unknowns. The first 4 m doubles of
  /// scratch then hold, row by row, (u, Z) with Z m x 3: their Newton step is
  /// d(internal) = -u - Z d(load). Does not allocate.
  virtual TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                                double* scratch) const = 0;
  /// From that scratch, the change of the internal unknowns while the load changes: -Z d(load), and
  /// `residual` times -u.
  virtual void advance(const double* scratch, double residual, const Eigen::Vector3d& load,
                       double* step) const;

  /// Whether the flexure carries loads along its length, or its temperature changes.
  virtual bool feels_surroundings() const { return false; }
  /// `linearize` where it does. The second 4 m doubles of scratch then hold, row by row, the
  /// columns of Z by turn and load factor, and two that are not used. `by_factor` is the partial
  /// derivative at the internal unknowns given.
  virtual TipResponse linearize_in(const Surroundings& /*surroundings*/,
                                   const Eigen::Vector3d& load, const double* internal,
                                   double* scratch, FieldResponse& /*field*/) const {
    return linearize(load, internal, scratch);
  }

  /// Second derivatives of W by (internal, load), m + 3 of each, where nothing is eliminated.
  virtual Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const = 0;

  /// Stations for results: evenly spaced in arc length from 0 to the length, both included, odd in
  /// number.
  virtual std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                             std::span<const double> internal) const = 0;
  /// The same where the flexure feels its surroundings.
  virtual std::vector<SectionState> sections_in(const Surroundings& /*surroundings*/,
                                                const Eigen::Vector3d& load,
                                                std::span<const double> internal) const {
    return sections(load, internal);
  }

  /// Polyline to draw of the flexure in a state, given its `sections`: by default through them.
  virtual std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                                       std::span<const double> internal) const;

  /// Stresses in the plane where the modeling has them, in axes fixed to the base body, places from
  /// the base end.
  virtual std::optional<StressField> stress_field(std::span<const double> /*internal*/) const {
    return std::nullopt;
  }

  /// The same flexure discretized more finely, null where there is nothing to refine.
  virtual std::shared_ptr<const TwoPort> refined() const { return nullptr; }
  /// Internal unknowns of `refined()` that describe the same state.
  virtual void prolong(std::span<const double> internal, std::span<double> refined) const;
  /// The error of this discretization as a multiple of its distance from `refined()`: 1 where
  /// convergence is geometric, 1/(1 - 2^-order) for a halved mesh.
  virtual double error_ratio() const { return 1.0; }
};

/// What the eliminated unknowns add to tip and flexibility: `coupling` holds W_y and W_y,load of
/// each of the m unknowns, `solved` the same times the inverse of W_yy.
void add_eliminated(std::size_t m, const double* coupling, const double* solved,
                    TipResponse& response);

/// Likewise for the derivatives by turn and load factor: `field_coupling` holds W_y,turn and
/// W_y,factor (and two zeros) of each unknown, `field_solved` the same times the inverse of W_yy.
/// `field` holds the partial derivatives of W on entry, those by turn and factor of minus the tip.
void add_eliminated_field(std::size_t m, const double* coupling, const double* solved,
                          const double* field_coupling, const double* field_solved,
                          FieldResponse& field);

/// TwoPort::hessian from W_y and W_y,load of each unknown, the lower triangle of W_yy and
/// W_load,load.
Eigen::MatrixXd port_hessian(const double* columns, const BandLayout& layout, const double* tangent,
                             const Eigen::Matrix3d& by_load);

/// Number of stations of every `sections`.
inline constexpr int station_count = 41;

}  // namespace flexura

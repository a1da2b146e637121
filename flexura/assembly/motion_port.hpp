#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <vector>

#include "flexura/assembly/two_port.hpp"
#include "flexura/core/ldlt.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// What moves of a flexure at one of its quadrature points: a place of the axis with the mass
/// around it or, a `direction`, the unit vector that its section is turned by, with the section's
/// rotary inertia: |d/dt direction| is the section's spin.
struct MassPoint {
  double s = 0.0;        ///< arc length
  double inertia = 0.0;  ///< mass, or rotary inertia
  bool direction = false;
  std::size_t first = 0;  ///< internal unknowns that it depends on
  std::size_t count = 0;
  Vec2 force;  ///< dead force on it, axes as drawn
};

/// What a MotionPort finds at a state, and its scratch; the caller owns it.
struct MemberWork {
  std::vector<double> columns;  ///< W_y and W_y,load of each unknown: 4 m
  std::vector<Vec2> places;     ///< of the mass points, from the base end; or unit vectors
  std::vector<Vec2> rates;      ///< of the places
  std::vector<Vec2> seconds;    ///< and of their rates
  // by `linearize`:
  std::vector<double> tangent;  ///< the lower triangle of second derivatives, by the port's layout
  /// Derivatives of the places by the unknowns they depend on: `count` vectors per point, one point
  /// after the other.
  std::vector<Vec2> slopes;
  std::vector<double> scratch;
};

/// How a modeling stores energy in one flexure and where that puts its mass. Like a TwoPort, it is
/// a cantilever held by its base section and closed onto its action body by the load on its tip,
/// with
///     W(y, load) = energy(y) - load . tip(y);
/// but all that can move is among the internal unknowns y (dimensionless, of order one), so that
/// places of mass depend on nothing else:
///     place in the plane = base end + R(turn of the base section) place(y).
/// All calls are const and do not allocate, but for those that make results; threads share the
/// port.
class MotionPort {
 public:
  virtual ~MotionPort() = default;

  /// Number m of internal unknowns; they start at zero.
  virtual std::size_t internal_size() const = 0;
  /// Of second derivatives by y; masses fit into the same.
  virtual BandLayout layout() const = 0;
  virtual const std::vector<MassPoint>& points() const = 0;
  virtual std::size_t scratch_size() const = 0;
  /// Size of what a change of each unknown by one displaces, relative to the flexure's length.
  virtual std::vector<double> weights() const { return std::vector<double>(internal_size(), 1.0); }

  /// Energy and tip (x, y from the base end, rotation since the start).
  struct Answer {
    double energy = 0.0;
    Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  };
  /// At (load, y); `v` and `a` are first and second rates of y. Fills columns, places and their
  /// rates.
  virtual Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v,
                          const double* a, MemberWork& work) const = 0;
  /// Adds the derivatives by y of the sum of force . place to m doubles. Precondition of this and
  /// of what follows: the work's last evaluation was at this y.
  virtual void add_forces(const Vec2* forces, MemberWork& work, double* residual) const = 0;
  /// Second derivatives of W, and of the sum of weight . place if there are weights, into the
  /// work's tangent; the slopes of the places.
  virtual void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                         MemberWork& work) const = 0;
  /// Second derivatives of the energy by itself into the work's tangent.
  virtual void linearize_energy(const double* y, MemberWork& work) const {
    linearize(Eigen::Vector3d::Zero(), y, nullptr, work);
  }

  /// Stations for results, as TwoPort::sections. Forces are those of the sections' strains where
  /// the modeling knows them, and else those that hold the load on the tip.
  virtual std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                             const double* y) const = 0;
  virtual std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                                       const double* /*y*/) const {
    std::vector<Vec2> axis;
    for (const SectionState& section : sections) axis.push_back(section.pose.position);
    return axis;
  }

  /// As TwoPort::stress_field.
  virtual std::optional<StressField> stress_field(const double* /*y*/) const {
    return std::nullopt;
  }

  /// Internal unknowns near a state of the modeling's TwoPort, from its sections and its own
  /// internal unknowns.
  virtual std::vector<double> adopt(std::span<const SectionState> sections,
                                    std::span<const double> internal) const = 0;

  /// The same flexure discretized more finely, null where there is nothing to refine.
  virtual std::shared_ptr<const MotionPort> refined() const { return nullptr; }
  /// Internal unknowns of `refined()` that describe the same state.
  virtual void prolong(std::span<const double> internal, std::span<double> refined) const;
  /// As TwoPort::error_ratio.
  virtual double error_ratio() const { return 1.0; }
};

inline void MotionPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  std::copy(internal.begin(), internal.end(), refined.begin());
}

/// With the sizes that the port asks for.
inline MemberWork sized_work(const MotionPort& port) {
  MemberWork work;
  const BandLayout layout = port.layout();
  work.columns.resize(4 * layout.n);
  work.tangent.resize(layout.n * layout.row_stride);
  work.places.resize(port.points().size());
  work.rates.resize(port.points().size());
  work.seconds.resize(port.points().size());
  std::size_t slopes = 0;
  for (const MassPoint& point : port.points()) slopes += point.count;
  work.slopes.resize(slopes);
  work.scratch.resize(port.scratch_size());
  return work;
}

}  // namespace flexura

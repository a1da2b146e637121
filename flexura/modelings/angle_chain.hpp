#pragma once

#include <utility>
#include <vector>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// What an angle chain is made of: a flexure whose axis is a chain of arms that turn by angles, and
/// stretch and shear by strains, linear in its unknowns y:
///     p_h = (stretch_h + axial_h . y) t(theta_h) + (shear_h . y) n(theta_h),
///     theta_h = angle_h + turn_h . y.
/// The end of interval k, and its tip, lie at the sum of weight_h p_h over all arms so far; a mass
/// point inside an interval at the end of the one before plus a sum over some arms.
struct AngleChain {
  struct Arm {
    double weight = 0.0;
    double angle = 0.0;    ///< as drawn
    double stretch = 1.0;  ///< of the axis as drawn
    double s = 0.0;
  };
  struct Place {                ///< a mass point
    std::size_t interval = 0;   ///< starts from where this one does
    std::vector<double> parts;  ///< of its arms, from first_arm on
    std::size_t first_arm = 0;
    Vec2 offset;  ///< adds up to where it is drawn
  };
  /// A direction, of the section at an arm.
  struct Direction {
    std::size_t arm = 0;
    bool along_axis = false;  ///< turns by the shear strain as well
  };
  /// What the arms take of some unknowns in a row: arms x count, row-major.
  struct Rows {
    std::size_t first = 0;
    std::size_t count = 0;
    std::vector<double> values;

    double product(std::size_t arm, const double* y) const {
      const double* row = values.data() + arm * count;
      double sum = 0.0;
      for (std::size_t i = 0; i < count; ++i) sum += row[i] * y[first + i];
      return sum;
    }
    const double* row(std::size_t arm) const { return values.data() + arm * count; }
  };

  std::size_t unknowns = 0;
  std::vector<Arm> arms;
  /// First arm of each, and one past the last; arms behind that only turn directions.
  std::vector<std::size_t> intervals;
  Rows turns;
  Rows axial;                     ///< none: no axial strain
  Rows shear;                     ///< none: no shear strain
  std::vector<double> stiffness;  ///< S, unknowns x unknowns: energy = 1/2 y.S y
  std::vector<double> tip_turn;
  Vec2 tip_offset;
  std::vector<double> weights;  ///< of the unknowns in the size of a change

  std::vector<Place> places;          ///< the first mass points
  std::vector<Direction> directions;  ///< those behind
  std::vector<MassPoint> points;
};

/// MotionPort's calls of such a chain, for the ports of the modelings that are one.
class AngleChainMotion {
 public:
  explicit AngleChainMotion(AngleChain chain);

  const AngleChain& chain() const { return chain_; }
  std::size_t scratch_size() const;
  MotionPort::Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v,
                              const double* a, MemberWork& work) const;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const;
  void linearize(const Eigen::Vector3d& load, const Vec2* weights, MemberWork& work) const;
  void linearize_energy(MemberWork& work) const;

 private:
  /// An arm's angle, stretch and shear.
  struct ArmState {
    double angle = 0.0;
    double stretch = 0.0;
    double shear = 0.0;
  };
  /// Its vector's value and derivatives by them.
  struct ArmSlopes {
    Vec2 value;
    Vec2 by[3];
  };
  struct ArmMotion {
    Vec2 place, rate, second;
  };
  struct Scratch {
    ArmState* states;
    ArmSlopes* slopes;
    ArmMotion* motions;
    Vec2* weights;  // of the arms
    Vec2* sums;     // slopes of the end of an interval, by every unknown
    Vec2* arm_slopes;
    double* buffer;
  };
  Scratch scratch(MemberWork& work) const;
  ArmState state_of(std::size_t arm, const double* y) const;
  ArmMotion motion_of(const ArmState& state, const ArmState& rate, const ArmState& second) const;
  void place_points(const Scratch& s, MemberWork& work) const;
  void turn_directions(const Scratch& s, const double* v, const double* a, MemberWork& work) const;
  void gather_weights(const Vec2* weights, Vec2 on_tip, Vec2* on_arms) const;
  void fill_slopes(const Scratch& s, MemberWork& work) const;
  void add_arm_hessian(std::size_t arm, const ArmState& state, Vec2 weight, double* buffer,
                       double* tangent) const;
  bool is_sheared(const AngleChain::Direction& direction) const {
    return direction.along_axis && chain_.shear.count > 0;
  }

  AngleChain chain_;
};

}  // namespace flexura

#pragma once

#include <utility>
#include <vector>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// What an AngleChainPort is made of. A flexure whose axis is a chain of arms that turn by angles,
/// and stretch and shear by strains, linear in its unknowns y:
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
  struct Place {                ///< a mass point, or a station's
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

  std::size_t unknowns = 0;
  std::vector<Arm> arms;
  std::vector<std::size_t> intervals;  ///< first arm of each, and one past the last
  std::vector<double> turns;           ///< arms x unknowns, row-major, as those that follow
  std::vector<double> axial;           ///< empty: no axial strain
  std::vector<double> shear;           ///< empty: no shear strain
  std::vector<double> stiffness;       ///< S: energy = 1/2 y.S y
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
  explicit AngleChainMotion(AngleChain chain) : chain_(std::move(chain)) {}

  const AngleChain& chain() const { return chain_; }
  std::size_t scratch_size() const;
  MotionPort::Answer evaluate(const Eigen::Vector3d& load, const double* y, MemberWork& work) const;
  void linearize(const Eigen::Vector3d& load, const Vec2* weights, MemberWork& work) const;
  void add_curvature(const double* rate, MemberWork& work, Vec2* curvature) const;

  /// Angle of an arm since the start, elastic strains there.
  double turn(std::size_t arm, const double* y) const { return row_product(chain_.turns, arm, y); }
  double axial_strain(std::size_t arm, const double* y) const {
    return row_product(chain_.axial, arm, y);
  }
  double shear_strain(std::size_t arm, const double* y) const {
    return row_product(chain_.shear, arm, y);
  }

 private:
  /// Value and derivatives of an arm's vector by its angle, stretch and shear, in the scratch.
  struct ArmJet {
    Vec2 value;
    Vec2 first[3];
    Vec2 second[6];  // as Jet2 packs them
  };
  double row_product(const std::vector<double>& rows, std::size_t arm, const double* y) const;
  ArmJet* jets(MemberWork& work) const { return reinterpret_cast<ArmJet*>(work.scratch.data()); }
  Vec2 arm_curvature(std::size_t arm, const ArmJet& jet, const double* rate) const;
  ArmJet arm_jet(std::size_t arm, const double* y) const;
  void fill_arm_slope(std::size_t arm, const ArmJet& jet, Vec2* slope) const;
  void place_points(MemberWork& work) const;
  void add_arm_hessian(std::size_t arm, const ArmJet& jet, Vec2 weight, double* buffer,
                       double* tangent) const;

  AngleChain chain_;
};

}  // namespace flexura

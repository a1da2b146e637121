#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// A linkage of rigid parts. Part 0 is the ground; one other part is driven: held at a place and
/// turned. Places and directions are as drawn.
struct RigidLinkageLayout {
  struct Part {
    bool turns = true;  ///< a part that hangs on one pin has no rotation of its own
    Vec2 centre;        ///< any place on it: its displacement is that of this place
  };
  struct Pin {
    std::size_t first = 0;
    std::size_t second = 0;
    Vec2 at;
  };
  struct Slide {
    std::size_t base = 0;
    std::size_t action = 0;  ///< moves along a direction of the base and does not turn against it
    Vec2 direction;
    Vec2 at;  ///< on the action part
  };

  std::vector<Part> parts;
  std::vector<Pin> pins;
  std::vector<Slide> slides;
  std::size_t driven = 0;
  double size = 1.0;  ///< of the linkage
};

/// A part at an angle of the drive: displacement of its centre and its turn, with their first and
/// second derivatives by the angle.
struct PartMotion {
  Vec2 displacement, first, second;
  double turn = 0.0, first_turn = 0.0, second_turn = 0.0;
};

/// All parts at an angle of the drive. `freedom`: the smallest singular value of the constraints'
/// Jacobian over the largest; at a change point it is zero.
struct RigidState {
  double angle = 0.0;
  std::vector<PartMotion> parts;
  double freedom = 0.0;
};

/// Where a linkage cannot follow its drive, and how far it came.
struct RigidFailure {
  enum class Kind { ungoverned, change_point, open };
  double angle = 0.0;
  /// The drive does not say where all links are (or, as drawn, they do not fit); links come into
  /// one line; they cannot be closed any further.
  Kind kind = Kind::open;
};

/// Position, velocity and acceleration of a linkage over the angle of its drive.
class RigidLinkage {
 public:
  explicit RigidLinkage(RigidLinkageLayout layout);

  /// As drawn, with derivatives; none where the linkage has more freedom than its drive governs.
  std::optional<RigidState> drawn() const;
  /// From a state to an angle, on the same branch, in steps of at most two degrees.
  std::optional<RigidState> follow(RigidState state, double angle, RigidFailure& failure) const;
  /// At ascending angles, from the drawn position at angle 0; stops early at a failure.
  std::vector<RigidState> trace(const std::vector<double>& angles,
                                std::optional<RigidFailure>& failure) const;

  const RigidLinkageLayout& layout() const { return layout_; }
  /// Of a point of a part, as drawn: where it is, and the derivatives of that.
  PartMotion point(const RigidState& state, std::size_t part, Vec2 drawn) const;
  /// Of the gaps of pins (x, y) and slides (across, turn), the lengths over the linkage's size, by
  /// displacements over that size and turns of the parts that are not held, then by the drive's.
  Eigen::MatrixXd jacobian(const RigidState& state) const;
  /// First of a part's two or three columns there; -1 where it is held.
  int first_column(std::size_t part) const { return first_[part]; }

 private:
  Eigen::VectorXd gaps(const RigidState& state) const;
  /// Second derivatives of the gaps along the motion, less those by second derivatives.
  Eigen::VectorXd centripetal(const RigidState& state) const;
  bool close(RigidState& state) const;
  bool differentiate(RigidState& state) const;
  template <class Use>
  void for_unknowns(RigidState& state, const Use& use) const;

  RigidLinkageLayout layout_;
  std::vector<int> first_;  // unknown of a part, -1 where it is held
  int unknowns_ = 0;
  int rows_ = 0;
};

}  // namespace flexura

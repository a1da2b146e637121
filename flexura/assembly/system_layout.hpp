#pragma once

#include <memory>
#include <vector>

#include "flexura/assembly/port_kinematics.hpp"
#include "flexura/assembly/two_port.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// How a mechanism is put together, before any unknown has a number.
struct SystemLayout {
  struct Body {
    Vec2 centre;        ///< as drawn
    bool moves = true;  ///< has unknowns; a body that does not is held at a pose
    bool turns = true;  ///< has a rotation among them
    double mass = 0.0;  ///< at the centre
    double inertia = 0.0;
  };
  struct Member {
    std::size_t base = 0;  ///< bodies
    std::size_t action = 0;
    bool pinned_base = false;
    bool pinned_action = false;
    PortArms arms;
    double length = 1.0;             ///< sizes the unknowns: translations and moments
    double bending_stiffness = 1.0;  ///< EI, likewise
    /// Of the place on the action body where the end is fastened, from where the end is drawn:
    /// what assembly closes.
    Vec2 misfit;
    double misfit_rotation = 0.0;
    std::shared_ptr<const TwoPort> port;
  };
  struct Load {  ///< at full load factor, on a point of a body
    std::size_t body = 0;
    Vec2 arm;  ///< from the body's centre, as drawn
    Vec2 force;
    double moment = 0.0;
    bool follower = false;
    bool constant = false;  ///< comes with assembly, and stays
  };

  /// A displacement or rotation of a point of a body that is imposed, in proportion to the load
  /// factor.
  struct Prescribed {
    enum class Component { x, y, rotation };
    std::size_t body = 0;
    Vec2 arm;  ///< from the body's centre, as drawn
    Component component = Component::x;
    double value = 0.0;  ///< at load factor 1
  };

  /// Between points of two bodies, or, torsional, between the bodies' rotations.
  struct Spring {
    std::size_t base = 0;
    std::size_t action = 0;
    Vec2 base_arm;  ///< from the body's centre, as drawn
    Vec2 action_arm;
    double stiffness = 0.0;  ///< force per length, or moment per radian
    double free = 0.0;       ///< length, or relative rotation, without force
    bool torsional = false;
    double misfit = 0.0;   ///< `free` less the length as drawn: comes with assembly
    double damping = 0.0;  ///< force per rate of length, or moment per rate of rotation
  };

  /// A pin between points of two bodies, or a slide of one along a direction of the other without
  /// turning against it.
  struct Joint {
    enum class Kind { revolute, prismatic };
    Kind kind = Kind::revolute;
    std::size_t base = 0;
    std::size_t action = 0;
    Vec2 base_arm;  ///< from the body's centre to the place, as drawn
    Vec2 action_arm;
    Vec2 direction;  ///< of a slide: unit length, as drawn, turns with the base body
  };

  std::vector<Body> bodies;
  std::vector<Member> members;
  std::vector<Load> loads;
  std::vector<Spring> springs;
  std::vector<Prescribed> prescribed;
  std::vector<Joint> joints;
  /// What acts along flexures and on temperature comes with assembly, and stays.
  bool constant_fields = false;
  /// Small displacements: kinematics to first order about the drawn state.
  bool linearised = false;
};

}  // namespace flexura

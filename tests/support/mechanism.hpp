#pragma once

#include <string>
#include <vector>

#include "flexura/model/model.hpp"

namespace flexura::testing {

/// Builds models in C++, by names as a model file would. One material and one section at a time:
/// flexures take the last ones that were added.
class Mechanism {
 public:
  Mechanism& material(double youngs_modulus, double poissons_ratio);
  Mechanism& section(const Section& shape);
  Mechanism& fixed(const std::string& name);
  Mechanism& body(const std::string& name);
  /// On the last body that was added.
  Mechanism& centre(Vec2 at);
  Mechanism& point(const std::string& name, Vec2 at);
  Mechanism& flexure(const std::string& base, const std::string& action, const AxisShape& axis);
  /// A link of any shape.
  Mechanism& link(const std::string& base, const std::string& action, MeshLink shape);
  /// On the last flexure that was added.
  Mechanism& pin_base();
  Mechanism& pin_action();

  /// Of all materials so far.
  Mechanism& density(double value);
  /// On the last body that was added.
  Mechanism& mass(double mass, double inertia = 0.0);
  Mechanism& free();
  Mechanism& pin(const std::string& base, const std::string& action, Vec2 at);
  Mechanism& slide(const std::string& base, const std::string& action, Vec2 direction);
  /// Between the centres of two bodies, with a damper beside it.
  Mechanism& spring(const std::string& base, const std::string& action, double stiffness,
                    double damping = 0.0);
  /// Turns a body by `amount` times a history.
  Mechanism& turn(const std::string& body, double amount, TimeHistory history);

  std::size_t index(const std::string& body) const;
  const Model& model() const { return model_; }
  operator const Model&() const { return model_; }

  /// A load on "body" or "body.point".
  Load load(const std::string& on, Vec2 force, double moment = 0.0) const;
  Load follower(const std::string& on, Vec2 force, double moment = 0.0) const;

 private:
  Model model_;
};

/// Section and material in one: EA, EI and GA_s as given.
struct Stiffness {
  double axial = 1.0;
  double bending = 1.0;
  double shear = 1.0;
};
Mechanism& with_stiffness(Mechanism& mechanism, const Stiffness& stiffness);

/// The open chain of three circular-arc flexures (second source, table 1), mm and N; point
/// "link4.E".
Mechanism arc_chain();

/// A flexure from "ground" to "stage" along any axis, strip 0.1 x 1 of E = 2100, nu = 0.35.
Mechanism single_flexure(const AxisShape& axis);

/// A straight cantilever of length 1 along x with the stiffnesses given, tip body "tip".
Mechanism cantilever(const Stiffness& stiffness, double length = 1.0);

/// The monolithic frame of the first source's table 1, m and N: bodies "left" and "right" at the
/// corners, flexures left leg (upwards), coupler (left to right), right leg (downwards).
Mechanism portal_frame();

/// Two parallel leaves of length 50 between "ground" and "stage", 30 apart, strip 0.5 x 10 of
/// steel.
Mechanism parallelogram();

/// Lee's frame (E = 720, A = 6, I = 2, nu = 0.3, two members of 120, both supports pinned), bodies
/// "corner" and "loaded", at a fifth of the beam.
Mechanism lee_frame();

}  // namespace flexura::testing

#pragma once

#include <optional>
#include <vector>

#include "flexura/model/loads.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/model/motion.hpp"

namespace flexura {

/// A speed that varies over the turn: d(angle)/dt = mean (1 + sum of amplitude cos(order angle -
/// phase)).
struct SpeedHarmonic {
  int order = 1;
  double amplitude = 0.0;
  double phase = 0.0;
};

/// Mean speeds of a drive, evenly from one to the other.
struct SpeedRange {
  double from = 0.0;
  double to = 0.0;
  int count = 50;
};

/// Study `linkage`: elastic vibrations upon the rigid motion of a linkage that a drive turns
/// (kineto-elastodynamics), over a turn. Histories of loads are over the angle of the drive.
struct LinkageStudy {
  enum class Method { quasi_static, periodic, midha, transient, nonlinear };
  enum class GeometricStiffness { none, quasi_static, dynamic };
  /// What is carried over from one interval of Midha's method to the next: displacements and
  /// velocities, or the coordinates of every mode by itself.
  enum class Continuity { physical, modal };
  struct ElementCount {
    std::size_t flexure = 0;
    int elements = 1;
  };

  std::size_t driver = 0;  ///< index into Model::drivers
  std::vector<Load> loads;
  Vec2 gravity;
  int positions = 180;                         ///< intervals of a turn
  int elements = 3;                            ///< per flexure, of beam elements
  std::vector<ElementCount> flexure_elements;  ///< where it differs
  ModelingSettings modeling;
  std::vector<Method> methods = {Method::quasi_static, Method::periodic};
  bool coupling = true;
  GeometricStiffness geometric_stiffness = GeometricStiffness::quasi_static;
  DampingSettings damping;
  std::optional<bool> rotary_inertia;
  bool inertia_correction = true;  ///< of strains inside an element
  std::vector<SpeedHarmonic> fluctuation;
  std::optional<SpeedRange> speeds;
  int modes = 6;                   ///< whose frequencies are found
  std::optional<int> midha_modes;  ///< of Midha's method
  Continuity continuity = Continuity::physical;
  int turns = 200;  ///< at most, of the transient
  /// The turn that `midha` and `transient` show, counted from rest; without, the settled one.
  std::optional<int> turn_from_rest;

  bool uses(Method method) const;
  int elements_of(std::size_t flexure) const;
};

}  // namespace flexura

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flexura/core/diagnostics.hpp"
#include "flexura/core/time_history.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/model/loads.hpp"
#include "flexura/model/modeling_settings.hpp"

namespace flexura {

/// A pin that both bodies share at a place, as drawn.
struct RevoluteJoint {
  Vec2 at;
};

/// The second body slides along a direction of the first and does not turn against it.
struct PrismaticJoint {
  Vec2 direction;  ///< as drawn, any length
};

struct Joint {
  std::string name;
  std::size_t base = 0;    ///< index into Model::bodies
  std::size_t action = 0;  ///< index into Model::bodies
  std::variant<RevoluteJoint, PrismaticJoint> kind;
  SourcePosition source;
};

/// A body whose motion is known: held at its centre and turned by `amount` times the history, or,
/// with a direction, moved along it by that and not turned. In studies without time it stays where
/// it is drawn.
struct Driver {
  std::string name;
  std::size_t body = 0;
  std::optional<Vec2> direction;
  double amount = 0.0;  ///< an angle or a length; with LinearHistory, a speed
  TimeHistory history = LinearHistory{};
  SourcePosition source;
};

/// Which kinetic energies of flexures count.
struct InertiaSettings {
  bool translation = true;
  std::optional<bool> rotary = {};  ///< of sections; by default, where the modeling has shear
  bool shear_rotary = true;         ///< sections turn with the shear strain, or with the axis alone
  bool lumped = false;              ///< masses at the nodes of beam elements
};

/// Modal: the share of critical damping of every mode about the start. Rayleigh: a force against
/// the velocity of all mass, and one against the rate of all elastic forces.
struct DampingSettings {
  double modal = 0.0;
  double mass = 0.0;       ///< per time
  double stiffness = 0.0;  ///< time
};

/// A state of an earlier study: of a path at a load factor, of a transient at its end.
struct StudyState {
  std::size_t study = 0;  ///< index into Model::studies
  double load_factor = 1.0;
};

/// Study `modes`: natural frequencies and shapes about the drawn state or a state of a path.
struct ModesStudy {
  enum class Solver { automatic, dense, sparse };
  std::optional<StudyState> about;
  bool curve = false;  ///< also about every output state of that path up to there
  int count = 6;
  Solver solver = Solver::automatic;
  InertiaSettings inertia;
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;
};

/// Study `transient`: motion in time.
struct TransientStudy {
  enum class Method { radau, generalized_alpha, energy_momentum };
  std::vector<Load> loads;
  FieldLoads fields;
  std::vector<Prescribed> prescribe;
  std::optional<StudyState> from;  ///< where it starts; none: at rest as drawn
  double duration = 0.0;
  std::optional<double> step = {};  ///< fixed; without it steps follow `tolerance`
  double tolerance = 1e-5;          ///< per step, of displacements in mean flexure lengths
  Method method = Method::radau;
  double spectral_radius = 0.8;  ///< of generalized-alpha at infinite frequency
  int outputs = 200;             ///< equal intervals of time that are recorded
  bool estimate = true;          ///< of the error, by running again more finely
  DampingSettings damping;
  InertiaSettings inertia;
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;
};

/// Study `response`: the steady motion under loads that all go as the cosine of the same angle.
struct ResponseStudy {
  std::vector<Load> loads;  ///< amplitudes
  std::optional<StudyState> about;
  double from = 0.0;  ///< angular frequencies
  double to = 0.0;
  int count = 400;
  bool logarithmic = true;
  DampingSettings damping;
  InertiaSettings inertia;
  std::vector<ModelingSettings> modelings;
  std::size_t reference = 0;
};

}  // namespace flexura

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "flexura/assembly/system.hpp"
#include "flexura/core/termination.hpp"
#include "flexura/model/model.hpp"
#include "flexura/solvers/load_stepping.hpp"

namespace flexura {

/// One output state of a path: the unknowns of one of the path's systems.
struct TracedState {
  double load_factor = 0.0;
  std::size_t system = 0;  ///< index into TracedPath::systems
  std::vector<double> z;
  int unstable_directions = 0;
  std::vector<double> errors;  ///< estimated, of each tracked point (length); empty: no estimate
  /// Likewise of the reactions on what is prescribed, relative to the largest over the path so
  /// far.
  double reaction_error = 0.0;
};

struct TracedEvent {
  std::string kind;
  double load_factor = 0.0;
  std::size_t system = 0;
  std::vector<double> z;
  int unstable_directions = 0;
  int directions = 1;  ///< so many change their stability there
};

/// A modeling's path as its unknowns, before anything is drawn or tabulated.
struct TracedPath {
  Termination termination;
  std::vector<std::unique_ptr<System>>
      systems;  ///< more than one where modes were added on the way
  std::vector<TracedState> states;
  std::vector<TracedEvent> events;
  int steps = 0;
  int iterations = 0;
};

/// A point of a body as drawn, whose path errors are measured on.
struct TrackedPoint {
  std::size_t body = 0;
  Vec2 drawn;
};

/// The named points of all moving bodies; their centres if no point is named.
std::vector<TrackedPoint> tracked_points(const Model& model);

/// What is left to correct in a state, for a modeling's tolerance.
double algebraic_tolerance(double tolerance);
/// Whether the tolerance decides on the number of modes.
bool chooses_modes(const ModelingSettings& settings);

struct TraceOptions {
  int steps = 20;               ///< equal steps of the load factor from 0 to 1
  bool estimate_errors = true;  ///< where the modeling has a discretization
  /// Asked after each output step with the fraction done; false stops. May be empty.
  std::function<bool(double)> keep_going = {};
  std::vector<Prescribed> prescribed = {};  ///< imposed displacements, growing with the loads
  FieldLoads fields = {};
};

/// Follows the equilibria of one modeling under growing loads.
TracedPath trace_path(const Model& model, const std::vector<Load>& loads,
                      const ModelingSettings& settings, const TraceOptions& options);

}  // namespace flexura

#pragma once

#include <memory>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/modelings/make_motion.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// A mechanism in motion at an equilibrium.
struct MotionStart {
  std::unique_ptr<MotionSystem> system;
  Moment moment;
  Termination termination;  ///< of what led there; converged where `moment` is an equilibrium
};

/// The drawn mechanism at rest.
MotionStart drawn_start(const Model& model, const ModelingSettings& settings,
                        const InertiaSettings& inertia);

/// The states of a path study, up to a load factor, as equilibria of a mechanism in motion that is
/// held by the same loads.
class PathStart {
 public:
  PathStart(const Model& model, const PathStudy& study, const ModelingSettings& settings,
            const InertiaSettings& inertia, double load_factor);

  const Termination& termination() const { return traced_.termination; }
  /// Load factors of the output states.
  const std::vector<double>& load_factors() const { return load_factors_; }
  /// About the k-th output state.
  MotionStart at(std::size_t k) const;
  MotionStart last() const { return at(load_factors_.size() - 1); }

 private:
  void adopt(const TracedState& state, MotionSystem& system, Moment& moment) const;

  const Model& model_;
  const PathStudy& study_;
  const ModelingSettings& settings_;
  const InertiaSettings& inertia_;
  double load_factor_;
  TracedPath traced_;
  std::vector<double> load_factors_;
};

/// The path study that a study's state refers to.
const PathStudy& path_study_of(const Model& model, const StudyState& state);

/// Drawn, or at the state that `about` names.
MotionStart start_about(const Model& model, const std::optional<StudyState>& about,
                        const ModelingSettings& settings, const InertiaSettings& inertia);

/// Newton's method for a state at rest; false where it does not converge.
bool solve_at_rest(MotionSystem& system, Moment& moment);

}  // namespace flexura

#include "flexura/studies/arc_tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/continuation.hpp"
#include "flexura/studies/assembly_stage.hpp"
#include "flexura/studies/error_estimate.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/singular_mechanism.hpp"

namespace flexura {
namespace {

constexpr int steps_per_step = 100;  // taken at most, as a multiple of the study's `steps`
constexpr int most_steps = 100000;   // each is a state that is kept

class ArcTracer {
 public:
  ArcTracer(const Model& model, const PathStudy& study, const ModelingSettings& settings,
            int refinements)
      : study_(study),
        settings_(settings),
        points_(tracked_points(model)),
        options_{algebraic_tolerance(settings.tolerance), 2.0 / study.steps, 1e-8} {
    SystemLayout layout = make_layout(model, study.loads, settings, {}, study.fields);
    add_prescribed(layout, model, study.prescribe);
    path_.systems.push_back(std::make_unique<System>(std::move(layout)));
    finer_ = path_.systems.back()->refined();
    for (; refinements > 0 && finer_; --refinements) {
      path_.systems.back() = std::move(finer_);
      finer_ = path_.systems.back()->refined();
    }
    if (!study.estimate && !chooses_modes(settings)) finer_.reset();
  }

  TracedPath run(const Model& model, const std::function<bool(double)>& keep_going);

 private:
  using Path = Continuation<System>;

  System& system() { return *path_.systems.back(); }
  bool is_done(const Path& path);
  void note_features(Path& path);
  void record(Path& path);
  bool is_accurate(const std::vector<double>& errors, double reaction_error);
  bool measure(const Path& path, std::vector<double>& errors, double& reaction_error);
  void stop(const Path& path);

  const PathStudy& study_;
  const ModelingSettings& settings_;
  std::vector<TrackedPoint> points_;
  ContinuationOptions options_;
  std::unique_ptr<System> finer_;
  ArcState finer_state_;
  std::optional<ArcState> leave_;  // the bifurcation at which to leave the branch
  double largest_displacement_ = 0.0;
  double largest_reaction_ = 0.0;
  int limit_points_ = 0;
  int critical_ = 0;
  int bifurcations_ = 0;
  int refinements_left_ = 6;
  TracedPath path_;
};

TracedPath ArcTracer::run(const Model& model, const std::function<bool(double)>& keep_going) {
  Path path(system(), options_);
  std::vector<double> start;
  if (!assemble(model, options_.tolerance, path_, start)) return std::move(path_);
  const bool drawn = !system().needs_assembly();
  if (!path.start(0.0, start) || (drawn && system().is_singular())) {
    path_.termination = {Status::stopped, describe_singular(model, system().softest_body())};
    return std::move(path_);
  }
  record(path);
  path_.termination.status = Status::converged;
  const int most = std::min(steps_per_step * study_.steps, most_steps);
  for (int k = 0; !is_done(path); ++k) {
    if (k == most) {
      path_.termination = {
          Status::stopped,
          fmt::format("{} steps did not reach the end asked for: the path has come "
                      "to load factor {:.6g}. Say by `until` where it may end",
                      most, path.state().load_factor)};
      break;
    }
    if (!path.advance()) {
      stop(path);
      break;
    }
    ++path_.steps;
    note_features(path);
    if (leave_) {
      if (!path.switch_branch(*leave_, study_.branch->side)) {
        path_.termination = {Status::stopped,
                             fmt::format("no branch found that leaves the path at load factor "
                                         "{:.6g}",
                                         leave_->load_factor)};
        break;
      }
      leave_.reset();
    }
    const double end = study_.until.load_factor;
    const double before = path_.states.back().load_factor;
    const double here = path.state().load_factor;
    const bool reaches = (before < end && here >= end) || (before > end && here <= end);
    if (reaches && !path.land(end)) {
      stop(path);
      break;
    }
    record(path);
    if (keep_going && !keep_going(std::min(1.0, std::abs(here / end)))) {
      path_.termination = {Status::stopped, fmt::format("cancelled at load factor {:.6g}", here)};
      break;
    }
  }
  if (path_.termination.converged() && study_.branch && bifurcations_ < study_.branch->at)
    path_.termination = {Status::stopped,
                         fmt::format("the path passes {} bifurcations up to its end, not {}: there "
                                     "is no branch to change to",
                                     bifurcations_, study_.branch->at)};
  path_.iterations += path.iterations();
  return std::move(path_);
}

bool ArcTracer::is_done(const Path& path) {
  const PathEnd& until = study_.until;
  return path.state().load_factor == until.load_factor ||
         (until.critical && critical_ >= *until.critical) ||
         (until.limit_points && limit_points_ >= *until.limit_points) ||
         (until.steps && path_.steps >= *until.steps);
}

void ArcTracer::note_features(Path& path) {
  for (const LocatedFeature& found : path.features()) {
    const std::size_t system = path_.systems.size() - 1;
    const auto add = [&](const char* kind, int unstable) {
      path_.events.push_back({kind, found.state.load_factor, system, found.state.z, unstable});
    };
    if (found.feature == PathFeature::zero_load) {
      add("zero load", found.unstable_before);
      continue;
    }
    const bool limit = found.feature == PathFeature::limit_point;
    const int directions = std::max(1, std::abs(found.unstable_after - found.unstable_before));
    add(limit ? "limit point" : "bifurcation", found.unstable_before);
    path_.events.back().directions = directions;
    if (found.unstable_before == 0 && found.unstable_after > 0) add("stability lost", 1);
    if (found.unstable_before > 0 && found.unstable_after == 0) add("stability gained", 0);
    ++(limit ? limit_points_ : bifurcations_);
    critical_ += directions;
    if (!limit && study_.branch && bifurcations_ == study_.branch->at) leave_ = found.state;
  }
}

/// The same point of the path by the finer system: on the plane across the tangent, so that the
/// estimate does not depend on how steep the path is.
bool ArcTracer::measure(const Path& path, std::vector<double>& errors, double& reaction_error) {
  const ArcState& at = path.state();
  ArcState start{at.load_factor, system().prolong(at.z, *finer_),
                 system().prolong(at.tangent_z, *finer_), at.tangent_load};
  finer_->hold_as(system());
  ArcLength<System> arc(*finer_, options_.tolerance);
  arc.set_load_scale(path.load_scale());
  const bool solved = arc.step(start, 0.0, finer_state_);
  path_.iterations += arc.iterations();
  if (!solved) return false;
  const double ratio = error_ratio(system());
  errors.clear();
  for (const TrackedPoint& point : points_) {
    const Vec2 here = system().moved_point(point.body, point.drawn, at.z);
    largest_displacement_ = std::max(largest_displacement_, norm(here - point.drawn));
    errors.push_back(ratio *
                     norm(finer_->moved_point(point.body, point.drawn, finer_state_.z) - here));
  }
  const auto& prescribed = system().layout().prescribed;
  reaction_error = 0.0;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    const bool turns = prescribed[i].component == SystemLayout::Prescribed::Component::rotation;
    const double scale = turns ? 1.0 / system().mean_length() : 1.0;
    const double here = system().prescribed_reaction(i, at.z);
    const double finer = finer_->prescribed_reaction(i, finer_state_.z);
    largest_reaction_ = std::max(largest_reaction_, scale * std::abs(here));
    reaction_error = std::max(reaction_error, ratio * scale * std::abs(finer - here));
  }
  if (largest_reaction_ > 0.0) reaction_error /= largest_reaction_;
  return true;
}

bool ArcTracer::is_accurate(const std::vector<double>& errors, double reaction_error) {
  const double largest = *std::max_element(errors.begin(), errors.end());
  const double rounding = 1e-11 * system().mean_length();
  return largest <= std::max(0.3 * settings_.tolerance * largest_displacement_, rounding) &&
         reaction_error <= std::max(0.3 * settings_.tolerance, 1e-10);
}

/// The state with its estimate; the finer system goes on where the modeling chooses its own modes
/// and those do not suffice.
void ArcTracer::record(Path& path) {
  std::vector<double> errors;
  double reaction_error = 0.0;
  while (finer_) {
    if (path.state().z == system().initial_state()) {
      errors.assign(points_.size(), 0.0);
      break;
    }
    if (!measure(path, errors, reaction_error)) {
      errors.clear();
      break;
    }
    if (is_accurate(errors, reaction_error) || !chooses_modes(settings_) || refinements_left_ == 0)
      break;
    --refinements_left_;
    path_.systems.push_back(std::move(finer_));
    path.change_problem(system(), finer_state_);
    finer_ = system().refined();
  }
  path_.states.push_back({path.state().load_factor, path_.systems.size() - 1, path.state().z,
                          path.unstable_directions(), std::move(errors), reaction_error});
}

void ArcTracer::stop(const Path& path) {
  path_.termination = {
      Status::stopped,
      fmt::format("no way on past load factor {:.6g}: arc-length steps of every size fail there. "
                  "More steps, or another modeling, will show where the path leads",
                  path.state().load_factor)};
}

}  // namespace

TracedPath trace_by_arc_length(const Model& model, const PathStudy& study,
                               const ModelingSettings& settings,
                               const std::function<bool(double)>& keep_going, int refinements) {
  return ArcTracer(model, study, settings, refinements).run(model, keep_going);
}

}  // namespace flexura

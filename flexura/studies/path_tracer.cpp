#include "flexura/studies/path_tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/modelings/make_system.hpp"
#include "flexura/studies/assembly_stage.hpp"
#include "flexura/studies/error_estimate.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/singular_mechanism.hpp"

namespace flexura {
namespace {

constexpr int most_ratio_updates = 40;

/// To three digits, so that the number in a message is still safe to use.
double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-300))) - 2.0);
  return std::floor(value / unit) * unit;
}

using Stepping = LoadStepping<System>;

class PathTracer {
 public:
  PathTracer(const Model& model, const std::vector<Load>& loads, const ModelingSettings& settings,
             const TraceOptions& options, int refinements)
      : model_(model),
        loads_(loads),
        settings_(settings),
        options_(options),
        points_(tracked_points(model)) {
    path_.systems.push_back(std::make_unique<System>(make_prescribed_layout()));
    for (; refinements > 0; --refinements)
      if (auto finer = system().refined()) path_.systems.back() = std::move(finer);
    if (options_.estimate_errors) estimate_ = std::make_unique<ErrorEstimate>(system());
  }

  TracedPath run();
  /// Whether the path ended where the finer system that its state asked for has no such state.
  bool needs_finer_start() const { return refinement_failed_; }

 private:
  SystemLayout make_prescribed_layout() const {
    SystemLayout layout = make_layout(model_, loads_, settings_, load_ratios_, options_.fields);
    add_prescribed(layout, model_, options_.prescribed);
    return layout;
  }
  System& system() { return *path_.systems.back(); }
  bool estimates() const { return estimate_ && estimate_->available(); }
  bool may_refine() const {
    return estimates() && chooses_modes(settings_) && refinements_left_ > 0;
  }
  SteppingSummary advance(Stepping& stepping, double load_factor);
  bool settle(Stepping& stepping);
  bool refine(Stepping& stepping);
  bool settle_load_ratios(Stepping& stepping);
  void record(const Stepping& stepping, double load_factor, std::vector<double> errors);
  std::vector<double> measure_errors(const std::vector<double>& z);
  double measure_reaction_error(const std::vector<double>& z);
  bool is_accurate(const std::vector<double>& errors, const std::vector<double>& z);
  void note_changes(const Stepping& stepping);
  void stop(const SteppingSummary& summary);
  std::optional<double> stability_lost() const;
  Termination singular_start();

  const Model& model_;
  const std::vector<Load>& loads_;
  const ModelingSettings& settings_;
  const TraceOptions& options_;
  std::vector<TrackedPoint> points_;
  std::unique_ptr<ErrorEstimate> estimate_;
  std::vector<std::optional<double>> load_ratios_;
  std::vector<double> errors_;
  double largest_displacement_ = 0.0;
  double reaction_error_ = 0.0;
  double rotation_error_ = 0.0;
  double largest_force_ = 0.0;
  double largest_moment_ = 0.0;
  std::size_t changes_noted_ = 0;
  int refinements_left_ = 6;
  bool refinement_failed_ = false;
  TracedPath path_;
};

TracedPath PathTracer::run() {
  const int steps = options_.steps;
  Stepping stepping(system(), {algebraic_tolerance(settings_.tolerance), 1e-4});
  std::vector<double> start;
  if (!assemble(model_, algebraic_tolerance(settings_.tolerance), path_, start))
    return std::move(path_);
  const bool assembled = system().needs_assembly();
  if (!stepping.start(start) || (!assembled && system().is_singular())) {
    path_.termination = singular_start();
    return std::move(path_);
  }
  if (assembled)
    settle(stepping);
  else
    errors_.assign(estimates() ? points_.size() : 0, 0.0);
  record(stepping, 0.0, errors_);
  path_.termination.status = Status::converged;
  for (int step = 1; step <= steps; ++step) {
    const double load_factor = step == steps ? 1.0 : static_cast<double>(step) / steps;
    const SteppingSummary summary = advance(stepping, load_factor);
    note_changes(stepping);
    if (summary.outcome != SteppingOutcome::reached) {
      if (summary.outcome == SteppingOutcome::wound_up) record(stepping, summary.load_factor, {});
      stop(summary);
      break;
    }
    if (!settle(stepping)) {
      path_.termination = {
          Status::stopped,
          fmt::format(follows_load_ratio(settings_)
                          ? fmt::runtime("Howell's parameters do not settle at load factor {:.6g}: "
                                         "give a load_ratio")
                          : fmt::runtime("the finer discretization that the state at load factor "
                                         "{:.6g} asks for has no equilibrium near it; more steps "
                                         "may help"),
                      load_factor)};
      break;
    }
    record(stepping, load_factor, errors_);
    if (options_.keep_going && !options_.keep_going(load_factor)) {
      path_.termination = {Status::stopped,
                           fmt::format("cancelled at load factor {:.6g}", load_factor)};
      break;
    }
  }
  path_.steps = stepping.steps();
  path_.iterations += stepping.iterations();
  return std::move(path_);
}

/// Estimates the error of the new state, and refines where the modeling chooses its own number of
/// modes and they do not suffice. What a path may be refined is limited: past that, the estimate
/// says how far it is from the tolerance. A state where the finer system has no solution (a
/// critical one, say) goes without an estimate.
bool PathTracer::settle(Stepping& stepping) {
  errors_.clear();
  reaction_error_ = 0.0;
  if (follows_load_ratio(settings_) && !settle_load_ratios(stepping)) return false;
  while (estimates()) {
    const std::vector<double>& z = stepping.state();
    if (estimate_->solve(system(), z, path_.iterations)) {
      errors_ = measure_errors(z);
      reaction_error_ = measure_reaction_error(z);
      if (is_accurate(errors_, z)) return true;
    }
    if (!may_refine()) return true;
    if (!refine(stepping)) {
      refinement_failed_ = true;
      return false;
    }
  }
  return true;
}

/// Goes on by the finer system; false where it has no equilibrium near the last state, or one on
/// another part of the path, which is not as stable.
bool PathTracer::refine(Stepping& stepping) {
  --refinements_left_;
  const System& coarse = system();
  path_.systems.push_back(estimate_->release());
  stepping.change_problem(system(), [&coarse, this](const std::vector<double>& v) {
    return coarse.prolong(v, system());
  });
  estimate_ = std::make_unique<ErrorEstimate>(system());
  const int unstable = stepping.unstable_directions();
  return stepping.correct() && stepping.unstable_directions() == unstable;
}

/// On to the next load factor. Where a path seems to end in between, it may only be the end of what
/// so few modes can follow: an end counts once the next finer system ends there, too.
SteppingSummary PathTracer::advance(Stepping& stepping, double load_factor) {
  SteppingSummary summary = stepping.advance(load_factor);
  const auto ends = [&summary] {
    return summary.outcome == SteppingOutcome::limit_point ||
           summary.outcome == SteppingOutcome::lost;
  };
  while (ends() && may_refine()) {
    SteppingSummary before = std::move(summary);
    note_changes(stepping);  // while they belong to this system
    if (!refine(stepping)) {
      path_.systems.pop_back();
      refinement_failed_ = true;
      return before;
    }
    summary = stepping.advance(load_factor);
    const double moved = std::abs(summary.load_factor - before.load_factor);
    if (summary.outcome == SteppingOutcome::limit_point && before.outcome == summary.outcome &&
        moved <= 0.3 * settings_.tolerance * summary.load_factor)
      break;
  }
  return summary;
}

/// Howell's parameters depend on the load each flexure carries: solves again until they agree.
bool PathTracer::settle_load_ratios(Stepping& stepping) {
  for (int k = 0; k < most_ratio_updates; ++k) {
    auto ratios = find_load_ratios(model_, system(), stepping.state());
    bool same = ratios.size() == load_ratios_.size();
    for (std::size_t i = 0; same && i < ratios.size(); ++i)
      same = ratios[i].has_value() == load_ratios_[i].has_value() &&
             std::abs(ratios[i].value_or(0.0) - load_ratios_[i].value_or(0.0)) < 1e-9;
    if (same) return true;
    load_ratios_ = std::move(ratios);
    path_.systems.push_back(std::make_unique<System>(make_prescribed_layout()));
    stepping.change_problem(system(), [](const std::vector<double>& v) { return v; });
    if (!stepping.correct()) return false;
  }
  return false;
}

std::vector<double> PathTracer::measure_errors(const std::vector<double>& z) {
  const System& coarse = *path_.systems.back();
  std::vector<double> errors;
  const double ratio = error_ratio(coarse);
  rotation_error_ = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    rotation_error_ =
        std::max(rotation_error_,
                 ratio * std::abs(estimate_->finer().pose(b, estimate_->finer_state()).rotation -
                                  coarse.pose(b, z).rotation));
  for (const TrackedPoint& point : points_)
    errors.push_back(ratio * norm(estimate_->finer().moved_point(point.body, point.drawn,
                                                                 estimate_->finer_state()) -
                                  coarse.moved_point(point.body, point.drawn, z)));
  return errors;
}

/// Where the points are driven, what is uncertain is the force that it takes.
double PathTracer::measure_reaction_error(const std::vector<double>& z) {
  const auto& prescribed = system().layout().prescribed;
  double force_error = 0.0;
  double moment_error = 0.0;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    const double here = system().prescribed_reaction(i, z);
    const double finer = estimate_->finer().prescribed_reaction(i, estimate_->finer_state());
    const bool turns = prescribed[i].component == SystemLayout::Prescribed::Component::rotation;
    double& largest = turns ? largest_moment_ : largest_force_;
    double& error = turns ? moment_error : force_error;
    largest = std::max(largest, std::abs(here));
    error = std::max(error, std::abs(finer - here));
  }
  // a moment that only balances rounding is measured by the force, at a flexure's length
  const double length = system().mean_length();
  const double moment_size = std::max(largest_moment_, largest_force_ * length);
  const double force_size = std::max(largest_force_, largest_moment_ / length);
  double worst = 0.0;
  if (force_size > 0.0) worst = force_error / force_size;
  if (moment_size > 0.0) worst = std::max(worst, moment_error / moment_size);
  return error_ratio(system()) * worst;
}

bool PathTracer::is_accurate(const std::vector<double>& errors, const std::vector<double>& z) {
  for (const TrackedPoint& point : points_)
    largest_displacement_ =
        std::max(largest_displacement_,
                 norm(system().moved_point(point.body, point.drawn, z) - point.drawn));
  // a body that turns about its point is off where it is far from it
  const double length = system().mean_length();
  const double largest =
      std::max(*std::max_element(errors.begin(), errors.end()), length * rotation_error_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    largest_displacement_ =
        std::max(largest_displacement_, length * std::abs(system().pose(b, z).rotation));
  const double rounding = 1e-11 * length;
  return largest <= std::max(0.3 * settings_.tolerance * largest_displacement_, rounding) &&
         reaction_error_ <= std::max(0.3 * settings_.tolerance, 1e-10);
}

void PathTracer::record(const Stepping& stepping, double load_factor, std::vector<double> errors) {
  path_.states.push_back({load_factor, path_.systems.size() - 1, stepping.state(),
                          stepping.unstable_directions(), std::move(errors), reaction_error_});
}

void PathTracer::note_changes(const Stepping& stepping) {
  for (; changes_noted_ < stepping.changes().size(); ++changes_noted_) {
    const StabilityChange& change = stepping.changes()[changes_noted_];
    path_.events.push_back({change.after > change.before ? "stability lost" : "stability gained",
                            change.load_factor, path_.systems.size() - 1,
                            change.z.empty() ? stepping.state() : change.z, change.after});
  }
}

void PathTracer::stop(const SteppingSummary& summary) {
  path_.termination.status = Status::stopped;
  if (summary.outcome == SteppingOutcome::limit_point) {
    path_.events.push_back(
        {"limit point", summary.load_factor, path_.systems.size() - 1, summary.limit_state, 1});
    if (!options_.prescribed.empty()) {
      path_.termination.reason = fmt::format(
          "the prescribed displacement turns back at load factor {:.6g}: from there the mechanism "
          "snaps, whatever force holds it. Prescribe less, or prescribe another point",
          summary.load_factor);
      return;
    }
    path_.termination.reason = fmt::format(
        "limit point at load factor {0:.6g}: along this path the mechanism carries no more of its "
        "loads, and snaps away. Scale the loads by {1:.4g} or less",
        summary.load_factor, rounded_down(summary.load_factor));
    if (const auto lost = stability_lost())
      path_.termination.reason += fmt::format(
          "; but it has been unstable from load factor {:.6g} on, and leaves this path there",
          *lost);
    return;
  }
  if (summary.outcome == SteppingOutcome::wound_up) {
    path_.termination.reason = fmt::format(
        "at load factor {:.6g} the ends of a flexure have turned against each other by more than "
        "three turns: it winds up like a spring, under loads far beyond what bends it. Smaller "
        "loads will do; are their units right?",
        summary.load_factor);
    return;
  }
  path_.termination.reason = fmt::format(
      "no way on past load factor {:.6g}: Newton's method fails there at every step size, and the "
      "path could not be followed by arc length either. Smaller loads, more steps, or another "
      "modeling will show where the path leads",
      summary.load_factor);
  if (const auto lost = stability_lost())
    path_.termination.reason += fmt::format(
        "; it has been unstable from load factor {:.6g} on, where a mechanism with the smallest "
        "imperfection leaves this path: control = \"arc_length\" with `branch`, or a shape that is "
        "off by a little, follows it",
        *lost);
}

/// The load factor at which the path has first become unstable.
std::optional<double> PathTracer::stability_lost() const {
  for (const TracedEvent& event : path_.events)
    if (event.kind == "stability lost") return event.load_factor;
  return {};
}

Termination PathTracer::singular_start() {
  return {Status::stopped, describe_singular(model_, system().softest_body())};
}

}  // namespace

double algebraic_tolerance(double tolerance) { return std::clamp(1e-2 * tolerance, 1e-13, 1e-6); }

bool chooses_modes(const ModelingSettings& settings) {
  const auto* exact = std::get_if<ExactSettings>(&settings.kind);
  return exact && !exact->modes;
}

std::vector<TrackedPoint> tracked_points(const Model& model) {
  std::vector<TrackedPoint> points;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed)
      for (const Point& point : model.bodies[b].points) points.push_back({b, point.position});
  if (!points.empty()) return points;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) points.push_back({b, body_centre(model, b)});
  return points;
}

TracedPath trace_path(const Model& model, const std::vector<Load>& loads,
                      const ModelingSettings& settings, const TraceOptions& options) {
  constexpr int most_restarts = 2;
  int spent = 0;
  for (int refinements = 0;; ++refinements) {
    PathTracer tracer(model, loads, settings, options, refinements);
    TracedPath path = tracer.run();
    // a load step by too few modes may lead astray: from the start by more, then
    path.iterations = spent += path.iterations;
    if (!tracer.needs_finer_start() || refinements == most_restarts) return path;
  }
}

}  // namespace flexura

#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <vector>

#include "flexura/solvers/newton.hpp"

namespace flexura {

/// Equilibrium equations under loads that all grow with one load factor. `load_direction` is
/// dz/d(load factor) of the last linearization; `inner` a scalar product of changes of z,
/// dimensionless.
template <class P>
concept LoadedProblem = NewtonProblem<P> &&
    requires(P p, const std::vector<double>& z, std::vector<double>& direction) {
  p.set_load_factor(1.0);
  p.load_direction(direction);
  { p.unstable_directions() } -> std::convertible_to<int>;
  { p.strain_energy() } -> std::convertible_to<double>;
  { p.load_displacement(z) } -> std::convertible_to<double>;
  { p.load_rate(z) } -> std::convertible_to<double>;
  { p.has_follower_loads() } -> std::convertible_to<bool>;
  { p.inner(z, z) } -> std::convertible_to<double>;
};

/// A state of a path with its unit tangent (tangent_z, tangent_load).
struct ArcState {
  double load_factor = 0.0;
  std::vector<double> z;
  std::vector<double> tangent_z;
  double tangent_load = 0.0;
};

/// Pseudo-arc-length steps along a path. Lengths are those of (z, load_scale * load factor), with z
/// measured by the problem's `inner`. A scale of the size of dz/d(load factor) lets a path that
/// turns off within displacements of a millionth be seen to do so; by 1, such a turn is nothing
/// beside the load factor's own part, and a step leads past it.
template <LoadedProblem Problem>
class ArcLength {
 public:
  ArcLength(Problem& problem, double tolerance) : problem_(&problem), tolerance_(tolerance) {}

  void set_load_scale(double scale) { load_scale_ = scale; }
  /// The unit tangent, in the sense of `before` or else of a growing load factor. Precondition: the
  /// problem is linearized at the state. False where the tangent has no direction.
  bool set_tangent(ArcState& state, const ArcState* before);
  /// The state at the given distance along the tangent, on the plane across it; the problem is then
  /// linearized there.
  bool step(const ArcState& from, double size, ArcState& to);
  /// Whether the path heads along a step at both of its ends, to within an angle (25 degrees): only
  /// a short step can leave the path and still do that.
  bool heads_along(const ArcState& from, const ArcState& to, double least_cosine = 0.906) const;
  /// The limit point between two neighbouring states (see below).
  bool locate(const ArcState& before, double size, ArcState& limit);
  int iterations() const { return iterations_; }

 private:
  using State = ArcState;

  Problem* problem_;
  double tolerance_;
  double load_scale_ = 1.0;
  int iterations_ = 0;
};

/// Precondition: the problem is linearized at the state. Keeps the sense of `before`.
template <LoadedProblem Problem>
bool ArcLength<Problem>::set_tangent(ArcState& state, const ArcState* before) {
  problem_->load_direction(state.tangent_z);
  const double weight = load_scale_ * load_scale_;
  const double size = std::sqrt(weight + problem_->inner(state.tangent_z, state.tangent_z));
  if (!std::isfinite(size)) return false;
  double sense = 1.0;
  if (before &&
      problem_->inner(before->tangent_z, state.tangent_z) + weight * before->tangent_load < 0.0)
    sense = -1.0;
  state.tangent_load = sense / size;
  for (double& t : state.tangent_z) t *= sense / size;
  return true;
}

/// Corrects on the plane across the tangent at the given distance:
/// dz = step + d(load factor) direction, and one scalar equation for d(load factor).
template <LoadedProblem Problem>
bool ArcLength<Problem>::step(const ArcState& from, double size, ArcState& to) {
  to.z = from.z;
  add_scaled(to.z, size, from.tangent_z);
  to.load_factor = from.load_factor + size * from.tangent_load;
  const double weight = load_scale_ * load_scale_;
  std::vector<double> correction, direction;
  double before = INFINITY;
  for (int k = 0; k < 20; ++k) {
    problem_->set_load_factor(to.load_factor);
    ++iterations_;
    if (!problem_->linearize(to.z)) return false;
    problem_->newton_step(correction);
    problem_->load_direction(direction);
    std::vector<double> gone = to.z;
    add_scaled(gone, -1.0, from.z);
    const double gap = problem_->inner(from.tangent_z, gone) +
                       weight * from.tangent_load * (to.load_factor - from.load_factor) - size;
    const double change = -(gap + problem_->inner(from.tangent_z, correction)) /
                          (problem_->inner(from.tangent_z, direction) + weight * from.tangent_load);
    add_scaled(correction, change, direction);
    add_scaled(to.z, 1.0, correction);
    to.load_factor += change;
    const double moved = std::sqrt(problem_->inner(correction, correction));
    // at first, what is inside the flexures may settle before the bodies do
    if (!std::isfinite(moved) || (k > 2 && moved > 2.0 * before)) return false;
    if (moved <= std::max(tolerance_, 1e-12) || (moved < 1e-8 && moved > 0.3 * before)) {
      problem_->set_load_factor(to.load_factor);
      ++iterations_;
      return problem_->linearize(to.z) && set_tangent(to, &from);
    }
    before = moved;
  }
  return false;
}

template <LoadedProblem Problem>
bool ArcLength<Problem>::heads_along(const ArcState& from, const ArcState& to,
                                     double least_cosine) const {
  std::vector<double> gone = to.z;
  add_scaled(gone, -1.0, from.z);
  const double rise = load_scale_ * (to.load_factor - from.load_factor);
  const double length = std::sqrt(problem_->inner(gone, gone) + rise * rise);
  const auto along = [&](const ArcState& state) {
    return problem_->inner(gone, state.tangent_z) + rise * load_scale_ * state.tangent_load;
  };
  return along(from) > least_cosine * length && along(to) > least_cosine * length;
}

/// The arc length past `before` at which the load factor stands still, by regula falsi on the
/// tangent's load component, with bisection every third time. `limit`, the end of that stretch,
/// becomes the state nearest to it. At the point itself the equations are singular: failing there
/// is as near as it gets, and near it the load factor is right to the square of the distance.
template <LoadedProblem Problem>
bool ArcLength<Problem>::locate(const ArcState& before, double size, ArcState& limit) {
  double low = 0.0, high = size;
  // seen along the way the load factor goes at first
  const double sense = before.tangent_load < 0.0 ? -1.0 : 1.0;
  double at_low = sense * before.tangent_load, at_high = sense * limit.tangent_load;
  // the tangent's load component has no scale of its own: huge loads make it tiny everywhere
  const double steepness = std::max(std::abs(at_low), std::abs(at_high));
  for (int k = 0; k < 60 && high - low > 1e-10 * size; ++k) {
    double middle = low + (high - low) * at_low / (at_low - at_high);
    if (k % 3 == 2) middle = 0.5 * (low + high);
    State trial;
    if (!step(before, middle, trial)) break;
    const double slope = sense * trial.tangent_load;
    (slope > 0.0 ? low : high) = middle;
    (slope > 0.0 ? at_low : at_high) = slope;
    if (std::abs(trial.tangent_load) < std::abs(limit.tangent_load)) limit = std::move(trial);
    if (std::abs(limit.tangent_load) < 1e-8 * steepness) break;
  }
  return std::abs(limit.tangent_load) < 1e-3 * steepness;
}

}  // namespace flexura

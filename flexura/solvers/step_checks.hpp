#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flexura/solvers/arc_length.hpp"
#include "flexura/solvers/hermite_predictor.hpp"

/// What tells a load step along one path from a jump to another one. A small residual does not.
namespace flexura {

/// The energy stored at a point of a path, and what its loads' work comes of.
struct PathEnergy {
  double strain = 0.0;
  double displacement = 0.0;  ///< work of the loads per load factor
  double rate = 0.0;          ///< its derivative by the load factor
};

template <LoadedProblem Problem>
double distance(const Problem& problem, const std::vector<double>& a,
                const std::vector<double>& b) {
  std::vector<double> gone = b;
  add_scaled(gone, -1.0, a);
  return std::sqrt(problem.inner(gone, gone));
}

/// Sets the slope dz/d(load factor), too. Precondition: the problem is linearized at z.
template <LoadedProblem Problem>
PathEnergy measure_energy(Problem& problem, const std::vector<double>& z,
                          std::vector<double>& slope) {
  problem.load_direction(slope);
  double stored = 0.0;
  if constexpr (requires { problem.stored_energy(z); })
    stored = problem.stored_energy(z);
  else
    stored = problem.strain_energy();
  return {stored, problem.load_displacement(z), problem.load_rate(slope)};
}

/// A step along one path goes where the path heads at its start and at its end, to within 60
/// degrees, and about as far as its slopes there say. Past a nearly symmetric bifurcation, a step
/// onto the mirrored branch does not, though its energy may be right; a step past a small snap
/// goes too far.
template <LoadedProblem Problem>
bool goes_on(const Problem& problem, const CurvePoint& from, const CurvePoint& to) {
  std::vector<double> gone = to.value;
  add_scaled(gone, -1.0, from.value);
  const double length = problem.inner(gone, gone);
  const auto heads_there = [&](const std::vector<double>& slope) {
    const double along = problem.inner(gone, slope);
    return along > 0.0 && along * along > 0.25 * length * problem.inner(slope, slope);
  };
  if (!heads_there(from.slope) || !heads_there(to.slope)) return false;
  const double half = 0.5 * (to.parameter - from.parameter);
  add_scaled(gone, -half, from.slope);
  add_scaled(gone, -half, to.slope);
  return problem.inner(gone, gone) < 0.25 * length;
}

/// Where slopes at both ends of a step differ much, the path may have turned off in between: then
/// the middle of the cubic through both ends must nearly be an equilibrium too, with as many
/// unstable directions as one of the ends.
template <LoadedProblem Problem>
bool middle_fits(Problem& problem, const CurvePoint& from, const CurvePoint& to,
                 const std::array<int, 2>& unstable, int& iterations) {
  const double h = to.parameter - from.parameter;
  const double moved = distance(problem, from.value, to.value);
  if (h * distance(problem, from.slope, to.slope) < 0.3 * moved) return true;
  std::vector<double> middle;
  extrapolate_hermite({from, to}, from.parameter + 0.5 * h, middle);
  problem.set_load_factor(from.parameter + 0.5 * h);
  ++iterations;
  if (!problem.linearize(middle)) return false;
  std::vector<double> correction;
  const int here = problem.unstable_directions();
  return problem.newton_step(correction) < 0.1 * moved &&
         (here == unstable[0] || here == unstable[1]);
}

/// Along one smooth path of a conservative system, d(strain energy) = load factor d(displacement of
/// the loads), so the gain is [load factor * displacement] less the integral of the displacement,
/// here of its cubic Hermite interpolant. A jump to another branch breaks this.
template <LoadedProblem Problem>
bool work_is_smooth(const Problem& problem, double from, const PathEnergy& before, double to,
                    const PathEnergy& now) {
  if (problem.has_follower_loads()) return true;
  const double h = to - from;
  const double integral =
      0.5 * h * (before.displacement + now.displacement) + h * h / 12.0 * (before.rate - now.rate);
  const double work = to * now.displacement - from * before.displacement - integral;
  const double gain = now.strain - before.strain;
  const double size = std::max({std::abs(work), std::abs(gain), 1e-6 * std::abs(now.strain)});
  return std::abs(work - gain) <= 0.1 * size;
}

}  // namespace flexura

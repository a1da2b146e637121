#pragma once

#include <vector>

#include "flexura/results/result.hpp"

namespace flexura::sample {

/// A dead load at the last body's point.
struct TipLoad {
  Vec2 force;
  double moment = 0.0;
};

/// Rigid segments joined by torsion springs: enough mechanics to give the tests of reports
/// plausible shapes, and independent of every solver of the library.
struct Joint {
  Vec2 at;
  double compliance = 0.0;  ///< rotation per moment
  std::size_t flexure = 0;
};

/// Three circular arcs in series between ground and three bodies, the last one carrying E.
struct Chain {
  Drawing drawing;
  Vec2 tip;
  std::vector<Joint> joints;
  std::size_t joints_per_flexure = 0;
};

/// `joints_per_flexure` springs a flexure; 3 looks like a pseudo-rigid-body model.
Chain make_chain(std::size_t joints_per_flexure, double stiffness_factor = 1.0);

/// Joint rotations in equilibrium, found from `start` by Newton's method.
std::vector<double> solve_chain(const Chain& chain, const TipLoad& load, std::vector<double> start);

/// Joint rotations to first order.
std::vector<double> solve_linear(const Chain& chain, const TipLoad& load);

/// The state with these joint rotations; `small` moves everything by u + phi x r.
PathState make_state(const Chain& chain, const std::vector<double>& rotations, double load_factor,
                     bool small);

/// Section forces along the drawn axes of a state.
std::vector<std::vector<MemberStation>> make_members(const PathState& state, const TipLoad& load);

}  // namespace flexura::sample

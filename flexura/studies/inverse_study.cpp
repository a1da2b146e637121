#include "flexura/studies/inverse_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/newton.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/reaction_difference.hpp"

namespace flexura {
namespace {

/// Displacements are small or not: x = centre + u + R(rotation) arm, R to first order where
/// kinematics are linearised.
Vec2 turned(double rotation, Vec2 arm, bool linearised) {
  return linearised ? arm + rotation * perp(arm) : rotate(rotation, arm);
}

/// A relative displacement with the places it is about, as drawn.
struct PlacedRelative {
  RelativeDisplacement relative;
  Vec2 base_end;
  Vec2 at;
};

std::vector<PlacedRelative> place_relatives(const Model& model, const InverseStudy& study,
                                            const ModelingSettings& settings) {
  std::vector<PlacedRelative> placed;
  for (const RelativeDisplacement& relative : study.relative) {
    const FlexureProperties flexure =
        flexure_properties(model, model.flexures[relative.flexure], settings.axial, settings.shear);
    const Vec2 end = flexure.axis.position(flexure.axis.length());
    const Vec2 at = relative.at == RelativeDisplacement::At::end
                        ? end
                        : elastic_centre(compliance_matrix(flexure, end), end);
    placed.push_back({relative, flexure.axis.position(0.0), at});
  }
  return placed;
}

/// Walks from the fixed bodies over the prescribed flexures; the model's validation saw to it that
/// this reaches every moving body once.
std::vector<Pose> place_bodies(const Model& model, const std::vector<PlacedRelative>& placed,
                               double factor, bool linearised) {
  std::vector<Pose> poses;
  std::vector<bool> known;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    poses.push_back({body_centre(model, b), 0.0});
    known.push_back(model.bodies[b].fixed);
  }
  const std::vector<Pose> drawn = poses;
  for (bool progress = true; progress;) {
    progress = false;
    for (const PlacedRelative& p : placed) {
      const Flexure& flexure = model.flexures[p.relative.flexure];
      const std::size_t a = flexure.base;
      const std::size_t b = flexure.action;
      if (known[a] == known[b]) continue;
      const double turn = factor * p.relative.rotation;
      const Vec2 chord = p.at - p.base_end;
      // where the tip's point lies from the base end, seen from the base body turned by `rotation`
      const auto reach = [&](double rotation) {
        if (linearised) return chord + rotation * perp(chord) + factor * p.relative.displacement;
        return rotate(rotation, chord + factor * p.relative.displacement);
      };
      if (known[a]) {
        poses[b].rotation = poses[a].rotation + turn;
        poses[b].position = poses[a].position +
                            turned(poses[a].rotation, p.base_end - drawn[a].position, linearised) +
                            reach(poses[a].rotation) -
                            turned(poses[b].rotation, p.at - drawn[b].position, linearised);
        known[b] = true;
      } else {
        poses[a].rotation = poses[b].rotation - turn;
        poses[a].position = poses[b].position +
                            turned(poses[b].rotation, p.at - drawn[b].position, linearised) -
                            reach(poses[a].rotation) -
                            turned(poses[a].rotation, p.base_end - drawn[a].position, linearised);
        known[a] = true;
      }
      progress = true;
    }
  }
  return poses;
}

System make_held_system(const Model& model, const ModelingSettings& settings) {
  SystemLayout layout = make_layout(model, {}, settings);
  for (auto& body : layout.bodies) body.moves = false;
  return System(std::move(layout));
}

PathState make_state(const Model& model, const System& system, const std::vector<double>& z,
                     double factor) {
  PathState state = make_path_state(model, system, z, factor);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Eigen::Vector3d r = system.reaction(b, z);
    state.reactions.push_back({{r[0], r[1]}, r[2]});
  }
  state.strain_energy = system.strain_energy();
  return state;
}

std::string why_not(NewtonOutcome outcome, double factor) {
  if (outcome == NewtonOutcome::diverged)
    return fmt::format(
        "no equilibrium found at factor {:.6g}, by steps of any size: ask for smaller "
        "displacements",
        factor);
  return "a flexure cannot follow prescribed displacements by this modeling: without axial "
         "strain, a straight one has a single length";
}

}  // namespace

ModelingPath run_inverse(const Model& model, const InverseStudy& study,
                         const ModelingSettings& settings,
                         const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<PlacedRelative> placed = place_relatives(model, study, settings);
  System system = make_held_system(model, settings);
  std::vector<double> z = system.initial_state();

  ModelingPath path;
  path.label = settings.label;
  path.modeling = modeling_name(settings);
  path.unknowns = static_cast<int>(system.modeled_size());
  path.termination.status = Status::converged;
  Newton newton({1e-12, 40, 8});
  const auto hold_at = [&](double factor) {
    const std::vector<Pose> poses = place_bodies(model, placed, factor, system.linearised());
    for (std::size_t b = 0; b < poses.size(); ++b) system.hold(b, poses[b]);
  };
  double reached = 0.0;
  for (int step = 0; step <= study.steps; ++step) {
    const double factor = static_cast<double>(step) / study.steps;
    NewtonSummary summary;
    // a step too large for Newton's method is taken in parts
    const double smallest = 1e-4 * (factor - reached);
    for (double part = factor - reached; part >= smallest;) {
      const double to = factor - reached - part < smallest ? factor : reached + part;
      hold_at(to);
      summary = newton.solve(system, z);
      path.iterations += summary.iterations;
      if (step == 0) break;
      if (summary.outcome == NewtonOutcome::converged) {
        reached = to;
        if (to == factor) break;
        part = std::min(2.0 * part, factor - reached);
      } else {
        part *= 0.5;
      }
    }
    if (summary.outcome != NewtonOutcome::converged || !system.linearize(z)) {
      path.termination = {Status::stopped, why_not(summary.outcome, factor)};
      hold_at(reached);  // where the last state is, for its section forces
      break;
    }
    path.states.push_back(make_state(model, system, z, factor));
    if (step > 0) ++path.steps;
    if (!keep_going(factor)) {
      path.termination = {Status::stopped, fmt::format("cancelled at factor {:.6g}", factor)};
      break;
    }
  }
  path.members = make_members(model, system, z);
  path.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return path;
}

void compare_reactions(PathResult& result) {
  const ModelingPath& reference = result.modelings[result.reference];
  for (std::size_t m = 0; m < result.modelings.size(); ++m) {
    ModelingPath& path = result.modelings[m];
    const std::size_t states = std::min(path.states.size(), reference.states.size());
    if (m == result.reference || states < 2) continue;  // the start alone says nothing
    path.difference = reaction_difference(path, reference);
  }
}

}  // namespace flexura

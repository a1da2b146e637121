#pragma once

#include <vector>

#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"
#include "flexura/studies/mechanism_state.hpp"

namespace flexura {

/// A state as poses, points, drawn axes and peak stresses, in the order of the model's moving
/// bodies, their points, and its flexures.
PathState make_path_state(const Model& model, const MechanismState& mechanism, double load_factor);
PathState make_path_state(const Model& model, const System& system, const std::vector<double>& z,
                          double load_factor);

/// Sections, forces and stress along every flexure.
std::vector<std::vector<MemberStation>> make_members(const Model& model,
                                                     const MechanismState& mechanism);
std::vector<std::vector<MemberStation>> make_members(const Model& model, const System& system,
                                                     const std::vector<double>& z);

/// The names that go with path states, and the flexures' strengths.
PathResult make_path_names(const Model& model);

}  // namespace flexura

#pragma once

#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"
#include "flexura/studies/mechanism_state.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// Stress fields of all flexures that have them, axes and places global.
std::vector<FieldState::OfFlexure> make_fields(const Model& model, const MechanismState& mechanism);

/// The estimate over all of them: absent without any.
std::optional<double> stress_error(const std::vector<FieldState::OfFlexure>& fields);
std::optional<LargestStress> largest_stress(const std::vector<FieldState::OfFlexure>& fields);

/// Fills the path's fields as the study asks for them, and what is said of those of its last state.
void add_fields(const Model& model, const PathStudy& study, const TracedPath& traced,
                ModelingPath& path);

}  // namespace flexura

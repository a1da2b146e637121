#pragma once

#include <vector>

#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// What a driven mechanism passes on its traced path: where the driving force comes to a halt, and
/// where it vanishes. Located between output states, by solving for equilibria on the path, to
/// 1e-10 of the load factor; two that lie between the same two output states are not seen. Empty
/// unless the study has no loads and exactly one prescribed component that is not held at zero.
std::vector<ReactionEvent> find_reaction_events(const Model& model, const PathStudy& study,
                                                const TracedPath& traced);

}  // namespace flexura

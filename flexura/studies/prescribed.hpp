#pragma once

#include <vector>

#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// Imposes displacements on a mechanism, component by component in the order of the list.
void add_prescribed(SystemLayout& layout, const Model& model,
                    const std::vector<Prescribed>& prescribed);

/// The bodies and points that a list holds, each once.
std::vector<HeldPlace> held_places(const Model& model, const std::vector<Prescribed>& prescribed);

/// What holds them in a state: the reactions of `held_places`, in their order.
std::vector<Reaction> reactions_in(const System& system, const std::vector<Prescribed>& prescribed,
                                   const std::vector<double>& z);

}  // namespace flexura

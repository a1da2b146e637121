#pragma once

#include <functional>
#include <vector>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// Imposes displacements on a mechanism, component by component in the order of the list.
void add_prescribed(SystemLayout& layout, const Model& model,
                    const std::vector<Prescribed>& prescribed);

/// The same of a mechanism in motion, with their histories.
void add_prescribed(MotionLayout& layout, const Model& model,
                    const std::vector<Prescribed>& prescribed);

/// The model's drivers, then the list: a driven body is held at its centre and turned, or moved
/// along a direction and not turned.
std::vector<Prescribed> with_drivers(const Model& model, std::vector<Prescribed> prescribed);

/// The bodies and points that a list holds, each once.
std::vector<HeldPlace> held_places(const Model& model, const std::vector<Prescribed>& prescribed);

/// What holds them: the reactions of `held_places`, in their order, from that of every component of
/// the list.
std::vector<Reaction> reactions_of(const std::vector<Prescribed>& prescribed,
                                   const std::function<double(std::size_t)>& reaction);
/// Of an equilibrium.
std::vector<Reaction> reactions_in(const System& system, const std::vector<Prescribed>& prescribed,
                                   const std::vector<double>& z);

}  // namespace flexura

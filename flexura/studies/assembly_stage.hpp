#pragma once

#include <vector>

#include "flexura/model/model.hpp"
#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// Puts the mechanism of the path's last system together, from the drawn state: closes misfits,
/// lets springs have their free lengths, brings constant loads. Leaves the system ready for loads
/// and `z` at load factor 0; false, with the reason as the path's termination, where that fails.
bool assemble(const Model& model, double tolerance, TracedPath& path, std::vector<double>& z);

}  // namespace flexura

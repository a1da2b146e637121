#pragma once

#include "flexura/studies/path_tracer.hpp"

namespace flexura {

/// Follows the equilibria of one modeling by arc length, through limit points and past (or, on
/// request, off at) bifurcations. States are those the continuation took; the last one has the load
/// factor asked for, if that ends the path. `refinements`: how often the flexures are refined
/// beforehand.
TracedPath trace_by_arc_length(const Model& model, const PathStudy& study,
                               const ModelingSettings& settings,
                               const std::function<bool(double)>& keep_going, int refinements = 0);

}  // namespace flexura

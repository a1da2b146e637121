#pragma once

#include <vector>

#include "flexura/model/model.hpp"

namespace flexura::bench {

/// The open chain of three circular-arc flexures (examples/arc_chain.toml), mm and N.
Model arc_chain();

/// Its load case LC1: 1e-3 N along x at the point E.
std::vector<Load> arc_chain_load();

}  // namespace flexura::bench

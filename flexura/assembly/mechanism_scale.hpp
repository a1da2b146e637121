#pragma once

#include "flexura/assembly/system_layout.hpp"

namespace flexura {

/// What a mechanism's unknowns are measured by, so that solvers may add lengths to angles and
/// forces to moments.
struct MechanismScale {
  double length = 1.0;
  double energy = 1.0;  ///< of bending one flexure by a radian
};

/// The flexures' mean length and geometric mean energy. Without flexures, how far bodies lie apart,
/// and the springs' energies over that length, or a radian.
MechanismScale scale_of(const SystemLayout& layout);

}  // namespace flexura

#pragma once

#include "flexura/model/model.hpp"

namespace flexura::testing {

/// The same mechanism drawn elsewhere: turned about the origin, then shifted.
Model moved_rigidly(Model model, double angle, Vec2 shift);
Load turned(Load load, double angle);

/// The same mechanism in another unit of length, `factor` of the new ones to an old one (1e-3: from
/// mm to m). Forces keep their unit.
Model in_other_length_unit(Model model, double factor);
Load in_other_length_unit(Load load, double factor);

/// The same mechanism with one flexure drawn the other way round: base and action swapped.
Model with_reversed_flexure(Model model, std::size_t flexure);

/// The same mechanism with one flexure (a line or an arc) cut at mid-length, the halves joined by a
/// body of their own.
Model with_halved_flexure(Model model, std::size_t flexure);

}  // namespace flexura::testing

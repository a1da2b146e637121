#pragma once

#include <optional>

#include "flexura/io/model_reader.hpp"
#include "flexura/io/reading.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// Reads `[units]` and sets reading.units.
UnitNames read_units(Reading& reading, const Place& place);

/// Reads `[parameters]`, if there are any, replaces those overridden, and makes all values known
/// to the reading's formulas. Parameters may be expressions of one another in any order.
void read_parameters(Reading& reading, const std::optional<Place>& place,
                     const ParameterOverrides& overrides);

}  // namespace flexura

#pragma once

#include <vector>

#include "flexura/model/model.hpp"
#include "flexura/results/result.hpp"

namespace flexura {

/// The undeformed mechanism, to scale.
Drawing make_drawing(const Model& model);

std::vector<DrawnLoad> make_drawn_loads(const Model& model, const std::vector<Load>& loads);

/// With their histories from 0 to `end`, a time or an angle.
std::vector<DrawnLoad> make_drawn_loads(const Model& model, const std::vector<Load>& loads,
                                        double end);

DrawnFields make_drawn_fields(const FieldLoads& fields);

}  // namespace flexura

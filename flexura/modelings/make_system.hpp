#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "flexura/assembly/system.hpp"
#include "flexura/model/model.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// A modeling applied to a model under loads, Model in, System(layout) out. Bodies keep their
/// indices, flexures become members in the same order. `load_ratios`: per flexure, what Howell's
/// pseudo-rigid-body model takes for its load ratio (see pseudo_rigid_chain); empty for all other
/// modelings.
SystemLayout make_layout(const Model& model, const std::vector<Load>& loads,
                         const ModelingSettings& settings,
                         const std::vector<std::optional<double>>& load_ratios = {},
                         const FieldLoads& fields = {});

/// What acts along a flexure.
FlexureField field_on(const Model& model, std::size_t flexure, const FieldLoads& fields);

/// Whether the modeling's parameters depend on the loads it finds, and what load ratios the state z
/// gives: axial compression over transverse force of every flexure's end force, in axes of its
/// base section.
bool follows_load_ratio(const ModelingSettings& settings);
std::vector<std::optional<double>> find_load_ratios(const Model& model, const System& system,
                                                    const std::vector<double>& z);

}  // namespace flexura

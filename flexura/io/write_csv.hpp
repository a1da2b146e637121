#pragma once

#include <string>
#include <vector>

#include "flexura/io/csv_writer.hpp"
#include "flexura/results/mode_result.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// step, load_factor; for every moving body x, y, rotation and then x, y of its points; for every
/// flexure mid.x, mid.y, mid.rotation; with reactions, for every body reaction.x, .y, .moment.
/// Every number reads back to the same double; one that is not finite is an error.
CsvText make_path_csv(const PathResult& path, const ModelingPath& modeling);

/// flexure, s, x, y, rotation, axial_force, shear_force, bending_moment, stress of the last state.
CsvText make_members_csv(const std::vector<std::string>& flexures,
                         const std::vector<std::vector<MemberStation>>& members);

/// What the stage does in every state (see StageState); a cell without a value stays empty.
CsvText make_stage_csv(const ModelingPath& modeling);

/// mode, load_factor.
CsvText make_buckling_csv(const ModelingModes& modes);

/// mode, then the displacements as the places of make_path_csv: of every moving body x, y, rotation
/// and x, y of its points; of every flexure mid.x, mid.y, mid.rotation.
CsvText make_shapes_csv(const ModeResult& names, const ModelingModes& modes);

}  // namespace flexura

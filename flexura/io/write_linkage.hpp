#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flexura/io/csv_writer.hpp"
#include "flexura/results/linkage_result.hpp"

namespace flexura {

/// Names and texts of the files of a study of kind `linkage`; angles in `angle_unit` ("rad" or
/// "deg"):
/// frequencies.csv: angle, w1, w2, ..: angular frequencies, ascending;
/// followed.csv: the same, mode by mode through the turn;
/// response.csv: angle, then <method>.<flexure>.strain, .deflection, .axial_strain, .stress;
/// rigid.csv: angle, places of bodies and points, torque, shaking force and moment, reactions;
/// speeds.csv: the largest multiplier and strains over the mean speed;
/// <method>.<flexure>.stress.csv: stresses of both extreme fibres over angle and arc length;
/// <method>.csv: angle, then places of bodies and points as they move elastically.
std::vector<std::pair<std::string, CsvText>> make_linkage_files(const LinkageResult& linkage,
                                                                const std::string& angle_unit);

}  // namespace flexura

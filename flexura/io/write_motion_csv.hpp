#pragma once

#include "flexura/io/csv_writer.hpp"
#include "flexura/results/mode_result.hpp"
#include "flexura/results/motion_result.hpp"

namespace flexura {

/// mode, angular_frequency, frequency (cycles per time unit); negative where the mode is unstable.
CsvText make_modes_csv(const ModelingModes& modes);

/// load_factor, w1, w2, ..: the angular frequencies about the states of a path. A cell stays empty
/// where a state has fewer.
CsvText make_frequencies_csv(const ModelingModes& modes);

/// time, then the columns of make_path_csv behind its load factor.
CsvText make_motion_csv(const MotionResult& motion, const ModelingMotion& modeling);

/// time and the EnergyBalance of every state.
CsvText make_energy_csv(const ModelingMotion& modeling);

/// angular_frequency, frequency, then amplitude and phase (radians, in (-pi, pi]) of every place.
CsvText make_response_csv(const ResponseResult& response, const ModelingResponse& modeling);

}  // namespace flexura

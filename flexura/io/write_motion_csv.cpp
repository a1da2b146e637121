#include "flexura/io/write_motion_csv.hpp"

#include <algorithm>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "flexura/io/csv_places.hpp"
#include "flexura/results/response_peaks.hpp"

namespace flexura {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

}  // namespace

CsvText make_modes_csv(const ModelingModes& modes) {
  CsvWriter csv({"mode", "angular_frequency", "frequency"});
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const double value = modes.modes[k].value;
    csv.word(std::to_string(k + 1)).number(value).number(value / full_turn).end_row();
  }
  return std::move(csv).result();
}

CsvText make_frequencies_csv(const ModelingModes& modes) {
  std::size_t most = 0;
  for (const FrequencyPoint& point : modes.curve)
    most = std::max(most, point.angular_frequencies.size());
  std::vector<std::string> columns{"load_factor"};
  for (std::size_t k = 1; k <= most; ++k) columns.push_back("w" + std::to_string(k));
  CsvWriter csv(std::move(columns));
  for (const FrequencyPoint& point : modes.curve) {
    csv.number(point.load_factor);
    for (std::size_t k = 0; k < most; ++k) {
      const bool known = k < point.angular_frequencies.size();
      known ? csv.number(point.angular_frequencies[k]) : csv.word("");
    }
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText make_motion_csv(const MotionResult& motion, const ModelingMotion& modeling) {
  const auto points = points_by_body(motion);
  CsvWriter csv(state_columns(motion, {"time"}));
  for (const MotionState& moment : modeling.states) {
    csv.number(moment.time);
    add_state(csv, points, motion.held.size(), moment.state);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText make_energy_csv(const ModelingMotion& modeling) {
  CsvWriter csv({"time", "kinetic_energy", "strain_energy", "work", "dissipated", "energy_error",
                 "momentum_x", "momentum_y", "angular_momentum", "constraint_drift"});
  for (const MotionState& moment : modeling.states) {
    const EnergyBalance& e = moment.energy;
    csv.number(moment.time).number(e.kinetic).number(e.strain).number(e.work);
    csv.number(e.dissipated).number(e.error).vector(e.momentum);
    csv.number(e.angular_momentum).number(e.drift).end_row();
  }
  return std::move(csv).result();
}

CsvText make_response_csv(const ResponseResult& response, const ModelingResponse& modeling) {
  std::vector<std::string> columns{"angular_frequency", "frequency"};
  for (const std::string& place : response.places) {
    columns.push_back(place + ".amplitude");
    columns.push_back(place + ".phase");
  }
  CsvWriter csv(std::move(columns));
  for (const ResponseState& state : modeling.states) {
    csv.number(state.angular_frequency).number(state.angular_frequency / full_turn);
    for (const std::complex<double> u : state.amplitudes)
      csv.number(std::abs(u)).number(phase_of(u));
    csv.end_row();
  }
  return std::move(csv).result();
}

}  // namespace flexura

#include <complex>
#include <numbers>

#include "flexura/report/data_json.hpp"
#include "flexura/results/response_peaks.hpp"

namespace flexura::report_data {
namespace {

double cycles(double angular_frequency) {
  return rounded(angular_frequency / (2.0 * std::numbers::pi));
}

Json peaks_json(const ResponseResult& response, const ModelingResponse& modeling,
                std::size_t place) {
  Json list = Json::array();
  for (const ResponsePeak& peak : find_peaks(response, modeling, place)) {
    list.push_back({{"frequency", cycles(peak.angular_frequency)},
                    {"amplitude", rounded(peak.amplitude)},
                    {"phase", rounded(peak.phase)}});
  }
  return list;
}

Json modeling_json(const ResponseResult& response, const ModelingResponse& modeling) {
  Json json = modeling_head_json(modeling);
  Json& frequencies = json["frequencies"] = Json::array();
  for (const ResponseState& state : modeling.states)
    frequencies.push_back(cycles(state.angular_frequency));
  Json amplitudes = Json::array();
  Json phases = Json::array();
  Json peaks = Json::array();
  for (std::size_t place = 0; place < response.places.size(); ++place) {
    Json amplitude = Json::array();
    Json phase = Json::array();
    for (const ResponseState& state : modeling.states) {
      amplitude.push_back(rounded(std::abs(state.amplitudes[place])));
      phase.push_back(rounded(phase_of(state.amplitudes[place])));
    }
    amplitudes.push_back(std::move(amplitude));
    phases.push_back(std::move(phase));
    peaks.push_back(peaks_json(response, modeling, place));
  }
  json["amplitudes"] = std::move(amplitudes);
  json["phases"] = std::move(phases);
  json["peaks"] = std::move(peaks);
  return json;
}

}  // namespace

Json make_response_json(const ResponseResult& response) {
  Json places = Json::array();
  for (std::size_t place = 0; place < response.places.size(); ++place) {
    places.push_back(
        {{"name", response.places[place]}, {"rotation", is_rotation(response, place)}});
  }
  Json modelings = Json::array();
  for (const ModelingResponse& m : response.modelings)
    modelings.push_back(modeling_json(response, m));
  return {{"places", std::move(places)},
          {"damping", response.damping},
          {"reference", response.reference},
          {"modelings", std::move(modelings)}};
}

}  // namespace flexura::report_data

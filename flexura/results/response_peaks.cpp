#include "flexura/results/response_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexura {
namespace {

/// The largest amplitude of any place of the same kind: what rounding is measured by.
double largest_amplitude(const ResponseResult& response, const ModelingResponse& modeling,
                         bool rotation) {
  double largest = 0.0;
  for (const ResponseState& state : modeling.states)
    for (std::size_t p = 0; p < state.amplitudes.size(); ++p)
      if (is_rotation(response, p) == rotation)
        largest = std::max(largest, std::abs(state.amplitudes[p]));
  return largest;
}

}  // namespace

double phase_of(std::complex<double> amplitude) {
  const double phase = std::arg(amplitude);
  // A negative zero as imaginary part gives -pi, which is the same angle.
  return phase > -std::numbers::pi ? phase : std::numbers::pi;
}

bool is_rotation(const ResponseResult& response, std::size_t place) {
  return response.places[place].ends_with(".rotation");
}

std::vector<ResponsePeak> find_peaks(const ResponseResult& response,
                                     const ModelingResponse& modeling, std::size_t place,
                                     std::size_t most) {
  const std::vector<ResponseState>& states = modeling.states;
  const double least = 1e-9 * largest_amplitude(response, modeling, is_rotation(response, place));
  std::vector<ResponsePeak> peaks;
  for (std::size_t i = 1; i + 1 < states.size(); ++i) {
    const double amplitude = std::abs(states[i].amplitudes[place]);
    const bool is_peak = amplitude > std::abs(states[i - 1].amplitudes[place]) &&
                         amplitude >= std::abs(states[i + 1].amplitudes[place]);
    if (!is_peak || amplitude <= least) continue;
    peaks.push_back(
        {place, states[i].angular_frequency, amplitude, phase_of(states[i].amplitudes[place])});
  }
  if (peaks.size() > most) {
    std::ranges::nth_element(peaks, peaks.begin() + static_cast<std::ptrdiff_t>(most),
                             std::ranges::greater{}, &ResponsePeak::amplitude);
    peaks.resize(most);
    std::ranges::sort(peaks, {}, &ResponsePeak::angular_frequency);
  }
  return peaks;
}

}  // namespace flexura

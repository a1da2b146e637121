#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "flexura/results/motion_result.hpp"

namespace flexura {

/// The argument of a complex amplitude, in (-pi, pi].
double phase_of(std::complex<double> amplitude);

/// A local maximum of an amplitude among the frequencies that were computed.
struct ResponsePeak {
  std::size_t place = 0;  ///< index into ResponseResult::places
  double angular_frequency = 0.0;
  double amplitude = 0.0;
  double phase = 0.0;
};

/// The peaks of a place in the order of their frequencies: the largest `most` of them. A place
/// that moves by rounding alone has none.
std::vector<ResponsePeak> find_peaks(const ResponseResult& response,
                                     const ModelingResponse& modeling, std::size_t place,
                                     std::size_t most = 10);

/// Whether a place is the rotation of a body and no displacement.
bool is_rotation(const ResponseResult& response, std::size_t place);

}  // namespace flexura

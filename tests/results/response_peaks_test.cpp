#include "flexura/results/response_peaks.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace flexura {
namespace {

constexpr double pi = std::numbers::pi;

/// Two places, the second one nothing but rounding beside the first.
ResponseResult make_response(const std::vector<double>& amplitudes) {
  ResponseResult response;
  response.places = {"stage.x", "stage.y", "stage.rotation"};
  ModelingResponse modeling;
  double w = 1.0;
  for (const double a : amplitudes)
    modeling.states.push_back({w++, {{0.0, -a}, {1e-12 * a, 0.0}, {1e-12 * a, 0.0}}});
  response.modelings = {modeling};
  return response;
}

TEST(PhaseOf, LiesAboveMinusPi) {
  EXPECT_EQ(phase_of({0.0, 1.0}), pi / 2.0);
  EXPECT_EQ(phase_of({-1.0, 0.0}), pi);
  EXPECT_EQ(phase_of({-1.0, -0.0}), pi);
  EXPECT_EQ(phase_of({0.0, 0.0}), 0.0);
}

TEST(FindPeaks, AreLocalMaximaInTheOrderOfTheirFrequencies) {
  const ResponseResult response = make_response({5.0, 1.0, 2.0, 1.5, 4.0, 4.0, 3.0, 6.0});
  const auto peaks = find_peaks(response, response.modelings[0], 0);
  ASSERT_EQ(peaks.size(), 2U);  // ends are no peaks, and a flat top is one
  EXPECT_EQ(peaks[0].angular_frequency, 3.0);
  EXPECT_EQ(peaks[0].amplitude, 2.0);
  EXPECT_EQ(peaks[0].phase, -pi / 2.0);
  EXPECT_EQ(peaks[1].angular_frequency, 5.0);
}

TEST(FindPeaks, KeepsTheLargest) {
  const ResponseResult response = make_response({0.0, 3.0, 0.0, 1.0, 0.0, 2.0, 0.0});
  const auto peaks = find_peaks(response, response.modelings[0], 0, 2);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_EQ(peaks[0].amplitude, 3.0);
  EXPECT_EQ(peaks[1].amplitude, 2.0);
}

TEST(FindPeaks, TakesNoRoundingForMotion) {
  const ResponseResult response = make_response({0.0, 1.0, 0.0});
  EXPECT_TRUE(find_peaks(response, response.modelings[0], 1).empty());
  // A rotation is measured by rotations.
  EXPECT_EQ(find_peaks(response, response.modelings[0], 2).size(), 1U);
}

TEST(FindPeaks, CopesWithWhatNeverBegan) {
  ResponseResult response = make_response({});
  EXPECT_TRUE(find_peaks(response, response.modelings[0], 0).empty());
}

}  // namespace
}  // namespace flexura

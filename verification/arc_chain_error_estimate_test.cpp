// The error estimate of a fixed number of modes against the true error, which is the distance from
// the multiple-precision reference point: within 20 % wherever the truth is above what rounding
// leaves (1e-11 mm on displacements of some 10 mm). The estimate is the distance to four more
// modes, whose own error is smaller by orders of magnitude.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr Vec2 point_e{19.093, 15.750};

class ArcChainEstimate : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(ArcChainEstimate, IsWithinAFifthOfTheTrueErrorAtEveryStep) {
  const auto& [name, modes] = GetParam();
  const Mechanism chain = arc_chain();
  const double sign = name.ends_with("minus") ? -1.0 : 1.0;
  const Load load = name.starts_with("LC1") ? chain.load("link4.E", {sign * 1e-3, 0.0})
                                            : chain.load("link4", {}, sign * 1e-2);
  const TracedPath path = trace(chain, {load}, exact_modes(modes), 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;

  const ReferenceTable table("A_" + name + ".csv");
  double largest = 0.0, worst = 0.0;
  for (const std::size_t row : table.rows_where("theory", "iii")) {
    const auto step = static_cast<std::size_t>(table.number(row, "step"));
    const Vec2 e{table.number(row, "xE_mm"), table.number(row, "yE_mm")};
    const double truth = norm(point_in(path, step, 3, point_e) - e);
    ASSERT_EQ(path.states.at(step).errors.size(), 1U);
    const double estimate = path.states[step].errors[0];
    largest = std::max(largest, truth);
    if (truth <= 1e-11) continue;
    worst = std::max(worst, std::abs(estimate - truth) / truth);
    EXPECT_NEAR(estimate, truth, 0.2 * truth) << "step " << step;
  }
  note_measured("largest_true_error_mm", largest);
  note_measured("worst_deviation_of_estimate", worst);
}

INSTANTIATE_TEST_SUITE_P(Verification, ArcChainEstimate,
                         ::testing::Combine(::testing::Values("LC1_plus", "LC1_minus", "LC2_plus",
                                                              "LC2_minus"),
                                            ::testing::Values(4, 6, 8)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" +
                                  std::to_string(std::get<1>(test.param)) + "_modes";
                         });

}  // namespace
}  // namespace flexura::testing

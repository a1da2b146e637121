// Load case LC4 of the arc chain, along the direction of lesser compliance at E: nearly a
// bifurcation, where a step that is too long lands on another equilibrium with a perfect residual.
// Coarse and fine steps must end in one state, by every modeling. The end of LC4_minus by exact is
// that of the multiple-precision continuation with bounded jumps (reference README.md), printed
// with nine digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr Vec2 point_e{19.093, 15.750};
constexpr Vec2 direction{0.84553730656873649, 0.53391634475869576};

struct HardCase {
  std::string name;
  double force;
  ModelingSettings modeling;

  friend void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }
};

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> cases;
  for (const ModelingSettings& modeling : {exact(1e-10), exact_modes(12), beam(16, 1), beam(4, 4),
                                           scmbm_centre(), scmbm_end(), prbm()}) {
    std::string label = modeling.label;
    if (const auto* b = std::get_if<BeamSettings>(&modeling.kind))
      label += "_order_" + std::to_string(b->order);
    cases.push_back({"minus_" + label, -5.3e-4, modeling});
    cases.push_back({"plus_" + label, 2e-2, modeling});
  }
  return cases;
}

class ArcChainHardCase : public ::testing::TestWithParam<HardCase> {};

TEST_P(ArcChainHardCase, CoarseAndFineStepsEndInOneState) {
  const HardCase& hard = GetParam();
  const Mechanism chain = arc_chain();
  const Load load = chain.load("link4.E", hard.force * direction);
  Vec2 ends[2];
  for (const int steps : {20, 400}) {
    const TracedPath path = trace(chain, {load}, hard.modeling, steps);
    ASSERT_TRUE(path.termination.converged()) << steps << ": " << path.termination.reason;
    ends[steps == 400] = point_in(path, path.states.size() - 1, 3, point_e);
    EXPECT_EQ(path.states.back().unstable_directions, 0) << steps;
  }
  note_measured("difference_mm", norm(ends[1] - ends[0]));
  EXPECT_LT(norm(ends[1] - ends[0]), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Verification, ArcChainHardCase, ::testing::ValuesIn(hard_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(ArcChainHardCaseEnd, MinusEndsWhereTheReferenceDoes) {
  const Mechanism chain = arc_chain();
  const TracedPath path =
      trace(chain, {chain.load("link4.E", -5.3e-4 * direction)}, exact(1e-11), 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const Vec2 e = point_in(path, 20, 3, point_e);
  EXPECT_NEAR(e.x, 21.466382537, 1e-8);
  EXPECT_NEAR(e.y, -0.410779194, 1e-8);
  for (const TracedState& state : path.states) EXPECT_EQ(state.unstable_directions, 0);
}

}  // namespace
}  // namespace flexura::testing

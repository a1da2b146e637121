// A clamped-free column under a dead axial load turns unstable at P (1 - P/EA + P/GA_s) =
// pi^2 EI/(4 L^2): Euler's load with the shortening and the shear flexibility of the Haringx theory
// (reference README.md, where shooting agrees to 18 digits). 1e-8: a straight path asks for no more
// than the fewest moment modes, four, and those give the buckling load to 9e-9.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr double euler = std::numbers::pi * std::numbers::pi / 4.0;
const Stiffness stiffness{400.0, 1.0, 150.0};

/// The smaller root of P + k P^2 = euler, k = 1/GA - 1/EA.
double critical_load(const std::string& theory) {
  const double k = (theory == "iii" ? 1.0 / stiffness.shear : 0.0) -
                   (theory == "i" ? 0.0 : 1.0 / stiffness.axial);
  return 2.0 * euler / (1.0 + std::sqrt(1.0 + 4.0 * k * euler));
}

class Column : public ::testing::TestWithParam<std::string> {};

TEST_P(Column, LosesStabilityAtTheCriticalLoad) {
  const Mechanism column = cantilever(stiffness);
  const double critical = critical_load(GetParam());
  for (const ModelingSettings& modeling : {exact(1e-10), beam(8, 4)}) {
    const TracedPath path = trace(column, {column.load("tip", {-1.2 * euler, 0.0})},
                                  in_theory(modeling, GetParam()), 20);
    ASSERT_FALSE(path.events.empty()) << path.termination.reason;
    const TracedEvent& event = path.events[0];
    EXPECT_EQ(event.kind, "stability lost");
    EXPECT_EQ(event.unstable_directions, 1);
    const double found = 1.2 * euler * event.load_factor;
    note_measured(modeling.label, std::abs(found / critical - 1.0));
    EXPECT_NEAR(found, critical, 1e-8 * critical) << modeling.label;
    // it stays straight: nothing pushes it aside
    EXPECT_EQ(path.systems[event.system]->pose(1, event.z).position.y, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Verification, Column, ::testing::Values("i", "ii", "iii"),
                         [](const auto& test) { return "theory_" + test.param; });

/// Pushed aside by 1e-4 of the axial load, the column bends without losing stability and follows
/// the elastica: far above the critical load it stands on the side it was pushed to.
TEST(ColumnWithImperfection, BendsAwayWithoutLosingStability) {
  const Mechanism column = cantilever(stiffness);
  const TracedPath path = trace(column, {column.load("tip", {-1.5 * euler, 1.5e-4 * euler})},
                                in_theory(exact(), "i"), 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  EXPECT_TRUE(path.events.empty());
  for (const TracedState& state : path.states) EXPECT_EQ(state.unstable_directions, 0);
  const Pose tip = pose_in(path, 20, 1);
  EXPECT_GT(tip.position.y, 0.5);
  EXPECT_GT(tip.rotation, 1.0);
}

}  // namespace
}  // namespace flexura::testing

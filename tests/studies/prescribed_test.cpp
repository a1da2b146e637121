// What is prescribed gets where it was asked to go, and its reactions are the loads that would have
// taken it there.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/studies/path_study.hpp"
#include "flexura/studies/prescribed.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

Prescribed prescribe(std::size_t body, std::optional<double> x, std::optional<double> y,
                     std::optional<double> rotation) {
  return {body, {}, x, y, rotation};
}

PathStudy study_of(std::vector<Prescribed> prescribed, int steps) {
  PathStudy study;
  study.prescribe = std::move(prescribed);
  study.steps = steps;
  return study;
}

const auto go_on = [](double) { return true; };

/// The end of a path under loads, prescribed: its reactions must be those loads.
class PrescribedPath : public ::testing::TestWithParam<ModelingSettings> {};

TEST_P(PrescribedPath, ReactionsAreTheLoadsThatLeadThere) {
  Mechanism chain = arc_chain();
  const std::size_t last = chain.index("link4");
  const Load load = chain.load("link4", {1e-3, -2e-4}, 4e-3);
  const TracedPath loaded = trace(chain, {load}, GetParam(), 4);
  ASSERT_TRUE(loaded.termination.converged()) << loaded.termination.reason;
  const Pose start = pose_in(loaded, 0, last);
  const Pose end = pose_in(loaded, 4, last);
  const Vec2 moved = end.position - start.position;
  const ModelingPath path = run_path(
      chain, study_of({prescribe(last, moved.x, moved.y, end.rotation)}, 3), GetParam(), go_on);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const Reaction& reaction = path.states.back().reactions.at(0);
  EXPECT_NEAR(reaction.force.x, load.force.x, 1e-9 * 1e-3);
  EXPECT_NEAR(reaction.force.y, load.force.y, 1e-9 * 1e-3);
  EXPECT_NEAR(reaction.moment, load.moment, 1e-9 * 4e-3);
  EXPECT_EQ(path.states.back().unstable_directions, 0);
}

INSTANTIATE_TEST_SUITE_P(Modelings, PrescribedPath,
                         ::testing::Values(linear(), scmbm_centre(), prbm(), exact(), beam(8, 3)),
                         [](const auto& tested) { return tested.param.label; });

/// A cantilever whose tip is turned rolls up: moment EI phi/L, and no force.
TEST(Prescribed, RotationOfACantileverTakesAPureMoment) {
  const Mechanism beam = cantilever({1e6, 2.0, 1e6}, 3.0);
  const double turn = 1.5 * std::numbers::pi;
  const std::size_t tip = beam.index("tip");
  const ModelingPath path =
      run_path(beam, study_of({prescribe(tip, {}, {}, turn)}, 5), exact(), go_on);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  EXPECT_NEAR(path.states.back().reactions.at(0).moment, 2.0 * turn / 3.0, 1e-10);
  EXPECT_NEAR(norm(path.states.back().reactions.at(0).force), 0.0, 1e-12);
}

/// Guided sideways, u = F L^3/(12 EI) for small u, with the guiding moment F L/2.
TEST(Prescribed, ZeroHoldsARotation) {
  const Mechanism beam = cantilever({1e9, 2.0, 1e9}, 3.0);
  const std::size_t tip = beam.index("tip");
  const double y = 1e-6;
  const ModelingPath path =
      run_path(beam, study_of({prescribe(tip, {}, y, 0.0)}, 1), linear(), go_on);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const Reaction& reaction = path.states.back().reactions.at(0);
  EXPECT_NEAR(reaction.force.y, 12.0 * 2.0 / 27.0 * y, 1e-7 * y);
  EXPECT_NEAR(reaction.moment, -0.5 * 3.0 * reaction.force.y, 1e-7 * y);
  EXPECT_EQ(reaction.force.x, 0.0);
}

/// Two inclined struts (a von Mises truss) pushed through: at the drawn height h of half-span b the
/// force is zero, in the middle (unstable), and mirrored. Struts pinned at both ends and too stiff
/// to bend shorten by their axial force alone:
///     F(v) = 2 EA (L0 - L)/L0 (h - v)/L,  L^2 = b^2 + (h - v)^2.
TEST(Prescribed, TrussShowsItsSnapForcesAndEquilibria) {
  const double b = 10.0, h = 1.0, ea = 100.0;
  Mechanism truss;
  with_stiffness(truss, {ea, 1e3, 1e6});
  truss.fixed("ground").body("apex").centre({0, h});
  truss.flexure("ground", "apex", LineAxis{{-b, 0}, {0, h}}).pin_base().pin_action();
  truss.flexure("ground", "apex", LineAxis{{b, 0}, {0, h}}).pin_base().pin_action();
  const std::size_t apex = truss.index("apex");
  const ModelingPath path =
      run_path(truss, study_of({prescribe(apex, 0.0, -2.2 * h, {})}, 21), exact(), go_on);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;

  const double l0 = std::hypot(b, h);
  const auto force = [&](double v) {
    const double l = std::hypot(b, h - v);
    return -2.0 * ea * (l0 - l) / l0 * (h - v) / l;
  };
  // F' = 0 at L^3 = L0 b^2
  const double rise = std::sqrt(std::pow(l0 * b * b, 2.0 / 3.0) - b * b);
  std::vector<double> halts, zeros;
  std::vector<bool> stable;
  for (const ReactionEvent& event : path.reaction_events) {
    const double v = 2.2 * h * event.load_factor;
    if (event.kind == ReactionEvent::Kind::halt) {
      halts.push_back(v);
      EXPECT_NEAR(event.reaction, force(v), 1e-9);
    } else {
      zeros.push_back(v);
      stable.push_back(event.stable);
    }
  }
  ASSERT_EQ(halts.size(), 2u);
  EXPECT_NEAR(halts[0], h - rise, 1e-6);
  EXPECT_NEAR(halts[1], h + rise, 1e-6);
  ASSERT_EQ(zeros.size(), 3u);
  EXPECT_NEAR(zeros[1], h, 1e-8);
  EXPECT_NEAR(zeros[2], 2.0 * h, 1e-8);
  EXPECT_EQ(stable, (std::vector<bool>{true, false, true}));
}

}  // namespace
}  // namespace flexura::testing

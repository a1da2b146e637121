// Flexures with pinned ends, and mechanisms that can move without bending anything.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/studies/linear_study.hpp"
#include "flexura/studies/path_record.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

/// A simply supported beam of length 2 made of two halves, loaded at mid-span: F L^3/(48 EI).
TEST(Pinned, SimplySupportedBeam) {
  Mechanism beam_on_pins;
  with_stiffness(beam_on_pins, {1e6, 1.0, 1e6}).fixed("left").body("middle").fixed("right");
  beam_on_pins.flexure("left", "middle", LineAxis{{0.0, 0.0}, {1.0, 0.0}}).pin_base();
  beam_on_pins.flexure("middle", "right", LineAxis{{1.0, 0.0}, {2.0, 0.0}}).pin_action();
  const double force = 1e-6;
  for (const ModelingSettings& modeling :
       {linear(), exact(), beam(4, 2), scmbm_centre(), scmbm_end()}) {
    const Pose pose = final_pose(beam_on_pins, {beam_on_pins.load("middle", {0.0, -force})},
                                 in_theory(modeling, "ii"), 1);
    // 1e-6: what stretching carries at this small deflection, (EA/EI) y^2 = 3e-8, and then some
    EXPECT_NEAR(pose.position.y, -force * 8.0 / 48.0, 1e-6 * force) << modeling.label;
    EXPECT_NEAR(pose.rotation, 0.0, 1e-6 * force) << modeling.label;
  }
}

/// No moment at a pinned end. (Section forces of SCMBM balance on the flexure as drawn, and so do
/// not vanish at a pin once it has moved.)
TEST(Pinned, EndsCarryNoMoment) {
  Mechanism frame = portal_frame();
  Model model = frame.model();
  model.flexures[0].pinned_base = true;
  model.flexures[2].pinned_action = true;
  for (const ModelingSettings& modeling :
       {linear(), exact_modes(14), beam(4, 4), in_theory(prbm(), "i")}) {
    const TracedPath path = trace(model, {frame.load("left", {0.1, 0.0})}, modeling, 5);
    ASSERT_TRUE(path.termination.converged()) << modeling.label << path.termination.reason;
    const TracedState& last = path.states.back();
    const auto members = make_members(model, *path.systems[last.system], last.z);
    const double largest = std::abs(members[0].back().bending_moment);
    EXPECT_GT(largest, 0.01);
    EXPECT_LT(std::abs(members[0].front().bending_moment), 1e-6 * largest) << modeling.label;
    EXPECT_LT(std::abs(members[2].back().bending_moment), 1e-6 * largest) << modeling.label;
  }
}

/// Pins at both ends make a bar, EA/L along itself: two bars hold a joint, which has no rotation.
TEST(Pinned, TwoBarsHoldAJoint) {
  Mechanism truss;
  with_stiffness(truss, {100.0, 1.0, 100.0}).fixed("ground").body("joint");
  truss.flexure("ground", "joint", LineAxis{{-3.0, 0.0}, {0.0, 4.0}}).pin_base().pin_action();
  truss.flexure("ground", "joint", LineAxis{{3.0, 0.0}, {0.0, 4.0}}).pin_base().pin_action();
  const double force = 1e-5;
  const Pose pose = final_pose(truss, {truss.load("joint", {0.0, -force})}, exact(1e-10), 1);
  // 2 EA/L sin^2 = 2 (100/5) (4/5)^2
  EXPECT_NEAR(pose.position.y - 4.0, -force / 25.6, 1e-5 * force);
  EXPECT_NEAR(pose.position.x, 0.0, 1e-15);
  EXPECT_EQ(pose.rotation, 0.0);
}

/// A body on two pinned, parallel leaves swings freely.
Mechanism swing() {
  Mechanism swing;
  swing.material(210e3, 0.3).section(RectangleSection{0.5, 10.0});
  swing.fixed("ground").body("gondola").point("P", {20.0, -50.0});
  swing.flexure("ground", "gondola", LineAxis{{0.0, 0.0}, {0.0, -50.0}}).pin_base().pin_action();
  swing.flexure("ground", "gondola", LineAxis{{40.0, 0.0}, {40.0, -50.0}}).pin_base().pin_action();
  return swing;
}

TEST(Singular, APathStopsAndNamesTheBodyThatMoves) {
  const Mechanism mechanism = swing();
  const Load load = mechanism.load("gondola.P", {1.0, 0.0});
  for (const ModelingSettings& modeling : {linear(), exact(), in_theory(exact_modes(8), "i"),
                                           beam(4, 2), scmbm_centre(), in_theory(prbm(), "i")}) {
    const TracedPath path = trace(mechanism, {load}, modeling, 5);
    EXPECT_EQ(path.termination.status, Status::stopped) << modeling.label;
    EXPECT_NE(path.termination.reason.find("'gondola'"), std::string::npos)
        << modeling.label << ": " << path.termination.reason;
    EXPECT_TRUE(path.states.empty());
  }
}

TEST(Singular, ALinearStudyStopsAndNamesTheBodyThatMoves) {
  const Mechanism mechanism = swing();
  Termination termination;
  run_linear(mechanism, LinearStudy{}, termination);
  EXPECT_EQ(termination.status, Status::stopped);
  EXPECT_NE(termination.reason.find("'gondola'"), std::string::npos) << termination.reason;
}

/// Of several bodies the one that hangs loose is named, not one that is held.
TEST(Singular, OfSeveralBodiesTheLooseOneIsNamed) {
  Mechanism mechanism = swing();
  mechanism.body("held");
  mechanism.flexure("ground", "held", LineAxis{{100.0, 0.0}, {150.0, 10.0}});
  const TracedPath path = trace(mechanism, {mechanism.load("held", {0.1, 0.0})}, exact(), 2);
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_NE(path.termination.reason.find("'gondola'"), std::string::npos)
      << path.termination.reason;
}

}  // namespace
}  // namespace flexura::testing

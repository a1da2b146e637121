// The monolithic compliant four-bar (first source, table 1), swayed by a dead horizontal force at
// its top-left corner, against multiple-precision shooting (B_*.csv, 5e-11 against an independent
// collocation). 1e-8 by `exact`, 1e-6 by converged beam elements; relative to the largest value of
// each quantity over the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "flexura/studies/path_record.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr std::size_t left = 1;

/// Largest deviations over the path from the largest value, displacements and rotations alike.
struct Deviation {
  void compare(const Pose& found, Vec2 drawn, const ReferenceTable& table, std::size_t row,
               const std::array<const char*, 3>& columns) {
    const Vec2 u{table.number(row, columns[0]), table.number(row, columns[1])};
    const double phi = table.number(row, columns[2]);
    move = std::max(move, norm(found.position - drawn - u));
    turn = std::max(turn, std::abs(found.rotation - phi));
    largest_move = std::max(largest_move, norm(u));
    largest_turn = std::max(largest_turn, std::abs(phi));
  }
  double relative() const { return std::max(move / largest_move, turn / largest_turn); }

  double move = 0.0, turn = 0.0, largest_move = 0.0, largest_turn = 0.0;
};

struct Deviations {
  Deviation corners;
  Deviation middle;  // of the coupler
};

Deviations compare(const ReferenceTable& table, const std::string& theory, const Model& model,
                   const TracedPath& path) {
  Deviations deviations;
  for (const std::size_t row : table.rows_where("theory", theory)) {
    const auto step = static_cast<std::size_t>(table.number(row, "step"));
    const TracedState& at = path.states.at(step);
    const PathState state = make_path_state(model, *path.systems[at.system], at.z, at.load_factor);
    deviations.corners.compare(state.bodies[0], {0.0, 0.7}, table, row,
                               {"ux_TL", "uy_TL", "rot_TL"});
    deviations.corners.compare(state.bodies[1], {0.4, 0.7}, table, row,
                               {"ux_TR", "uy_TR", "rot_TR"});
    deviations.middle.compare(state.mids[1], {0.2, 0.7}, table, row,
                              {"u_mid_m", "v_mid_m", "rot_mid_rad"});
  }
  return deviations;
}

class PortalFrame : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string force() const { return std::get<0>(GetParam()); }
  std::string theory() const { return std::get<1>(GetParam()); }
  Deviations deviations(const ModelingSettings& settings) const {
    const Mechanism frame = portal_frame();
    const TracedPath path = trace(frame, {frame.load("left", {std::stod(force()), 0.0})},
                                  in_theory(settings, theory()), 20);
    EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
    return compare(ReferenceTable("B_" + force() + "N.csv"), theory(), frame, path);
  }
};

TEST_P(PortalFrame, ExactMatchesShootingAtTheToleranceAskedFor) {
  const Deviations found = deviations(exact(1e-8));
  note_measured("corners", found.corners.relative());
  note_measured("middle", found.middle.relative());
  EXPECT_LT(found.corners.relative(), 1e-8);
}

/// Inside a flexure convergence is slower than at its ends (their error is the square of it), so
/// that the middle of the coupler takes more modes than the corners.
TEST_P(PortalFrame, ExactMatchesShootingInsideAFlexure) {
  const Deviations found = deviations(exact_modes(12));
  note_measured("middle", found.middle.relative());
  EXPECT_LT(found.corners.relative(), 1e-10);
  EXPECT_LT(found.middle.relative(), 1e-8);
}

TEST_P(PortalFrame, ConvergedBeamsMatchShooting) {
  const Deviations found = deviations(beam(8, 4));
  note_measured("corners", found.corners.relative());
  note_measured("middle", found.middle.relative());
  EXPECT_LT(found.corners.relative(), 1e-6);
  EXPECT_LT(found.middle.relative(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Verification, PortalFrame,
                         ::testing::Combine(::testing::Values("0.28", "5.6"),
                                            ::testing::Values("i", "ii", "iii")),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param) == "5.6" ? "5_6" : "0_28") +
                                  "_N_theory_" + std::get<1>(test.param);
                         });

/// The frame swayed by 57 % of its leg length in one load step. The first linearization, of the
/// unloaded frame, is the predictor's and not Newton's.
TEST(PortalFrameOneStep, TakesAtMostEightIterations) {
  const Mechanism frame = portal_frame();
  const ReferenceTable table("B_5.6N.csv");
  const std::size_t last = table.rows_where("theory", "iii").back();
  const Vec2 truth{table.number(last, "ux_TL"), table.number(last, "uy_TL") + 0.7};
  for (const int modes : {8, 10, 12}) {
    const TracedPath path =
        trace(frame, {frame.load("left", {5.6, 0.0})}, exact_modes(modes), 1, false);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    note_measured("iterations_" + std::to_string(modes), path.iterations - 1);
    EXPECT_EQ(path.steps, 1);
    EXPECT_LE(path.iterations - 1, 8);
    EXPECT_LT(norm(pose_in(path, 1, left).position - truth), 1e-7 * 0.4);
  }
}

/// Initial slopes of the response (B_linear.json, checked by direct stiffness).
TEST(PortalFrameLinear, InitialSlopesMatchDirectStiffness) {
  const auto truth = read_reference_json("B_linear.json");
  const Mechanism frame = portal_frame();
  for (const std::string theory : {"i", "ii", "iii"}) {
    const TracedPath path =
        trace(frame, {frame.load("left", {1.0, 0.0})}, in_theory(linear(), theory), 1);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const TracedState& at = path.states.back();
    const PathState state = make_path_state(frame, *path.systems[at.system], at.z, at.load_factor);
    const double u = number_of(truth[theory]["du_dP"]);
    const double turn = number_of(truth[theory]["drot_dP"]);
    EXPECT_NEAR(state.mids[1].position.x - 0.2, u, 1e-12 * u);
    EXPECT_NEAR(state.mids[1].position.y - 0.7, number_of(truth[theory]["dv_dP"]), 1e-12 * u);
    EXPECT_NEAR(state.mids[1].rotation, turn, 1e-11 * turn);
  }
}

/// Von Karman elements in frames that follow them tend to the same answer, by the second order:
/// extrapolated from two meshes they agree with the reference to 1e-6 of the sway.
TEST(PortalFrameVonKarman, TendsToTheReference) {
  const Mechanism frame = portal_frame();
  const double force = 0.28;
  const auto sway = [&](const ModelingSettings& modeling) {
    return final_pose(frame, {frame.load("left", {force, 0.0})}, modeling, frame.index("left"), 2)
        .position;
  };
  const Vec2 truth = sway(exact(1e-11));
  const Vec2 coarse = sway(von_karman(32));
  const Vec2 fine = sway(von_karman(64));
  const Vec2 extrapolated = fine + (1.0 / 3.0) * (fine - coarse);
  const double moved = norm(truth - Vec2{0.0, 0.7});
  note_measured("fine", norm(fine - truth) / moved);
  note_measured("extrapolated", norm(extrapolated - truth) / moved);
  EXPECT_LT(norm(fine - truth), 2e-6 * moved);
  EXPECT_LT(norm(extrapolated - truth), 1e-7 * moved);
}

}  // namespace
}  // namespace flexura::testing

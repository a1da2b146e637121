// Lee's frame (E = 720, A = 6, I = 2, nu = 0.3, L = 120, both supports pinned, dead load at a fifth
// of the beam) up to and at its limit point, against multiple-precision continuation
// (C_lee_frame_*): limit load 15 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr std::size_t corner = 1, loaded = 2;

class LeeFrame : public ::testing::TestWithParam<std::string> {
 protected:
  const Mechanism frame = lee_frame();
};

/// Every fourth point of the path before its limit, each by load control from the start.
TEST_P(LeeFrame, PathUpToTheLimitMatchesShooting) {
  const ReferenceTable table("C_lee_frame_path.csv");
  double place = 0.0, turn = 0.0;
  int compared = 0;
  double before = 0.0;
  const auto rows = table.rows_where("theory", GetParam());
  for (std::size_t k = 0; k < rows.size() && table.number(rows[k], "P") > before; ++k) {
    const std::size_t row = rows[k];
    before = table.number(row, "P");
    if (k % 4 != 0) continue;
    const TracedPath path = trace(frame, {frame.load("loaded", {0.0, -before})},
                                  in_theory(exact(1e-10), GetParam()), 2);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const Vec2 u{table.number(row, "u_load_point(+right)"),
                 -table.number(row, "v_load_point(+down)")};
    place = std::max(place, norm(pose_in(path, 2, loaded).position - Vec2{24.0, 120.0} - u));
    turn = std::max(turn,
                    std::abs(pose_in(path, 2, corner).rotation - table.number(row, "rot_corner")));
    ++compared;
  }
  note_measured("place_over_length", place / 120.0);
  note_measured("corner_rotation", turn);
  EXPECT_GT(compared, 5);
  EXPECT_LT(place, 1e-8 * 120.0);
  EXPECT_LT(turn, 1e-8);
}

/// The load factor is stationary there, so it is found to twice the digits of the place.
TEST_P(LeeFrame, StopsAtTheLimitPoint) {
  const auto truth = read_reference_json("C_lee_frame_limits.json")[GetParam()]["extrema"][0];
  const double limit = number_of(truth["P"]);
  const TracedPath path =
      trace(frame, {frame.load("loaded", {0.0, -2.0})}, in_theory(exact(1e-10), GetParam()), 20);
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_NE(path.termination.reason.find("limit point"), std::string::npos)
      << path.termination.reason;
  ASSERT_EQ(path.events.size(), 1U);
  const TracedEvent& event = path.events[0];
  EXPECT_EQ(event.kind, "limit point");
  note_measured("load", std::abs(2.0 * event.load_factor / limit - 1.0));
  EXPECT_NEAR(2.0 * event.load_factor, limit, 1e-8 * limit);
  const Pose pose = path.systems[event.system]->pose(loaded, event.z);
  const Vec2 place = Vec2{24.0, 120.0} + Vec2{number_of(truth["u"]), -number_of(truth["v"])};
  note_measured("place_over_length", norm(pose.position - place) / 120.0);
  EXPECT_LT(norm(pose.position - place), 1e-4 * 120.0);
  EXPECT_LT(path.states.back().load_factor, event.load_factor);
  EXPECT_EQ(path.states.back().unstable_directions, 0);
}

INSTANTIATE_TEST_SUITE_P(Verification, LeeFrame, ::testing::Values("i", "ii", "iii"),
                         [](const auto& test) { return "theory_" + test.param; });

}  // namespace
}  // namespace flexura::testing

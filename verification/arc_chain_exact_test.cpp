// The exact modeling on the arc chain against multiple-precision shooting of the same Reissner
// beam (tests/data/reference/static, files A_*: every number right to 15 digits or more). The
// tolerance is that which the modeling is asked for: 1e-10 of the largest displacement of E (the
// rotation: of the largest rotation), over the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "flexura/studies/path_record.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr Vec2 point_e{19.093, 15.750};

Load load_case(const Mechanism& chain, const std::string& name) {
  const double sign = name.ends_with("minus") ? -1.0 : 1.0;
  if (name.starts_with("LC1")) return chain.load("link4.E", {sign * 1e-3, 0.0});
  return chain.load("link4", {}, sign * 1e-2);
}

class ArcChain : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string load_name() const { return std::get<0>(GetParam()); }
  std::string theory() const { return std::get<1>(GetParam()); }

  const Mechanism chain = arc_chain();
};

TEST_P(ArcChain, ExactPathMatchesShooting) {
  const ReferenceTable table("A_" + load_name() + ".csv");
  const TracedPath path =
      trace(chain, {load_case(chain, load_name())}, in_theory(exact(1e-10), theory()), 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;

  double largest_turn = 0.0, largest_move = 0.0, turn_error = 0.0, move_error = 0.0;
  for (const std::size_t row : table.rows_where("theory", theory())) {
    const auto step = static_cast<std::size_t>(table.number(row, "step"));
    const Vec2 e{table.number(row, "xE_mm"), table.number(row, "yE_mm")};
    const double turn = table.number(row, "rot4_rad");
    largest_move = std::max(largest_move, norm(e - point_e));
    largest_turn = std::max(largest_turn, std::abs(turn));
    move_error = std::max(move_error, norm(point_in(path, step, 3, point_e) - e));
    turn_error = std::max(turn_error, std::abs(pose_in(path, step, 3).rotation - turn));
  }
  note_measured("position", move_error / largest_move);
  note_measured("rotation", turn_error / largest_turn);
  EXPECT_LT(move_error, 1e-10 * largest_move);
  EXPECT_LT(turn_error, 1e-10 * largest_turn);
}

/// Centre line, section angles and section forces at full load, 21 stations a flexure.
struct StationErrors {
  double position = 0.0, angle = 0.0, force = 0.0, moment = 0.0;
  double largest_force = 0.0, largest_moment = 0.0;
};

StationErrors compare_stations(const ReferenceTable& table, const std::string& theory,
                               const Model& model, const TracedPath& path) {
  const TracedState& last = path.states.back();
  const auto members = make_members(model, *path.systems[last.system], last.z);
  StationErrors errors;
  for (const std::size_t row : table.rows_where("theory", theory)) {
    const auto arc = static_cast<std::size_t>(table.number(row, "arc(0=e12,1=e23,2=e34)"));
    const auto k = static_cast<std::size_t>(std::lround(40.0 * table.number(row, "s_over_L")));
    const MemberStation& station = members[arc].at(k);
    const Vec2 place{table.number(row, "x_mm"), table.number(row, "y_mm")};
    // the reference counts the section's angle from the x axis, members from the drawn section
    const double drawn = AxisCurve(model.flexures[arc].axis).tangent_angle(station.s);
    const double turn = station.section.rotation + drawn - table.number(row, "theta_rad");
    const double n = table.number(row, "N_N");
    const double v = table.number(row, "V_N");
    const double m = table.number(row, "M_Nmm");
    errors.position = std::max(errors.position, norm(station.section.position - place));
    errors.angle = std::max(errors.angle, std::abs(std::remainder(turn, 2.0 * M_PI)));
    errors.force = std::max(
        {errors.force, std::abs(station.axial_force - n), std::abs(station.shear_force - v)});
    errors.moment = std::max(errors.moment, std::abs(station.bending_moment - m));
    errors.largest_force = std::max({errors.largest_force, std::abs(n), std::abs(v)});
    errors.largest_moment = std::max(errors.largest_moment, std::abs(m));
  }
  return errors;
}

/// Moments inside converge at half the rate of the ends, whose error is what the tolerance is
/// about: 1e-9 of the largest value, with as many modes as that takes.
TEST_P(ArcChain, ExactSectionForcesMatchShooting) {
  const ReferenceTable table("A_" + load_name() + "_stations.csv");
  const TracedPath path =
      trace(chain, {load_case(chain, load_name())}, in_theory(exact_modes(18), theory()), 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const StationErrors errors = compare_stations(table, theory(), chain, path);
  note_measured("position_mm", errors.position);
  note_measured("angle", errors.angle);
  note_measured("force_N", errors.force);
  note_measured("moment", errors.moment / errors.largest_moment);
  EXPECT_LT(errors.position, 1e-9 * 20.0);  // the chain is 20 mm wide
  EXPECT_LT(errors.angle, 1e-9);
  EXPECT_LE(errors.force, 1e-9 * errors.largest_force + 1e-14);
  EXPECT_LT(errors.moment, 1e-9 * errors.largest_moment);
}

INSTANTIATE_TEST_SUITE_P(Verification, ArcChain,
                         ::testing::Combine(::testing::Values("LC1_plus", "LC1_minus", "LC2_plus",
                                                              "LC2_minus"),
                                            ::testing::Values("i", "ii", "iii")),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_theory_" + std::get<1>(test.param);
                         });

}  // namespace
}  // namespace flexura::testing

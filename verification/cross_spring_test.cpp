// The cross-spring pivot, a closed loop of two leaves that cross at 90 degrees at mid-length, under
// a pure moment (C_cross_spring_pivot.csv, shooting, 15 digits): the moment of a row gives back its
// rotation, the shift of the crossing point and the leaves' base forces. 1e-9 relative to the
// largest value of each; the tolerance asked for is 1e-11.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

struct PivotSet {
  std::string name;
  std::string theory;
  double length;

  friend void PrintTo(const PivotSet& set, std::ostream* out) { *out << set.name; }
};

/// Base points (-+h, -h), tips (+-h, h), h = L/(2 sqrt 2); the body's centre is the crossing point.
Mechanism cross_spring(double length) {
  const double h = length / (2.0 * std::sqrt(2.0));
  Mechanism pivot;
  if (length == 1.0)
    with_stiffness(pivot, {1e4, 1.0, 1e4});
  else
    pivot.material(210e3, 0.3).section(RectangleSection{0.5, 10.0});
  pivot.fixed("ground").body("stage").centre({0.0, 0.0});
  pivot.flexure("ground", "stage", LineAxis{{-h, -h}, {h, h}});
  pivot.flexure("ground", "stage", LineAxis{{h, -h}, {-h, h}});
  return pivot;
}

class CrossSpring : public ::testing::TestWithParam<PivotSet> {};

TEST_P(CrossSpring, ExactMatchesShooting) {
  const PivotSet& set = GetParam();
  const ReferenceTable table("C_cross_spring_pivot.csv");
  const Mechanism pivot = cross_spring(set.length);
  double turn = 0.0, shift = 0.0, force = 0.0, largest_shift = 0.0, largest_force = 0.0;
  int compared = 0;
  for (const std::size_t row : table.rows_where("set", set.name)) {
    if (table.text(row, "theory") != set.theory) continue;
    const TracedPath path = trace(pivot, {pivot.load("stage", {}, table.number(row, "M"))},
                                  in_theory(exact(1e-11), set.theory), 1);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const Pose stage = pose_in(path, 1, 1);
    const Vec2 truth{table.number(row, "shift_x"), table.number(row, "shift_y")};
    const Eigen::Vector3d f = member_load_in(path, 1, 0);
    const Vec2 f1{table.number(row, "F1x"), table.number(row, "F1y")};
    turn = std::max(turn, std::abs(stage.rotation - table.number(row, "phi_rad")));
    shift = std::max(shift, norm(stage.position - truth));
    force = std::max(force, norm(Vec2{f[0], f[1]} - f1));
    largest_shift = std::max(largest_shift, norm(truth));
    largest_force = std::max(largest_force, norm(f1));
    ++compared;
  }
  note_measured("rotation", turn);
  note_measured("shift", shift / largest_shift);
  note_measured("force", force / largest_force);
  EXPECT_EQ(compared, 26);
  EXPECT_LT(turn, 1e-9);
  EXPECT_LT(shift, 1e-9 * largest_shift);
  EXPECT_LT(force, 1e-9 * largest_force);
}

INSTANTIATE_TEST_SUITE_P(Verification, CrossSpring,
                         ::testing::Values(PivotSet{"normalised L=1 EI=1", "i", 1.0},
                                           PivotSet{"L50 b10 h0.5 E210000", "i", 50.0},
                                           PivotSet{"L50 b10 h0.5 E210000", "ii", 50.0},
                                           PivotSet{"L50 b10 h0.5 E210000", "iii", 50.0}),
                         [](const auto& test) {
                           return std::string(test.param.length == 1.0 ? "normalised" : "steel") +
                                  "_theory_" + test.param.theory;
                         });

}  // namespace
}  // namespace flexura::testing

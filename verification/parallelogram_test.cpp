// The parallelogram flexure of a public data set (MIT licence, github.com/haijunsu-osu/
// parallelogram_model_comparison, PARALLOGRAM_ALL_MODELS_master.csv): two leaves of steel from
// x = 0 to L = 250 mm at y = +-75 mm, t = 5 mm, H = 50 mm wide, a stage 24 times as stiff that
// begins at x = L, and a force across the leaves at (L, 0), Ay = Fy L^2/EI with EI = E H t^3/12.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr double length = 250.0, thickness = 5.0, width = 50.0;
constexpr double modulus = 210e3, poissons_ratio = 0.3;
constexpr double second_moment = width * thickness * thickness * thickness / 12.0;

/// A leaf that bends with EI over its free length and, where it cannot curl across its width, with
/// EI/(1 - nu^2): over `curbed` from either clamp.
Mechanism parallelogram_of(double curbed) {
  GeneralSection strip;
  strip.area = width * thickness;
  strip.shear_area = strip.area * 5.0 / 6.0;
  strip.second_moment = second_moment;
  GeneralSection plate = strip;
  plate.second_moment /= 1.0 - poissons_ratio * poissons_ratio;
  Mechanism stage;
  stage.material(modulus, poissons_ratio).fixed("ground").body("stage").centre({length, 0.0});
  for (const double y : {75.0, -75.0}) {
    std::string from = "ground";
    const double ends[] = {0.0, curbed, length - curbed, length};
    for (int k = 0; k < 3; ++k) {
      if (ends[k] == ends[k + 1]) continue;
      const std::string to = ends[k + 1] == length
                                 ? "stage"
                                 : "at" + std::to_string(k) + (y > 0.0 ? "above" : "below");
      if (to != "stage") stage.body(to);
      stage.section(k == 1 ? strip : plate);
      stage.flexure(from, to, LineAxis{{ends[k], y}, {ends[k + 1], y}});
      from = to;
    }
  }
  return stage;
}

/// ux/L, uy/L and the rotation of the stage.
using Moved = std::array<double, 3>;

Moved moved_by(const Mechanism& m, double ay, const std::string& theory) {
  const double force = ay * modulus * second_moment / (length * length);
  const Pose stage =
      final_pose(m, {m.load("stage", {0.0, force})}, in_theory(exact(1e-11), theory), 1, 4);
  return {stage.position.x / length - 1.0, stage.position.y / length, stage.rotation};
}

struct Row {
  double ay;
  Moved moved;
};

/// Solid elements of second order, 10 mm (CalculiX).
constexpr Row solid[] = {{1.0, {-0.00097028, 0.0400768, 1.0278e-4}},
                         {5.0, {-0.02284664, 0.193272, 1.25510e-3}},
                         {10.0, {-0.0784276, 0.352388, 6.45661e-3}},
                         {20.0, {-0.215222, 0.559876, 3.45973e-2}}};

/// Their boundary value problem: inextensible, unshearable. 1e-5 of the length: the data set solves
/// it by iterating over the leaves' tip loads, and what that leaves is not stated
/// (measured 3.4e-6).
TEST(ParallelogramFlexure, ExactMatchesTheBoundaryValueProblem) {
  const Mechanism m = parallelogram_of(0.0);
  double worst = 0.0;
  for (const auto& [ay, ux, uy] :
       {std::array{5.0, -0.02446316, 0.20051343}, {10.0, -0.08386905, 0.36483612}}) {
    const Moved found = moved_by(m, ay, "i");
    worst = std::max({worst, std::abs(found[0] - ux), std::abs(found[1] - uy)});
  }
  note_measured("worst", worst);
  EXPECT_LT(worst, 1e-5);
}

/// A leaf ten times as wide as thick bends as a strip where it is free to curl across its width and
/// as a plate, 1/(1 - nu^2) stiffer, where the clamps keep it from it: solids lie between the two.
TEST(ParallelogramFlexure, SolidsLieBetweenStripAndPlate) {
  const Mechanism strip = parallelogram_of(0.0), plate = parallelogram_of(0.5 * length);
  for (const Row& row : solid) {
    const Moved soft = moved_by(strip, row.ay, "iii"), stiff = moved_by(plate, row.ay, "iii");
    EXPECT_LT(soft[0], row.moved[0]) << "Ay = " << row.ay;
    EXPECT_GT(stiff[0], row.moved[0]) << "Ay = " << row.ay;
    EXPECT_GT(soft[1], row.moved[1]) << "Ay = " << row.ay;
    EXPECT_LT(stiff[1], row.moved[1]) << "Ay = " << row.ay;
  }
}

/// A plate within a third of the width of either clamp, a strip between, matches the solids; the
/// third is fitted, one number to twelve. Their mesh is too stiff: from 10 to 3 mm it moves ux by
/// 1.05 %, uy by 0.60 % and the rotation by 1.72 % at Ay = 5 (MESH_REFINEMENT_COMPARISON.md), and
/// is not yet at its limit. ux grows as uy^2 and the rotation up to uy^4, so what uy is off counts
/// twice and up to four times: 1.2, 3 and 8 % (measured 1.17, 2.9 and 7.7, all at Ay = 20). At Ay =
/// 1 the rotation comes from the leaves' extension and, some percent, from the stage. The strip
/// alone is off by 3.9, 7 and 10 %, the plate alone by 6, 12 and 18 %.
TEST(ParallelogramFlexure, SolidsAreAPlateNearTheClamps) {
  const Mechanism m = parallelogram_of(width / 3.0);
  const char* name[] = {"ux", "uy", "rotation"};
  const double tolerance[] = {0.03, 0.012, 0.08};
  for (const Row& row : solid) {
    const Moved found = moved_by(m, row.ay, "iii");
    for (std::size_t k = 0; k < 3; ++k) {
      const double off = row.moved[k] / found[k] - 1.0;
      note_measured(name[k] + std::string("_at_") + std::to_string(int(row.ay)), off);
      EXPECT_LT(std::abs(off), tolerance[k]) << name[k] << " at Ay = " << row.ay;
    }
  }
}

}  // namespace
}  // namespace flexura::testing

// The discrete modelings on the arc chain against an independent solution of the same discrete
// equations (files A_*_discrete.csv, printed with 12 digits): 1e-9 relative, of the place of E in
// the chain's size and of the rotation in radians. The table's SCMBM takes its compliance matrices
// with axial but without shear strain, its pseudo-rigid-body chain with bending alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "flexura/modelings/prbm.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr Vec2 point_e{19.093, 15.750};

struct DiscreteCase {
  std::string table_name;
  ModelingSettings settings;
  std::string test_name;

  friend void PrintTo(const DiscreteCase& discrete, std::ostream* out) {
    *out << discrete.test_name;
  }
};

std::vector<DiscreteCase> discrete_cases() {
  return {{"SCMBM centre/def", in_theory(scmbm_centre(), "ii"), "scmbm_centre"},
          {"SCMBM end/def (primary)", in_theory(scmbm_end(), "ii"), "scmbm_end"},
          {"PRBM3R equal springs (mu=1/3)", in_theory(prbm(), "i"), "prbm"}};
}

class ArcChainDiscrete : public ::testing::TestWithParam<std::tuple<std::string, DiscreteCase>> {};

TEST_P(ArcChainDiscrete, PathMatchesTheTable) {
  const auto& [name, discrete] = GetParam();
  const Mechanism chain = arc_chain();
  const double sign = name.ends_with("minus") ? -1.0 : 1.0;
  const Load load = name.starts_with("LC1") ? chain.load("link4.E", {sign * 1e-3, 0.0})
                                            : chain.load("link4", {}, sign * 1e-2);
  const TracedPath path = trace(chain, {load}, discrete.settings, 20);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;

  const ReferenceTable table("A_" + name + "_discrete.csv");
  double place = 0.0, turn = 0.0;
  for (const std::size_t row : table.rows_where("model", discrete.table_name)) {
    const auto step = static_cast<std::size_t>(table.number(row, "step"));
    const Vec2 e{table.number(row, "xE_mm"), table.number(row, "yE_mm")};
    place = std::max(place, norm(point_in(path, step, 3, point_e) - e) / norm(e));
    turn =
        std::max(turn, std::abs(pose_in(path, step, 3).rotation - table.number(row, "rot4_rad")));
  }
  note_measured("place", place);
  note_measured("rotation", turn);
  EXPECT_LT(place, 1e-9);
  EXPECT_LT(turn, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Verification, ArcChainDiscrete,
                         ::testing::Combine(::testing::Values("LC1_plus", "LC1_minus", "LC2_plus",
                                                              "LC2_minus"),
                                            ::testing::ValuesIn(discrete_cases())),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::get<1>(test.param).test_name;
                         });

/// Joints and springs of the equal-spring chain by its closed form (A_prbm3r_parameters.json, 16
/// digits): 1e-12 leaves room for the quadrature's rounding only.
TEST(ArcChainPrbm, EqualSpringsMatchTheClosedForm) {
  const Mechanism chain = arc_chain();
  const auto parameters = read_reference_json("A_prbm3r_parameters.json");
  int compared = 0;
  double worst = 0.0;
  for (const auto& entry : parameters) {
    if (entry["rule"] != "equal") continue;
    const auto& flexure = chain.model().flexures[entry["arc"].get<std::size_t>()];
    const PseudoRigidChain found =
        pseudo_rigid_chain(flexure_properties(chain, flexure, true, true), PrbmSettings{}, {});
    ASSERT_EQ(found.joints.size(), 3U);
    const double radius = number_of(entry["r"]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 joint{number_of(entry["joints"][k][0]), number_of(entry["joints"][k][1])};
      const double spring = number_of(entry[k == 1 ? "k_mid" : "k_end"]);
      worst = std::max({worst, norm(found.joints[k] - joint) / radius,
                        std::abs(found.stiffness[k] / spring - 1.0)});
    }
    ++compared;
  }
  note_measured("worst", worst);
  EXPECT_EQ(compared, 3);
  EXPECT_LT(worst, 1e-12);
}

}  // namespace
}  // namespace flexura::testing

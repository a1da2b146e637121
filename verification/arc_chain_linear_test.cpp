// Study `linear` of the arc chain against 20-digit analytic integrals (A_linear.json, checked there
// against quadrature to 2e-26): 1e-12 relative, which leaves the rounding of sums and of 2 x 2
// eigenvalues whose ratio is 20.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "flexura/studies/linear_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/reference.hpp"

namespace flexura::testing {
namespace {

constexpr double tolerance = 1e-12;

using nlohmann::json;

Vec2 vector_of(const json& pair) { return {number_of(pair[0]), number_of(pair[1])}; }

double relative(double found, const json& expected) {
  return std::abs(found / number_of(expected) - 1.0);
}

/// Entries have three units: each against the geometric mean of its diagonal entries.
double matrix_error(const ComplianceMatrix& found, const json& expected) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double size = std::sqrt(number_of(expected[i][i]) * number_of(expected[j][j]));
      worst = std::max(worst, std::abs(found[i][j] - number_of(expected[i][j])) / size);
    }
  return worst;
}

/// Difference of two undirected directions.
double direction_error(Vec2 found, double angle) { return std::abs(cross(found, unit(angle))); }

class ArcChainLinear : public ::testing::TestWithParam<std::string> {
 protected:
  LinearResult run(const std::vector<Load>& loads) {
    LinearStudy study;
    study.loads = loads;
    study.axial = GetParam() != "i";
    study.shear = GetParam() == "iii";
    Termination termination;
    LinearResult result = run_linear(chain, study, termination);
    EXPECT_TRUE(termination.converged()) << termination.reason;
    return result;
  }
  const ElasticityRecord& record_of(const LinearResult& result, const std::string& name) {
    return *std::find_if(result.records.begin(), result.records.end(),
                         [&](const ElasticityRecord& record) { return record.name == name; });
  }

  const Mechanism chain = arc_chain();
  const json reference = read_reference_json("A_linear.json");
};

TEST_P(ArcChainLinear, ComplianceOfEveryFlexure) {
  const LinearResult result = run({});
  double worst = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const json& arc = reference["arcs"][k];
    const ElasticityRecord& record = result.records.at(k);
    EXPECT_EQ(record.of, ElasticityRecord::Of::flexure);
    worst = std::max(worst, matrix_error(record.compliance,
                                         arc["compliance_at_arc_end_global_axes"][GetParam()]));
    ASSERT_TRUE(record.ellipse);
    worst = std::max(worst, relative(record.ellipse->weight, arc["w_rad_per_Nmm"]));
    worst = std::max(worst, norm(record.ellipse->centre - vector_of(arc["centre"])) / 3.0);
    if (GetParam() != "i") continue;  // the file's semi-axes are those of bending
    worst = std::max(worst, relative(record.ellipse->major, arc["a"]));
    worst = std::max(worst, relative(record.ellipse->minor, arc["b"]));
  }
  note_measured("worst", worst);
  EXPECT_LT(worst, tolerance);
}

TEST_P(ArcChainLinear, EllipseOfTheChain) {
  const LinearResult result = run({});
  const ElasticityRecord& record = record_of(result, "link4.E");
  const json& truth = reference["theories"][GetParam()];
  ASSERT_TRUE(record.ellipse && record.antipolar);
  const double matrix = matrix_error(record.compliance, truth["C_E"]);
  const double centre = norm(record.ellipse->centre - vector_of(truth["centre"])) / 10.0;
  const double axes = std::max({relative(record.ellipse->weight, truth["w"]),
                                relative(record.ellipse->major, truth["semi_axis_a"]),
                                relative(record.ellipse->minor, truth["semi_axis_b"])});
  const double angle = std::abs(
      std::remainder(record.ellipse->orientation - number_of(truth["angle_of_a_axis_rad"]), M_PI));
  note_measured("matrix", matrix);
  note_measured("centre", centre);
  note_measured("axes", axes);
  note_measured("angle", angle);
  EXPECT_LT(matrix, tolerance);
  EXPECT_LT(centre, tolerance);
  EXPECT_LT(axes, tolerance);
  EXPECT_LT(angle, tolerance);
}

/// The antipolar line of E, nx (x - xC) + ny (y - yC) = -1, and the single-point compliances there.
TEST_P(ArcChainLinear, AntipolarLineAndPrincipalCompliances) {
  const LinearResult result = run({});
  const ElasticityRecord& record = record_of(result, "link4.E");
  const json& truth = reference["theories"][GetParam()];
  ASSERT_TRUE(record.antipolar);
  const Line2& line = *record.antipolar;
  const Vec2 n = (-1.0 / line.offset) * line.normal;
  const Vec2 expected{number_of(truth["nx"]), number_of(truth["ny"])};
  const double antipolar = std::max(norm(n - expected) / norm(expected),
                                    norm(line.origin - vector_of(truth["centre"])) / 10.0);
  const double compliances =
      std::max(relative(record.principal_compliances[0], truth["greater_single_point_compliance"]),
               relative(record.principal_compliances[1], truth["lesser"]));
  const double directions =
      std::max(direction_error(record.principal_directions[0],
                               number_of(truth["direction_greater_angle_rad"])),
               direction_error(record.principal_directions[1],
                               number_of(truth["direction_lesser_angle_rad"])));
  note_measured("antipolar", antipolar);
  note_measured("compliances", compliances);
  note_measured("directions", directions);
  EXPECT_LT(antipolar, tolerance);
  EXPECT_LT(compliances, tolerance);
  EXPECT_LT(directions, tolerance);
}

TEST_P(ArcChainLinear, PolesOfLoads) {
  const Vec2 d3 = vector_of(reference["LC3_direction"]);
  const Vec2 d4 = vector_of(reference["LC4_direction"]);
  const LinearResult result =
      run({chain.load("link4.E", {1.0, 0.0}), chain.load("link4.E", {}, 1.0),
           chain.load("link4.E", d3), chain.load("link4.E", d4)});
  const char* names[] = {"LC1 Fx=1", "LC2 M=1", "LC3 unit", "LC4 unit"};
  ASSERT_EQ(result.poles.size(), 4U);
  double place = 0.0, displacement = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const json& truth = reference["theories"][GetParam()]["poles"][names[k]];
    const PoleRecord& record = result.poles[k];
    ASSERT_TRUE(record.pole) << names[k];
    const Vec2 pole = vector_of(truth["pole"]);
    const Vec2 move = vector_of(truth["u_per_unit"]);
    place = std::max(place, norm(*record.pole - pole) / norm(pole));
    displacement = std::max({displacement, norm(record.displacement - move) / norm(move),
                             relative(record.rotation, truth["phi_per_unit"])});
  }
  note_measured("pole", place);
  note_measured("displacement", displacement);
  EXPECT_LT(place, tolerance);
  EXPECT_LT(displacement, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Verification, ArcChainLinear, ::testing::Values("i", "ii", "iii"),
                         [](const auto& test) { return "theory_" + test.param; });

}  // namespace
}  // namespace flexura::testing

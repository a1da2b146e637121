// Stress fields of links of any shape, what strengths are set against, and errors by refined
// meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/geometry/mesh_refinement.hpp"
#include "flexura/results/safety.hpp"
#include "flexura/studies/run_studies.hpp"
#include "tests/support/fields.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/plane_mesh.hpp"

namespace flexura::testing {
namespace {

constexpr double length = 10.0;
constexpr double modulus = 1000.0;

class LinkField : public ::testing::TestWithParam<ElementKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, LinkField,
                         ::testing::Values(ElementKind::triangle3, ElementKind::triangle6,
                                           ElementKind::quad4, ElementKind::quad8,
                                           ElementKind::quad9),
                         [](const auto& kind) {
                           return "nodes_" + std::to_string(nodes_of(kind.param));
                         });

/// A bar 1 high along a direction.
Mechanism bar(ElementKind kind, int nx, int ny, double poissons_ratio, double angle = 0.0) {
  Mechanism mechanism;
  mechanism.material(modulus, poissons_ratio).section(RectangleSection{1.0, 1.0});
  mechanism.fixed("ground").body("tip");
  mechanism.link("ground", "tip", mapped_link(kind, nx, ny, [&](Vec2 p) {
                   return rotate(angle, {length * p.x, p.y - 0.5});
                 }));
  return mechanism;
}

/// Without lateral contraction the stress is the same everywhere: the force over the area.
TEST_P(LinkField, OfTensionIsTheForceOverTheSection) {
  const double angle = 0.7;
  const Mechanism mechanism = bar(GetParam(), 6, 2, 0.0, angle);
  const auto load = mechanism.load("tip", 40.0 * unit(angle));
  const auto fields = final_fields(mechanism, {load}, continuum(4, 1, 2));
  ASSERT_EQ(fields.size(), 1U);
  const StressField& field = fields[0].field;
  ASSERT_FALSE(field.pieces.empty());
  const PlaneStress expected = turned(std::cos(angle), std::sin(angle), {40.0, 0.0, 0.0, 0.0});
  for (const PlaneStress& s : field.stresses) {
    EXPECT_NEAR(s.xx, expected.xx, 1e-9 * 40.0);
    EXPECT_NEAR(s.yy, expected.yy, 1e-9 * 40.0);
    EXPECT_NEAR(s.xy, expected.xy, 1e-9 * 40.0);
  }
  EXPECT_NEAR(stress_error(fields).value(), 0.0, 1e-9);
  // pieces cover the bar
  double area = 0.0;
  field.for_pieces([&](const StressField::Piece& piece) {
    double twice = 0.0;
    for (std::size_t k = 0; k < piece.corners; ++k)
      twice +=
          cross(field.drawn[piece.nodes[k]], field.drawn[piece.nodes[(k + 1) % piece.corners]]);
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  });
  EXPECT_NEAR(area, length, 1e-9);
}

/// In pure bending, turned by half a radian: linear over the height away from the ends, along the
/// moved bar.
TEST_P(LinkField, OfPureBendingIsLinearOverTheHeight) {
  if (GetParam() == ElementKind::triangle3) GTEST_SKIP() << "they lock";
  const Mechanism mechanism = bar(GetParam(), 40, 4, 0.0);
  const double moment = 0.5 / length * modulus / 12.0;
  const auto fields =
      final_fields(mechanism, {mechanism.load("tip", {}, moment)}, continuum(4, 1, 2), 4);
  const StressField& field = fields[0].field;
  const double fibre = 6.0 * moment;
  double worst = 0.0;
  for (std::size_t k = 0; k < field.stresses.size(); ++k) {
    const Vec2 at = field.drawn[k];
    if (std::abs(at.x - 0.5 * length) > 0.3 * length) continue;
    const double turn = 0.5 * at.x / length;
    const PlaneStress seen = turned(std::cos(turn), -std::sin(turn), field.stresses[k]);
    worst = std::max({worst, std::abs(seen.xx + 2.0 * at.y * fibre) / fibre,
                      std::abs(seen.yy) / fibre, std::abs(seen.xy) / fibre});
  }
  note_measured("worst", worst);
  // strains of 2.5 %: the law is not linear
  EXPECT_LT(worst, 0.06);
}

/// Where nothing is singular the estimate tends to zero, with the order of the stress.
TEST_P(LinkField, ErrorEstimateFallsWithTheMesh) {
  std::vector<double> errors;
  for (const int n : {20, 40}) {
    const Mechanism mechanism = bar(GetParam(), n, n / 5, 0.0);
    errors.push_back(stress_error(final_fields(mechanism, {mechanism.load("tip", {0.0, 0.4})},
                                               continuum(4, 1, 2)))
                         .value());
  }
  note_measured("error", errors[1]);
  const bool linear = nodes_of(GetParam()) <= 4;
  EXPECT_GT(std::log2(errors[0] / errors[1]), linear ? 0.8 : 1.6);
  EXPECT_LT(errors[1], GetParam() == ElementKind::triangle3 ? 0.5 : linear ? 0.2 : 0.02);
}

TEST_P(LinkField, InMotionIsThatAtRest) {
  Mechanism mechanism = bar(GetParam(), 10, 2, 0.3);
  mechanism.density(2.0);
  TransientStudy study = transient(1e-6, 1, 1e-8);
  study.loads = {mechanism.load("tip", {0.0, 0.4})};
  PathStudy path;
  path.loads = study.loads;
  path.steps = 2;
  path.modelings = {continuum(4, 1, 2)};
  Model model = mechanism;
  model.studies = {{"push", path, {}}};
  study.from = StudyState{0, 1.0};
  const ModelingMotion motion = move(model, study, continuum(4, 1, 2));
  const auto still = std::get<PathResult>(run_studies(model, {}).studies.at(0).content);
  const double expected = still.modelings[0].states.back().peak_stresses[0];
  EXPECT_GT(expected, 10.0);
  EXPECT_NEAR(motion.states.front().state.peak_stresses[0], expected, 1e-6 * expected);
}

TEST(LinkStrength, IsReachedWhereTheForceOverTheSectionIs) {
  Mechanism mechanism = bar(ElementKind::quad8, 6, 2, 0.0);
  Model model = mechanism;
  model.materials[0].strength = 30.0;
  PathStudy study;
  study.loads = {mechanism.load("tip", {40.0, 0.0})};
  study.steps = 8;
  study.modelings = {linear(), continuum(4, 1, 2)};
  model.studies = {{"pull", study, {}}};
  const auto path = std::get<PathResult>(run_studies(model, {}).studies.at(0).content);
  EXPECT_FALSE(find_safety(path, path.modelings[0]).value().factor.has_value())
      << "linear knows no stress";
  const auto safety = find_safety(path, path.modelings[1]);
  ASSERT_TRUE(safety.has_value());
  EXPECT_NEAR(safety->factor.value(), 0.75, 1e-9);
  ASSERT_TRUE(safety->reached.has_value());
  EXPECT_NEAR(safety->reached->load_factor, 0.75, 1e-6);
}

TEST_P(LinkField, RefinedMeshesCoverTheSame) {
  const MeshLink coarse = mapped_link(GetParam(), 5, 3, [](Vec2 p) {
    return (3.0 + p.y + 0.2 * p.x * p.x) * unit(1.5 - 2.0 * p.x);
  });
  const MeshRefinement refinement = refine_mesh(coarse);
  const MeshLink& fine = refinement.link;
  EXPECT_EQ(fine.mesh.elements.size(), 4 * coarse.mesh.elements.size());
  EXPECT_FALSE(find_mesh_fault(fine).has_value()) << *find_mesh_fault(fine);
  EXPECT_NEAR(mesh_area(fine.mesh), mesh_area(coarse.mesh), 1e-3 * mesh_area(coarse.mesh));
  const bool quadratic = nodes_of(GetParam()) > corners_of(GetParam());
  const std::size_t expected = quadratic ? 13 : 7;
  EXPECT_EQ(fine.base.size(), expected);
  EXPECT_EQ(fine.action.size(), expected);
  for (const std::size_t n : fine.base) {
    const auto& [element, place] = refinement.origins[n];
    const PlaneMesh::Element& own = coarse.mesh.elements[element];
    const ShapeValues shape = shape_values(own.kind, place);
    Vec2 at;
    for (std::size_t a = 0; a < shape.values.size(); ++a)
      at = at + shape.values[a] * coarse.mesh.place(own, a);
    EXPECT_LT(norm(at - fine.mesh.nodes[n]), 1e-12);
  }
}

/// The estimate of a path is its distance from the truth, to a factor of two, where nothing is
/// singular and where the corners of the ends are.
TEST(LinkEstimate, IsTheDistanceFromTheTruth) {
  for (const double contraction : {0.0, 0.3}) {
    Mechanism strip;
    strip.material(modulus, contraction).section(RectangleSection{1.0, 1.0});
    strip.fixed("ground").body("tip");
    strip.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}});
    PathStudy study;
    study.loads = {strip.load("tip", {0.2, 0.5}, 2.0)};
    study.steps = 4;
    const auto traced = [&](const Model& mechanism, const ModelingSettings& settings) {
      Model model = mechanism;
      study.modelings = {settings};
      model.studies = {{"push", study, {}}};
      return std::get<PathResult>(run_studies(model, {}).studies.at(0).content).modelings[0];
    };
    const ModelingPath truth = traced(strip, continuum(24, 1, 8));
    for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8}) {
      const ModelingPath path = traced(bar(kind, 20, 4, contraction), continuum(4, 1, 2));
      ASSERT_TRUE(path.error_estimate.has_value());
      double off = 0.0;
      for (std::size_t k = 0; k < truth.states.size(); ++k)
        off = std::max(
            off, norm(path.states[k].bodies[0].position - truth.states[k].bodies[0].position));
      off /= norm(truth.states.back().bodies[0].position - truth.states[0].bodies[0].position);
      const std::string what =
          std::to_string(nodes_of(kind)) + (contraction > 0.0 ? "_singular" : "");
      note_measured("off_" + what, off);
      note_measured("estimate_" + what, *path.error_estimate);
      EXPECT_GT(*path.error_estimate, 0.5 * off) << what;
      EXPECT_LT(*path.error_estimate, 2.0 * off) << what;
    }
  }
}

}  // namespace
}  // namespace flexura::testing

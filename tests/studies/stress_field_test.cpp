// Stress fields of continua against what a strip of rectangles under end loads is known to carry.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/studies/path_study.hpp"
#include "tests/support/fields.hpp"

namespace flexura {
namespace {

using testing::continuum;
using testing::final_fields;
using testing::Mechanism;

constexpr double thickness = 0.5;
constexpr double width = 2.0;
constexpr double length = 10.0;
constexpr double youngs_modulus = 1000.0;
constexpr double poissons_ratio = 0.3;
constexpr double modulus = width * thickness * thickness / 6.0;  // of the section in bending

/// A straight strip from the origin, in a direction.
Mechanism strip(double angle = 0.0) {
  Mechanism mechanism;
  mechanism.material(youngs_modulus, poissons_ratio).section(RectangleSection{thickness, width});
  mechanism.fixed("ground").body("tip");
  mechanism.flexure("ground", "tip", LineAxis{{0.0, 0.0}, length * unit(angle)});
  return mechanism;
}

ContinuumSettings fine() {
  ContinuumSettings settings;
  settings.elements = 12;
  settings.order = 6;
  settings.order_across = 3;
  return settings;
}

/// Nodes whose section is drawn in the middle of the strip, away from what its faces disturb.
template <class Check>
void for_middle(const StressField& field, const Check& check) {
  int seen = 0;
  for (std::size_t c = 0; c < field.columns; ++c) {
    const Vec2 middle =
        0.5 * (field.drawn[field.node(c, 0)] + field.drawn[field.node(c, field.rows - 1)]);
    if (std::abs(norm(middle) - 0.5 * length) > 0.2 * length) continue;
    for (std::size_t r = 0; r < field.rows; ++r, ++seen)
      check(field.node(c, r),
            norm(field.drawn[field.node(c, r)] - middle) * (2 * r + 1 < field.rows ? -1.0 : 1.0));
  }
  EXPECT_GT(seen, 20);
}

TEST(StressField, IsLinearOverTheThicknessInPureBending) {
  const double fibre = 4e-7 * youngs_modulus;
  const Mechanism mechanism = strip();
  const auto load = mechanism.load("tip", {}, fibre * modulus);
  ContinuumSettings enhanced;  // four-node elements, which their enhanced strains make right
  enhanced.elements = 80;
  enhanced.across = 6;
  enhanced.order = 1;
  for (const ContinuumSettings& settings : {fine(), enhanced}) {
    const auto fields = final_fields(mechanism, {load}, continuum(settings));
    ASSERT_EQ(fields.size(), 1U);
    for_middle(fields[0].field, [&](std::size_t node, double above) {
      const PlaneStress& s = fields[0].field.stresses[node];
      EXPECT_NEAR(s.xx, -fibre * above / (0.5 * thickness), 1e-6 * fibre);
      EXPECT_NEAR(s.yy, 0.0, 1e-6 * fibre);
      const double turn =
          fibre / (0.5 * thickness) / youngs_modulus * fields[0].field.drawn[node].x;
      EXPECT_NEAR(s.xy, turn * s.xx, 1e-6 * fibre);
      EXPECT_EQ(s.zz, 0.0);
    });
  }
}

TEST(StressField, OfTensionIsTheForceOverTheCurrentSection) {
  const Mechanism mechanism = strip();
  const double force = 0.05 * youngs_modulus * thickness * width;
  for (const auto law :
       {ContinuumSettings::Law::st_venant_kirchhoff, ContinuumSettings::Law::neo_hookean}) {
    ContinuumSettings settings = fine();
    settings.law = law;
    const auto fields =
        final_fields(mechanism, {mechanism.load("tip", {force, 0.0})}, continuum(settings), 2);
    const StressField& field = fields[0].field;
    for_middle(field, [&](std::size_t node, double /*above*/) {
      const std::size_t column = node / field.rows;
      const double now = norm(field.places[field.node(column, field.rows - 1)] -
                              field.places[field.node(column, 0)]);
      const double section = now * now / thickness * width;  // isotropic: both stretch alike
      EXPECT_NEAR(field.stresses[node].xx, force / section, 1e-6 * force / section);
      EXPECT_NEAR(von_mises_stress(field.stresses[node]), force / section, 1e-6 * force);
    });
    EXPECT_LT(*stress_error(fields), 0.02);
  }
}

TEST(StressField, AcrossThePlaneIsThatOfWallsInPlaneStrain) {
  ContinuumSettings settings = fine();
  settings.plane = PlaneKind::strain;
  const Mechanism mechanism = strip();
  const double force = 1e-6 * youngs_modulus * thickness * width;
  for (const auto law :
       {ContinuumSettings::Law::st_venant_kirchhoff, ContinuumSettings::Law::neo_hookean}) {
    settings.law = law;
    const auto fields =
        final_fields(mechanism, {mechanism.load("tip", {force, 0.0})}, continuum(settings));
    for_middle(fields[0].field, [&](std::size_t node, double /*above*/) {
      const PlaneStress& s = fields[0].field.stresses[node];
      EXPECT_NEAR(s.zz, poissons_ratio * s.xx, 1e-5 * s.xx);
    });
  }
}

TEST(StressField, TurnsWithTheMechanism) {
  const double angle = 0.7;
  const Vec2 force{-0.05, 0.2};
  const Mechanism level = strip();
  const Mechanism tilted = strip(angle);
  const auto a = final_fields(level, {level.load("tip", force)}, continuum(fine()), 2);
  const auto b =
      final_fields(tilted, {tilted.load("tip", rotate(angle, force))}, continuum(fine()), 2);
  const double largest = largest_stress(a)->von_mises;
  EXPECT_GT(norm(a[0].field.places.back() - a[0].field.drawn.back()), 0.2 * length);
  EXPECT_NEAR(*stress_error(a), *stress_error(b), 1e-6);
  for (std::size_t k = 0; k < a[0].field.stresses.size(); ++k) {
    const PlaneStress expected = turned(std::cos(angle), std::sin(angle), a[0].field.stresses[k]);
    const PlaneStress off = b[0].field.stresses[k] - expected;
    EXPECT_LT(std::abs(off.xx) + std::abs(off.yy) + std::abs(off.xy), 1e-7 * largest);
    EXPECT_LT(norm(b[0].field.places[k] - rotate(angle, a[0].field.places[k])), 1e-8 * length);
  }
}

/// The second of two strips in series, which the first turns far: its stress follows it.
TEST(StressField, FollowsABaseThatTurns) {
  Mechanism mechanism;
  mechanism.material(youngs_modulus, poissons_ratio).section(RectangleSection{thickness, width});
  mechanism.fixed("ground").body("middle").body("tip");
  mechanism.flexure("ground", "middle", LineAxis{{0.0, 0.0}, {length, 0.0}});
  mechanism.flexure("middle", "tip", LineAxis{{length, 0.0}, {2.0 * length, 0.0}});
  const double turn = 1.1;  // of each
  const double bending = youngs_modulus * modulus * 0.5 * thickness;
  const auto fields = final_fields(mechanism, {mechanism.load("tip", {}, bending * turn / length)},
                                   continuum(fine()), 2);
  const StressField& field = fields.at(1).field;
  const std::size_t column = field.columns / 2;
  const std::size_t outer = field.node(column, 0);
  const PrincipalStress principal = principal_stress(field.stresses[outer]);
  const Vec2 along =
      field.places[field.node(column + 1, 0)] - field.places[field.node(column - 1, 0)];
  EXPECT_NEAR(std::atan2(along.y, along.x), 1.5 * turn, 0.02);
  EXPECT_NEAR(std::sin(principal.angle - 1.5 * turn), 0.0, 0.01);
  const double fibre = bending * turn / length / modulus;
  EXPECT_NEAR(principal.first, fibre, 0.06 * fibre);  // strains of some per cent
  EXPECT_NEAR(principal.second, 0.0, 1e-9 * fibre);   // the side is free
}

TEST(StressField, ErrorEstimateFallsWithTheMesh) {
  const Mechanism mechanism = strip();
  const auto load = mechanism.load("tip", {0.0, 0.05});
  for (const int order : {1, 2, 3}) {
    std::vector<double> errors;
    for (const int finer : {1, 2, 4}) {
      ContinuumSettings settings;
      settings.elements = 20 * finer;
      settings.across = 2 * finer;
      settings.order = order;
      errors.push_back(*stress_error(final_fields(mechanism, {load}, continuum(settings, 1e-9))));
    }
    EXPECT_LT(errors[0], 0.25) << order;
    EXPECT_LT(errors[1], 0.75 * errors[0]) << order;
    EXPECT_LT(errors[2], 0.75 * errors[1]) << order;
  }
}

TEST(StressField, IsKeptAsTheStudyAsks) {
  const Mechanism mechanism = strip();
  PathStudy study;
  study.loads = {mechanism.load("tip", {0.0, 0.05})};
  study.steps = 4;
  const auto never = [](double) { return true; };
  const auto run = [&](PathStudy::KeptFields kept) {
    study.stress_fields = kept;
    return run_path(mechanism, study, continuum({}, 1e-4), never);
  };
  const ModelingPath last = run(PathStudy::KeptFields::last);
  ASSERT_EQ(last.fields.size(), 1U);
  EXPECT_EQ(last.fields[0].state, 4U);
  EXPECT_GT(last.largest_stress->von_mises, 0.0);
  EXPECT_LT(norm(last.largest_stress->drawn), thickness);  // at the clamped end
  const ModelingPath all = run(PathStudy::KeptFields::every_step);
  ASSERT_EQ(all.fields.size(), 5U);
  EXPECT_EQ(largest_stress(all.fields[0].flexures)->von_mises, 0.0);
  EXPECT_EQ(stress_error(all.fields[0].flexures), 0.0);
  EXPECT_EQ(all.stress_error, last.stress_error);
  EXPECT_TRUE(run(PathStudy::KeptFields::none).fields.empty());
  study.stress_fields = PathStudy::KeptFields::every_step;
  EXPECT_TRUE(run_path(mechanism, study, testing::exact(), never).fields.empty());
}

}  // namespace
}  // namespace flexura

#include "flexura/io/model_reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "flexura/io/starter.hpp"
#include "flexura/model/validation.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using std::numbers::pi;
using testing::ModelText;
using testing::read_valid;

Model arc_chain() {
  const ModelReading reading = read_model(FLEXURA_SOURCE_DIR "/examples/arc_chain.toml");
  EXPECT_EQ(testing::messages(reading.diagnostics), "");
  return reading.model.value_or(Model{});
}

TEST(ArcChain, HasTheSourcesNumbers) {
  const Model model = arc_chain();
  EXPECT_EQ(model.units.length, "mm");
  EXPECT_EQ(model.units.angle, "rad");
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].youngs_modulus, 2100.0);
  EXPECT_EQ(model.materials[0].poissons_ratio, 0.35);
  EXPECT_EQ(model.materials[0].density, 913e-12);
  EXPECT_FALSE(model.materials[0].strength);
  const auto& section = std::get<RectangleSection>(model.sections.at(0).shape);
  EXPECT_EQ(section.thickness, 0.1);
  EXPECT_EQ(section.width, 1.0);
  ASSERT_EQ(model.flexures.size(), 3u);
  const auto& e12 = std::get<ArcAxis>(model.flexures[0].axis);
  EXPECT_EQ(e12.centre, (Vec2{0.0, 3.0}));
  EXPECT_EQ(e12.radius, 3.0);
  EXPECT_DOUBLE_EQ(e12.start, -pi / 2.0);
  EXPECT_DOUBLE_EQ(e12.sweep, -4.0 * pi / 3.0);
  const auto& e23 = std::get<ArcAxis>(model.flexures[1].axis);
  EXPECT_EQ(e23.centre, (Vec2{9.093, 8.25}));
  EXPECT_DOUBLE_EQ(e23.start, -5.0 * pi / 6.0);
  EXPECT_DOUBLE_EQ(e23.sweep, 5.0 * pi / 6.0);
  const auto& e34 = std::get<ArcAxis>(model.flexures[2].axis);
  EXPECT_EQ(e34.radius, 2.5);
  EXPECT_DOUBLE_EQ(e34.sweep, -3.0 * pi / 2.0);
}

TEST(ArcChain, BodiesFlexuresAndStudiesKeepTheFilesOrder) {
  const Model model = arc_chain();
  ASSERT_EQ(model.bodies.size(), 4u);
  EXPECT_EQ(model.bodies[0].name, "ground");
  EXPECT_TRUE(model.bodies[0].fixed);
  EXPECT_EQ(model.bodies[3].name, "link4");
  EXPECT_EQ(model.bodies[3].points.at(0).position, (Vec2{19.093, 15.75}));
  EXPECT_EQ(model.flexures[2].name, "e34");
  EXPECT_EQ(model.flexures[2].base, 2u);
  EXPECT_EQ(model.flexures[2].action, 3u);
  ASSERT_EQ(model.studies.size(), 10u);
  EXPECT_EQ(model.studies[0].name, "ellipse");
  EXPECT_EQ(model.studies[1].name, "lc1_plus");
  EXPECT_EQ(model.studies[8].name, "lc4_minus");
  EXPECT_EQ(model.studies[9].name, "shape");
}

TEST(ArcChain, LoadsAndModelings) {
  const Model model = arc_chain();
  const auto& lc1 = std::get<PathStudy>(model.studies[1].kind);
  EXPECT_EQ(lc1.steps, 20);
  ASSERT_EQ(lc1.loads.size(), 1u);
  EXPECT_EQ(lc1.loads[0].body, 3u);
  EXPECT_EQ(lc1.loads[0].point, 0u);
  EXPECT_EQ(lc1.loads[0].force, (Vec2{1e-3, 0.0}));
  ASSERT_EQ(lc1.modelings.size(), 5u);
  EXPECT_EQ(lc1.modelings[1].label, "scmbm");
  EXPECT_EQ(lc1.modelings[4].label, "continuum");
  EXPECT_EQ(lc1.reference, 4u);
  const auto& lc2 = std::get<PathStudy>(model.studies[4].kind);
  EXPECT_FALSE(lc2.loads.at(0).point.has_value());
  EXPECT_EQ(lc2.loads.at(0).moment, -1e-2);
  const auto& lc4 = std::get<PathStudy>(model.studies[8].kind);
  EXPECT_DOUBLE_EQ(lc4.loads.at(0).force.x, -5.3e-4 * 0.84553730656873649);
  EXPECT_DOUBLE_EQ(lc4.loads.at(0).force.y, -5.3e-4 * 0.53391634475869576);
  const auto& shape = std::get<InverseStudy>(model.studies[9].kind);
  ASSERT_EQ(shape.relative.size(), 3u);
  EXPECT_EQ(shape.relative[1].flexure, 1u);
  EXPECT_DOUBLE_EQ(shape.relative[1].rotation, -pi / 36.0);
  EXPECT_EQ(shape.relative[1].at, RelativeDisplacement::At::centre);
}

TEST(ArcChain, FlexuresMeetWhereTheSourceSaysTheyDo) {
  const Model model = arc_chain();
  const AxisEnds e12 = axis_ends(model.flexures[0].axis);
  EXPECT_NEAR(e12.base.x, 0.0, 1e-12);
  EXPECT_NEAR(e12.base.y, 0.0, 1e-12);
  EXPECT_NEAR(e12.action.y, 4.5, 1e-12);
  const AxisEnds e34 = axis_ends(model.flexures[2].axis);
  EXPECT_NEAR(e34.action.x, 15.093, 1e-12);
  EXPECT_NEAR(e34.action.y, 15.75, 1e-12);
}

TEST(ModelReader, EveryExampleIsValid) {
  for (const auto& entry : std::filesystem::directory_iterator(FLEXURA_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_EQ(testing::messages(read_model(entry.path()).diagnostics), "") << entry.path();
  }
}

TEST(ModelReader, WhatItReadsIsValidForProgramsToo) {
  EXPECT_EQ(testing::messages(validate_model(arc_chain())), "");
}

TEST(ModelReader, StarterModelIsValid) {
  const Model model = read_valid(starter_model());
  EXPECT_EQ(model.studies.size(), 2u);
  EXPECT_EQ(std::get<LineAxis>(model.flexures.at(0).axis).start.x, -15.0);
  EXPECT_EQ(body_centre(model, 1), (Vec2{-15.0, 40.0}));
}

TEST(ModelReader, FirstMeansFirstInTheFileNotInTheAlphabet) {
  ModelText text;
  text.bodies =
      "[bodies.zed]\n[bodies.ground]\nfixed = true\n[bodies.stage]\n"
      "points = { z = [1, 0], a = [2, 0], m = [3, 0] }\n";
  text.studies =
      "[flexures.a]\nbetween = [\"ground\", \"zed\"]\naxis = { line = [[0, 1], [5, 5]] }\n"
      "material = \"steel\"\nsection = \"strip\"\n";
  const Model model = read_valid(text.text());
  EXPECT_EQ(model.bodies[0].name, "zed");
  EXPECT_EQ(model.bodies[2].points[0].name, "z");
  EXPECT_EQ(model.bodies[2].points[2].name, "m");
  EXPECT_EQ(model.flexures[0].name, "leaf");
  EXPECT_EQ(model.flexures[1].name, "a");
}

TEST(ModelReader, EntitiesKnowWhereTheyStand) {
  const Model model = read_valid(ModelText().text());
  EXPECT_EQ(model.materials[0].source, (SourcePosition{6, 12}));
  EXPECT_EQ(model.bodies[1].source, (SourcePosition{13, 9}));
}

TEST(ModelReader, SectionsBodiesAndSplines) {
  ModelText text;
  text.sections =
      "[sections.strip]\ngeneral = { area = \"2 mm^2\", second_moment = 0.5, depth = 1.5, "
      "rotary_second_moment = \"3e6 um^4\" }\n"
      "[sections.rod]\ncircle = { diameter = \"1 cm\" }\n";
  text.bodies =
      "[bodies.ground]\nfixed = true\n[bodies.stage]\nmass = \"1 kg\"\ninertia = 2\n"
      "centre = [\"1 cm\", 5]\n";
  text.axis = "{ spline = [[0, 0], [1, 1], [2, 0]], end_tangent = [1, -1] }";
  const Model model = read_valid(text.text());
  const auto& general = std::get<GeneralSection>(model.sections[0].shape);
  EXPECT_EQ(general.area, 2.0);
  EXPECT_FALSE(general.shear_area.has_value());
  EXPECT_EQ(general.depth, 1.5);
  EXPECT_EQ(general.rotary_second_moment, 3e-6);
  EXPECT_EQ(std::get<CircleSection>(model.sections[1].shape).diameter, 10.0);
  EXPECT_EQ(model.bodies[1].mass, 1e-3);  // N s^2/mm is a tonne
  EXPECT_EQ(model.bodies[1].inertia, 2.0);
  EXPECT_EQ(model.bodies[1].centre, (Vec2{10.0, 5.0}));
  const auto& spline = std::get<SplineAxis>(model.flexures[0].axis);
  EXPECT_EQ(spline.points.size(), 3u);
  EXPECT_FALSE(spline.start_tangent.has_value());
  EXPECT_EQ(spline.end_tangent, (Vec2{1.0, -1.0}));
}

TEST(ModelReader, PinsAreKnownByTheBodiesNames) {
  ModelText text;
  text.axis += "\npinned = [\"stage\"]";
  const Model model = read_valid(text.text());
  EXPECT_FALSE(model.flexures[0].pinned_base);
  EXPECT_TRUE(model.flexures[0].pinned_action);
}

TEST(ModelReader, PlainAnglesFollowTheDeclaredUnit) {
  ModelText text;
  text.axis = "{ arc = { centre = [0, 0], radius = 2, start = 90, sweep = \"0.5 rad\" } }";
  text.units += "angle = \"deg\"\n";
  const Model model = read_valid(text.text());
  const auto& arc = std::get<ArcAxis>(model.flexures[0].axis);
  EXPECT_DOUBLE_EQ(arc.start, pi / 2.0);
  EXPECT_DOUBLE_EQ(arc.sweep, 0.5);
  EXPECT_EQ(model.units.angle, "deg");
}

// The four-bar of Turcic and Midha is printed in pounds and inches.
TEST(ModelReader, ImperialUnits) {
  ModelText text;
  text.units = "[units]\nlength = \"in\"\nforce = \"lbf\"\ntime = \"s\"\n";
  text.materials =
      "[materials.steel]\nyoungs_modulus = \"10.3e6 psi\"\npoissons_ratio = 0.33\n"
      "density = \"0.098 lb/in^3\"\nstrength = \"40 ksi\"\n";
  text.bodies =
      "[bodies.ground]\nfixed = true\n[bodies.stage]\nmass = \"0.0976 lb\"\n"
      "points = { P = [\"25.4 mm\", \"1 ft\"] }\n";
  const Model model = read_valid(text.text());
  const double g = 9.80665 / 0.0254;  // in/s^2
  EXPECT_EQ(model.materials[0].youngs_modulus, 10.3e6);
  EXPECT_DOUBLE_EQ(*model.materials[0].density, 0.098 / g);
  EXPECT_EQ(model.materials[0].strength, 40e3);
  EXPECT_DOUBLE_EQ(model.bodies[1].mass, 0.0976 / g);
  EXPECT_DOUBLE_EQ(model.bodies[1].points[0].position.x, 1.0);
  EXPECT_DOUBLE_EQ(model.bodies[1].points[0].position.y, 12.0);
}

}  // namespace
}  // namespace flexura

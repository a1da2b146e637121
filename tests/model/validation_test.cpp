// Rules that a program meets which builds its Model itself. Those that a file can break as well
// have their cases in tests/data/malformed.
#include "flexura/model/validation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "flexura/model/model.hpp"

namespace flexura {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ModelingSettings exact() {
  ModelingSettings settings;
  settings.kind = ExactSettings{};
  settings.label = "exact";
  return settings;
}

Load moment_on(std::size_t body) {
  Load load;
  load.body = body;
  load.moment = 1.0;
  return load;
}

/// A leaf from ground to stage, bent by a moment.
Model leaf_model() {
  Model model;
  model.units = {"mm", "N", "s", "rad"};
  model.materials.push_back({"steel", 210e3, 0.3, {}, {}, {2, 1}});
  model.sections.push_back({"strip", RectangleSection{0.1, 1.0}, {3, 1}});
  model.bodies.resize(2);
  model.bodies[0].name = "ground";
  model.bodies[0].fixed = true;
  model.bodies[1].name = "stage";
  model.bodies[1].source = {5, 1};
  Flexure leaf;
  leaf.name = "leaf";
  leaf.action = 1;
  leaf.axis = LineAxis{{0.0, 0.0}, {10.0, 0.0}};
  leaf.source = {6, 1};
  model.flexures.push_back(leaf);
  PathStudy study;
  study.loads.push_back(moment_on(1));
  study.modelings.push_back(exact());
  model.studies.push_back({"push", study, {7, 1}});
  return model;
}

PathStudy& path_of(Model& model) { return std::get<PathStudy>(model.studies[0].kind); }

/// Expects one diagnostic that contains the text.
void expect_complaint(const Model& model, const std::string& text, SourcePosition position) {
  const Diagnostics diagnostics = validate_model(model);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_NE(diagnostics[0].message.find(text), std::string::npos) << diagnostics[0].message;
  EXPECT_EQ(diagnostics[0].position, position);
}

TEST(Validation, AcceptsAValidModel) { EXPECT_TRUE(validate_model(leaf_model()).empty()); }

TEST(Validation, IndicesBeyondTheirLists) {
  Model model = leaf_model();
  model.flexures[0].material = 7;
  expect_complaint(model, "flexures.leaf.material: there is no number 7", {6, 1});
  model = leaf_model();
  path_of(model).loads[0].body = 9;
  expect_complaint(model, "studies.push.loads[0].on: there is no body number 9", {7, 1});
  model = leaf_model();
  path_of(model).loads[0].point = 2;
  expect_complaint(model, "body 'stage' has no point number 2", {7, 1});
  model = leaf_model();
  path_of(model).reference = 3;
  expect_complaint(model, "studies.push.reference: there is no modeling number 3", {7, 1});
  model = leaf_model();
  model.flexures[0].action = 5;
  EXPECT_EQ(validate_model(model).size(), 2u);  // and nothing holds the stage any more
}

TEST(Validation, NumbersThatAreNone) {
  Model model = leaf_model();
  model.materials[0].poissons_ratio = nan;
  expect_complaint(model, "poissons_ratio", {2, 1});
  model = leaf_model();
  path_of(model).loads[0].moment = nan;
  expect_complaint(model, "studies.push.loads[0].moment: must be finite, is nan", {7, 1});
  model = leaf_model();
  model.flexures[0].axis = LineAxis{{0.0, nan}, {1.0, 0.0}};
  expect_complaint(model, "flexures.leaf.axis.line[0]: must be finite", {6, 1});
  model = leaf_model();
  model.sections[0].shape = CircleSection{nan};
  expect_complaint(model, "sections.strip.circle.diameter", {3, 1});
}

TEST(Validation, AStrengthIsPositive) {
  Model model = leaf_model();
  model.materials[0].strength = 40.0;
  EXPECT_TRUE(validate_model(model).empty());
  for (const double wrong : {0.0, -1.0, nan}) {
    model.materials[0].strength = wrong;
    const Diagnostics diagnostics = validate_model(model);
    ASSERT_EQ(diagnostics.size(), 1U);
    EXPECT_NE(diagnostics[0].message.find("steel.strength: must be greater than 0"),
              std::string::npos)
        << diagnostics[0].message;
  }
}

TEST(Validation, NamesAreUnique) {
  Model model = leaf_model();
  model.bodies.push_back(model.bodies[0]);
  expect_complaint(model, "bodies.ground: the name 'ground' is given twice", {});
}

TEST(Validation, SortsByPosition) {
  Model model = leaf_model();
  path_of(model).steps = 0;
  model.materials[0].youngs_modulus = 0.0;
  model.bodies[1].mass = -1.0;
  const Diagnostics diagnostics = validate_model(model);
  ASSERT_EQ(diagnostics.size(), 3u);
  EXPECT_LT(diagnostics[0].position, diagnostics[1].position);
  EXPECT_LT(diagnostics[1].position, diagnostics[2].position);
}

TEST(Validation, AnEmptyModelHasNothingThatMoves) {
  expect_complaint(Model{}, "no moving body", {});
}

TEST(Validation, AFullTurnIsAnArcStill) {
  Model model = leaf_model();
  model.flexures[0].axis = ArcAxis{{0.0, 0.0}, 2.0, 0.0, 2.0 * 3.14159265358979323846};
  EXPECT_TRUE(validate_model(model).empty());
}

TEST(Validation, SupportReachesThroughAnyNumberOfBodies) {
  Model model = leaf_model();
  for (std::size_t i = 2; i < 1000; ++i) {
    Body body;
    body.name = "b" + std::to_string(i);
    model.bodies.push_back(body);
    Flexure flexure = model.flexures[0];
    flexure.name = "f" + std::to_string(i);
    flexure.base = i;  // against the direction of support
    flexure.action = i - 1;
    model.flexures.push_back(flexure);
  }
  EXPECT_TRUE(validate_model(model).empty());
}

TEST(Validation, WhatHangsOnAFreeOrDrivenBodyNeedsNoFixedOne) {
  Model model = leaf_model();
  model.bodies[0].fixed = false;
  expect_complaint(model, "no body is fixed; one needs `fixed = true`, or `free = true`", {});
  model.bodies[1].free = true;
  expect_complaint(model, "studies.push.kind: nothing holds body 'stage', which is free", {7, 1});
  model.studies[0].kind = LinearStudy{};
  expect_complaint(model, "no equilibrium that a study of kind linear could find", {7, 1});
  model.studies.clear();
  EXPECT_TRUE(validate_model(model).empty());
  model.bodies[1].free = false;
  model.drivers.push_back({"motor", 0, {}, 1.0, LinearHistory{}, {8, 1}});
  EXPECT_TRUE(validate_model(model).empty());
}

TEST(Validation, AFreeBodyThatIsHeldFlysNowhere) {
  Model model = leaf_model();
  model.bodies[1].free = true;
  EXPECT_TRUE(validate_model(model).empty());
}

TEST(KeyPath, ReadsAsInAMessage) {
  EXPECT_EQ(to_text(KeyPath{"studies", "push"} / "loads" / std::size_t{2} / "force"),
            "studies.push.loads[2].force");
}

}  // namespace
}  // namespace flexura

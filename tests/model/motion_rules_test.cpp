// Rules of studies of motion, and of drivers and histories, that a program meets which builds its
// Model itself.
#include <gtest/gtest.h>

#include <limits>

#include "flexura/model/validation.hpp"

namespace flexura {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ModelingSettings exact() {
  ModelingSettings settings;
  settings.kind = ExactSettings{};
  settings.label = "exact";
  return settings;
}

/// A leaf from ground to stage, of a material with a density.
Model leaf_model() {
  Model model;
  model.units = {"mm", "N", "s", "rad"};
  model.materials.push_back({"steel", 210e3, 0.3, 7850e-12, {}, {2, 1}});
  model.sections.push_back({"strip", RectangleSection{0.1, 1.0}, {3, 1}});
  model.bodies.resize(2);
  model.bodies[0].name = "ground";
  model.bodies[0].fixed = true;
  model.bodies[1].name = "stage";
  Flexure leaf;
  leaf.name = "leaf";
  leaf.action = 1;
  leaf.axis = LineAxis{{0.0, 0.0}, {10.0, 0.0}};
  model.flexures.push_back(leaf);
  return model;
}

TransientStudy shaking() {
  TransientStudy study;
  Load load;
  load.body = 1;
  load.moment = 1.0;
  study.loads.push_back(load);
  study.duration = 2.0;
  study.modelings.push_back(exact());
  return study;
}

Model with(TransientStudy study) {
  Model model = leaf_model();
  model.studies.push_back({"shake", std::move(study), {7, 1}});
  return model;
}

/// All messages, one a line.
std::string complaints(const Model& model) {
  std::string text;
  for (const Diagnostic& d : validate_model(model)) text += d.message + "\n";
  return text;
}

TEST(MotionRules, AcceptWhatIsValid) {
  EXPECT_EQ(complaints(with(shaking())), "");
  Model model = leaf_model();
  ModesStudy modes;
  modes.modelings.push_back(exact());
  model.studies.push_back({"sing", modes, {}});
  EXPECT_EQ(complaints(model), "");
}

TEST(MotionRules, DensityIsMissedOnceForEveryMaterial) {
  Model model = with(shaking());
  model.studies.push_back(model.studies[0]);
  model.studies[1].name = "again";
  model.flexures.push_back(model.flexures[0]);
  model.flexures[1].name = "second";
  model.materials[0].density.reset();
  EXPECT_EQ(complaints(model),
            "materials.steel.density: material 'steel' of flexure 'leaf' needs a density: without "
            "it a flexure has no inertia\n");
  model.studies.clear();
  EXPECT_EQ(complaints(model), "");
}

TEST(MotionRules, HistoriesThatAreNone) {
  const auto complaint = [](TimeHistory history) {
    TransientStudy study = shaking();
    study.loads[0].history = std::move(history);
    return complaints(with(study));
  };
  const std::string at = "studies.shake.loads[0].history";
  EXPECT_EQ(complaint(TableHistory{{0.0, 2.0}, {1.0}, true}),
            at + ".table: a table needs two rows or more, has 2\n");
  EXPECT_EQ(complaint(TableHistory{{0.0, nan, 2.0}, {1.0, 0.0, 0.0}, true}),
            at + ".table[1]: must be finite, is [nan, 0]\n");
  EXPECT_EQ(complaint(FunctionHistory{}), at + ": there is no function\n");
  EXPECT_EQ(complaint(StepHistory{nan}), at + ".step: must be finite, is nan\n");
  EXPECT_EQ(complaint(FunctionHistory{[](double t) { return 1.0 / (t - 1.0); }}),
            at + ": at time 1 of the study this is infinite\n");
  EXPECT_EQ(complaint(LinearHistory{}), "");
}

TEST(MotionRules, StatesOfStudiesThatAreNot) {
  TransientStudy study = shaking();
  study.from = StudyState{5, 1.0};
  EXPECT_EQ(complaints(with(study)), "studies.shake.from.study: there is no study number 5\n");
  ModesStudy modes;
  modes.modelings.push_back(exact());
  modes.about = StudyState{0, nan};
  Model model = leaf_model();
  PathStudy path;
  path.loads = shaking().loads;
  path.modelings.push_back(exact());
  model.studies = {{"push", path, {}}, {"sing", modes, {}}};
  EXPECT_EQ(complaints(model),
            "studies.sing.about.load_factor: must lie between 0 and 1, is nan\n");
}

// A chain of starts has an end; a circle has none, and is told of once.
TEST(MotionRules, CirclesOfStartsAreFoundBehindTheirWayIn) {
  Model model = leaf_model();
  for (const std::size_t next : {1, 2, 3, 1}) {
    TransientStudy study = shaking();
    study.from = StudyState{next, 1.0};
    model.studies.push_back({"s" + std::to_string(model.studies.size()), study, {}});
  }
  EXPECT_EQ(complaints(model),
            "studies.s1.from.study: these studies start from one another: s1 -> s2 -> s3 -> s1\n");
  std::get<TransientStudy>(model.studies[3].kind).from.reset();
  EXPECT_EQ(complaints(model), "");
}

TEST(MotionRules, MotionsStartWhereTheMechanismDoes) {
  TransientStudy study = shaking();
  study.prescribe.push_back({1, {}, 1.0, {}, {}, HarmonicHistory{1.0, 0.5}});
  EXPECT_NE(complaints(with(study)).find("at time 0 this is 0.47"), std::string::npos);
  study.prescribe[0].history = HarmonicHistory{1.0, 0.0};
  EXPECT_EQ(complaints(with(study)), "");
  study.prescribe[0].history = StepHistory{};
  EXPECT_NE(complaints(with(study)).find("cannot be elsewhere in no time"), std::string::npos);
  study.prescribe[0].x = 0.0;  // held
  EXPECT_EQ(complaints(with(study)), "");
}

TEST(MotionRules, DriversMoveSomethingThatCanMove) {
  Model model = leaf_model();
  model.drivers.push_back({"motor", 4, {}, 1.0, LinearHistory{}, {}});
  EXPECT_EQ(complaints(model), "drivers.motor.turn: there is no body number 4\n");
  model.drivers[0] = {"motor", 1, Vec2{nan, 0.0}, 1.0, LinearHistory{}, {}};
  EXPECT_EQ(complaints(model),
            "drivers.motor.direction: a direction needs a length that is not zero\n");
  model.drivers[0] = {"motor", 1, {}, nan, LinearHistory{}, {}};
  EXPECT_EQ(complaints(model), "drivers.motor.speed: must be finite, is nan\n");
}

// A body on one pin takes no moment, but whoever drives it does.
TEST(MotionRules, LoadsOnDrivenBodiesAreTheDriversMatter) {
  Model model = with(shaking());
  model.flexures[0].pinned_action = true;
  EXPECT_NE(complaints(model).find("hangs on one pin: it takes no moment"), std::string::npos);
  model.drivers.push_back({"motor", 1, {}, 1.0, LinearHistory{}, {}});
  EXPECT_EQ(complaints(model), "");
}

}  // namespace
}  // namespace flexura

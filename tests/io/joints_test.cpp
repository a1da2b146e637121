#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::ModelText;
using testing::read_valid;

const char* const slider_crank = R"(flexura = 1
[units]
length = "mm"
force = "N"
time = "s"
angle = "deg"
[bodies.frame]
fixed = true
[bodies.crank]
[bodies.rod]
inertia = 1
[bodies.slider]
mass = "20 g"
[joints.A]
revolute = ["crank", "rod"]
at = ["1 cm", 0]
[joints.B]
revolute = ["rod", "slider"]
at = [40, 0]
[joints.rail]
prismatic = { bodies = ["frame", "slider"], direction = [2, 0] }
)";

TEST(Joints, MakeALinkageWithoutFlexures) {
  const Model model = read_valid(std::string(slider_crank) +
                                 "[drivers.motor]\nturn = \"crank\"\nspeed = \"300 rpm\"\n");
  ASSERT_EQ(model.joints.size(), 3u);
  EXPECT_EQ(model.joints[0].name, "A");
  EXPECT_EQ(model.joints[0].base, 1u);
  EXPECT_EQ(model.joints[0].action, 2u);
  EXPECT_EQ(std::get<RevoluteJoint>(model.joints[0].kind).at, (Vec2{10.0, 0.0}));
  EXPECT_EQ(model.joints[2].base, 0u);
  EXPECT_EQ(std::get<PrismaticJoint>(model.joints[2].kind).direction, (Vec2{2.0, 0.0}));
  EXPECT_EQ(body_centre(model, 3), (Vec2{40.0, 0.0}));
  ASSERT_EQ(model.drivers.size(), 1u);
  EXPECT_EQ(model.drivers[0].body, 1u);
  EXPECT_DOUBLE_EQ(model.drivers[0].amount, 10.0 * std::numbers::pi);  // radians, not degrees
  EXPECT_TRUE(std::holds_alternative<LinearHistory>(model.drivers[0].history));
  EXPECT_FALSE(model.drivers[0].direction.has_value());
}

TEST(Drivers, TurnByAHistory) {
  const Model model =
      read_valid(std::string(slider_crank) +
                 "[drivers.motor]\nturn = \"crank\"\nangle = 360\nhistory = { ramp = [0, 2] }\n");
  ASSERT_EQ(model.drivers.size(), 1u);
  EXPECT_DOUBLE_EQ(model.drivers[0].amount, 2.0 * std::numbers::pi);
  EXPECT_EQ(std::get<RampHistory>(model.drivers[0].history).end, 2.0);
}

TEST(Drivers, MoveAlongADirection) {
  ModelText text;
  text.studies =
      "[drivers.feed]\nmove = \"stage\"\ndirection = [0, 1]\nspeed = \"2 mm/s\"\n"
      "[bodies.other]\n[drivers.cam]\nmove = \"other\"\ndirection = [1, 1]\n"
      "distance = \"5 mm\"\nhistory = \"= 1 - cos(t)\"\n";
  const Model model = read_valid(text.text());
  ASSERT_EQ(model.drivers.size(), 2u);
  EXPECT_EQ(model.drivers[0].direction, (Vec2{0.0, 1.0}));
  EXPECT_EQ(model.drivers[0].amount, 2.0);
  EXPECT_EQ(model.drivers[1].body, 2u);
  EXPECT_EQ(model.drivers[1].amount, 5.0);
  EXPECT_EQ(evaluate_history(model.drivers[1].history, 0.0).value, 0.0);
}

// A joint does not take a spring's name away, nor does it make a body turn that hangs on it.
TEST(Joints, ShareNamesWithSprings) {
  ModelText text;
  text.studies =
      "[bodies.bob]\n[joints.P]\nrevolute = [\"stage\", \"bob\"]\nat = [10, 0]\n"
      "[springs.P]\nbetween = [\"ground\", \"stage\"]\nstiffness = 1\n";
  const Model model = read_valid(text.text());
  EXPECT_EQ(model.joints.at(0).name, model.springs.at(0).name);
  EXPECT_FALSE(body_can_turn(model, 2));
}

}  // namespace
}  // namespace flexura

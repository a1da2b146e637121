// The mechanism as drawn: joints, which have a place of their own or take a body's.
#include "flexura/studies/drawing.hpp"

#include <gtest/gtest.h>

namespace flexura::testing {
namespace {

Model crank_and_slider() {
  Model model;
  model.bodies.resize(3);
  model.bodies[0].name = "ground";
  model.bodies[0].fixed = true;
  model.bodies[1].name = "crank";
  model.bodies[2].name = "piston";
  model.bodies[2].centre = Vec2{70.0, 5.0};
  model.joints = {{"shaft", 0, 1, RevoluteJoint{{1.0, 2.0}}, {}},
                  {"guide", 0, 2, PrismaticJoint{{3.0, 0.0}}, {}}};
  return model;
}

TEST(Drawing, APinIsWhereItIsStated) {
  const Drawing drawing = make_drawing(crank_and_slider());
  ASSERT_EQ(drawing.joints.size(), 2U);
  const DrawnJoint& pin = drawing.joints[0];
  EXPECT_EQ(pin.name, "shaft");
  EXPECT_EQ(pin.base, "ground");
  EXPECT_EQ(pin.action, "crank");
  EXPECT_EQ(pin.at, (Vec2{1.0, 2.0}));
  EXPECT_FALSE(pin.direction.has_value());
}

TEST(Drawing, ASliderIsWhereItsActionBodyIs) {
  const DrawnJoint slider = make_drawing(crank_and_slider()).joints.at(1);
  EXPECT_EQ(slider.base, "ground");
  EXPECT_EQ(slider.action, "piston");
  EXPECT_EQ(slider.at, (Vec2{70.0, 5.0}));
  EXPECT_EQ(slider.direction, (Vec2{3.0, 0.0}));
}

}  // namespace
}  // namespace flexura::testing

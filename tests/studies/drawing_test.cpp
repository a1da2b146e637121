// The mechanism as drawn: joints, which have a place of their own or take a body's, and loads that
// come and go.
#include "flexura/studies/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

DrawnHistory drawn_history(TimeHistory history, double end) {
  Load load;
  load.body = 1;
  load.moment = 2.0;
  load.history = std::move(history);
  return make_drawn_loads(crank_and_slider(), {load}, end).at(0).history.value_or(DrawnHistory{});
}

TEST(Drawing, LoadsThereFromTheStartHaveNoHistory) {
  EXPECT_TRUE(drawn_history(StepHistory{}, 1.0).factors.empty());
}

TEST(Drawing, HistoriesAreFollowedToTheEndOfTheStudy) {
  const DrawnHistory ramp = drawn_history(RampHistory{1.0, 3.0}, 4.0);
  EXPECT_EQ(ramp.end, 4.0);
  EXPECT_EQ(ramp.largest(), 1.0);
  EXPECT_EQ(ramp.at(-1.0), 0.0);
  EXPECT_NEAR(ramp.at(1.75), 0.375, 1e-12);
  EXPECT_EQ(ramp.at(5.0), 1.0);
}

TEST(Drawing, ShortSwingsOfHistoriesAreNotMissed) {
  const DrawnHistory hit = drawn_history(HalfSineHistory{0.4, 1e-3}, 1.0);
  EXPECT_NEAR(hit.largest(), 1.0, 0.01);
  EXPECT_NEAR(hit.at(0.4005), 1.0, 0.01);
  const DrawnHistory shaken = drawn_history(HarmonicHistory{600.0, 0.0}, 1.0);
  for (const double t : {0.1234, 0.777, 0.999})
    EXPECT_NEAR(shaken.at(t), std::sin(600.0 * t), 0.01) << t;
}

}  // namespace
}  // namespace flexura::testing

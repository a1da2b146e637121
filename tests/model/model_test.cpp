#include "flexura/model/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/model/validation.hpp"

namespace flexura {
namespace {

constexpr double pi = std::numbers::pi;

Flexure make_flexure(std::size_t base, std::size_t action, AxisShape axis) {
  Flexure flexure;
  flexure.name = "f" + std::to_string(base) + std::to_string(action);
  flexure.base = base;
  flexure.action = action;
  flexure.axis = std::move(axis);
  return flexure;
}

/// Two legs from ground that meet in the one pin of a tip.
Model pinned_tip(Vec2 second_pin) {
  Model model;
  model.bodies.resize(2);
  model.bodies[0].fixed = true;
  model.flexures.push_back(make_flexure(0, 1, LineAxis{{0.0, 0.0}, {5.0, 5.0}}));
  model.flexures.push_back(make_flexure(1, 0, LineAxis{second_pin, {10.0, 0.0}}));
  model.flexures[0].pinned_action = true;
  model.flexures[1].pinned_base = true;
  return model;
}

TEST(AxisEnds, OfEveryShape) {
  const AxisEnds arc = axis_ends(ArcAxis{{1.0, 2.0}, 3.0, pi / 2.0, -pi / 2.0});
  EXPECT_NEAR(arc.base.x, 1.0, 1e-15);
  EXPECT_NEAR(arc.base.y, 5.0, 1e-15);
  EXPECT_NEAR(arc.action.x, 4.0, 1e-15);
  EXPECT_NEAR(arc.action.y, 2.0, 1e-15);
  EXPECT_EQ(axis_ends(LineAxis{{1.0, 2.0}, {3.0, 4.0}}).action, (Vec2{3.0, 4.0}));
  const SplineAxis spline{{{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}}, {}, {}};
  EXPECT_EQ(axis_ends(spline).action, (Vec2{2.0, 0.0}));
  EXPECT_EQ(axis_ends(SplineAxis{}).base, (Vec2{}));
}

TEST(BodyCentre, IsItsOwnOrTheFirstFlexureEndOnIt) {
  Model model = pinned_tip({5.0, 5.0});
  EXPECT_EQ(body_centre(model, 0), (Vec2{0.0, 0.0}));
  EXPECT_EQ(body_centre(model, 1), (Vec2{5.0, 5.0}));
  model.bodies[1].centre = Vec2{7.0, 8.0};
  EXPECT_EQ(body_centre(model, 1), (Vec2{7.0, 8.0}));
  model.bodies.emplace_back();
  EXPECT_EQ(body_centre(model, 2), (Vec2{}));
}

TEST(BodyCanTurn, NotOnOnePin) {
  Model model = pinned_tip({5.0, 5.0});
  EXPECT_FALSE(body_can_turn(model, 1));
  EXPECT_EQ(common_pins(model)[1], (Vec2{5.0, 5.0}));
  EXPECT_TRUE(body_can_turn(model, 0));  // its pose is given
  model.flexures[1].pinned_base = false;
  EXPECT_TRUE(body_can_turn(model, 1));
}

TEST(BodyCanTurn, PinsApartHoldItsRotation) {
  EXPECT_TRUE(body_can_turn(pinned_tip({6.0, 5.0}), 1));
  // Ends typed with seven digits are one pin.
  EXPECT_FALSE(body_can_turn(pinned_tip({5.000001, 5.0}), 1));
}

Joint pin_between(std::size_t base, std::size_t action, Vec2 at) {
  return {"pin", base, action, RevoluteJoint{at}, {}};
}

TEST(BodyCentre, IsTheFirstJointWhereThereIsNoFlexure) {
  Model model = pinned_tip({5.0, 5.0});
  model.bodies.emplace_back();
  model.joints.push_back({"slide", 1, 2, PrismaticJoint{{1.0, 0.0}}, {}});
  EXPECT_EQ(body_centre(model, 2), (Vec2{}));
  model.joints.push_back(pin_between(1, 2, {5.0, 5.0}));
  model.joints.push_back(pin_between(0, 2, {9.0, 5.0}));
  EXPECT_EQ(body_centre(model, 2), (Vec2{5.0, 5.0}));
}

TEST(CommonPins, RevoluteJointsCountPrismaticOnesHold) {
  Model model = pinned_tip({5.0, 5.0});
  model.bodies.emplace_back();
  model.joints.push_back(pin_between(1, 2, {5.0, 5.0}));
  EXPECT_EQ(common_pins(model)[2], (Vec2{5.0, 5.0}));
  EXPECT_FALSE(body_can_turn(model, 1));
  EXPECT_FALSE(body_can_turn(model, 2));
  model.joints[0].kind = RevoluteJoint{{8.0, 5.0}};  // away from the flexures' pin
  EXPECT_TRUE(body_can_turn(model, 1));
  model.joints[0].kind = PrismaticJoint{{0.0, 1.0}};
  EXPECT_TRUE(body_can_turn(model, 1));
  EXPECT_TRUE(body_can_turn(model, 2));
}

TEST(CommonPins, JointsTypedWithSevenDigitsAreOnePlace) {
  Model model = pinned_tip({5.0, 5.0});
  model.bodies.emplace_back();
  model.joints.push_back(pin_between(1, 2, {5.0, 5.0}));
  model.joints.push_back(pin_between(0, 2, {5.000001, 5.0}));
  EXPECT_FALSE(body_can_turn(model, 2));
  model.joints[1].kind = RevoluteJoint{{5.01, 5.0}};
  EXPECT_TRUE(body_can_turn(model, 2));
}

TEST(BodyCanTurn, WithInertiaOrADriver) {
  Model model = pinned_tip({5.0, 5.0});
  model.bodies[1].mass = 2.0;
  EXPECT_FALSE(body_can_turn(model, 1));  // all of it at the pin
  model.bodies[1].centre = Vec2{5.0, 5.0};
  EXPECT_FALSE(body_can_turn(model, 1));
  model.bodies[1].centre = Vec2{6.0, 5.0};
  EXPECT_TRUE(body_can_turn(model, 1));
  model.bodies[1].mass = 0.0;
  EXPECT_FALSE(body_can_turn(model, 1));
  model.bodies[1].inertia = 0.1;
  EXPECT_TRUE(body_can_turn(model, 1));
  model.bodies[1].inertia = 0.0;
  model.drivers.push_back({"motor", 1, {}, 1.0, LinearHistory{}, {}});
  EXPECT_TRUE(body_can_turn(model, 1));
  EXPECT_EQ(common_pins(model)[1], (Vec2{5.0, 5.0}));
  EXPECT_EQ(hanging_pins(model)[1], std::nullopt);
}

TEST(MechanismSize, SpansAllPlaces) {
  Model model = pinned_tip({5.0, 5.0});
  EXPECT_DOUBLE_EQ(mechanism_size(model), std::sqrt(125.0));
  model.joints.push_back(pin_between(0, 1, {0.0, 10.0}));
  EXPECT_DOUBLE_EQ(mechanism_size(model), std::sqrt(200.0));
  model.bodies[1].points.push_back({"P", {30.0, 0.0}});
  model.bodies[1].centre = Vec2{0.0, -30.0};
  EXPECT_DOUBLE_EQ(mechanism_size(model), 50.0);
  EXPECT_EQ(mechanism_size(Model{}), 0.0);
}

TEST(ModelingName, OfEveryKind) {
  ModelingSettings settings;
  const auto name = [&](ModelingSettings::Kind kind) {
    settings.kind = std::move(kind);
    return modeling_name(settings);
  };
  EXPECT_EQ(name(LinearSettings{}), "linear");
  EXPECT_EQ(name(ScmbmSettings{}), "scmbm");
  EXPECT_EQ(name(PrbmSettings{}), "prbm");
  EXPECT_EQ(name(ExactSettings{}), "exact");
  EXPECT_EQ(name(BeamSettings{}), "beam");
}

}  // namespace
}  // namespace flexura

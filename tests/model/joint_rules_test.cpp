// What joints and drivers hold twice.
#include <gtest/gtest.h>

#include <chrono>

#include "flexura/model/held_motions.hpp"
#include "flexura/model/validation.hpp"

namespace flexura {
namespace {

Joint pin(const std::string& name, std::size_t base, std::size_t action, Vec2 at) {
  return {name, base, action, RevoluteJoint{at}, {}};
}

Joint slide(const std::string& name, std::size_t base, std::size_t action, Vec2 direction) {
  return {name, base, action, PrismaticJoint{direction}, {}};
}

/// Body 0 is fixed.
Model bodies(std::size_t count) {
  Model model;
  model.units = {"mm", "N", "s", "rad"};
  for (std::size_t b = 0; b < count; ++b) {
    Body body;
    body.name = "b" + std::to_string(b);
    body.fixed = b == 0;
    model.bodies.push_back(body);
  }
  return model;
}

/// The only complaint, or none.
std::string complaint(const Model& model) {
  const Diagnostics diagnostics = validate_model(model);
  EXPECT_LE(diagnostics.size(), 1u);
  return diagnostics.empty() ? "" : diagnostics[0].message;
}

Model four_bar() {
  Model model = bodies(4);
  model.joints = {pin("A", 0, 1, {0.0, 0.0}), pin("B", 1, 2, {10.0, 20.0}),
                  pin("C", 2, 3, {50.0, 30.0}), pin("D", 3, 0, {60.0, 0.0})};
  return model;
}

TEST(RedundantJoints, AFourBarHasNone) { EXPECT_EQ(complaint(four_bar()), ""); }

TEST(RedundantJoints, ASecondPinBetweenTheSameBodies) {
  Model model = four_bar();
  model.joints.push_back(pin("E", 2, 1, {10.0, 20.0}));
  EXPECT_EQ(complaint(model),
            "joints.E: as drawn, joint 'E' holds again what joint 'B' holds already: leave one "
            "out, or let a flexure give way");
}

TEST(RedundantJoints, ABarThatLocksTheLoopIsFineASecondOneIsNot) {
  Model model = four_bar();
  model.bodies.push_back(model.bodies[3]);
  model.bodies[4].name = "strut";
  model.joints.push_back(pin("F", 0, 4, {30.0, 0.0}));
  model.joints.push_back(pin("G", 4, 2, {30.0, 40.0}));
  EXPECT_EQ(complaint(model), "");  // a truss, statically determinate
  model.joints.push_back(pin("H", 4, 1, {5.0, 10.0}));
  const std::string message = complaint(model);
  EXPECT_NE(message.find("joints.H: as drawn, joint 'H' holds again what joints 'A', 'B'"),
            std::string::npos)
      << message;
}

// Three equal cranks that carry one bar: two of them hold its rotation already.
TEST(RedundantJoints, TheThirdCrankOfAParallelogram) {
  Model model = bodies(5);
  for (std::size_t crank = 1; crank <= 3; ++crank) {
    const double x = 10.0 * static_cast<double>(crank);
    const std::string name = std::to_string(crank);
    model.joints.push_back(pin("foot" + name, 0, crank, {x, 0.0}));
    model.joints.push_back(pin("head" + name, crank, 4, {x + 3.0, 8.0}));
  }
  EXPECT_NE(complaint(model).find("joints.head3"), std::string::npos);
  std::get<RevoluteJoint>(model.joints[4].kind).at.y = -1.0;  // longer than the others
  EXPECT_EQ(complaint(model), "");
}

TEST(RedundantJoints, ParallelGuidesOfOneSlider) {
  Model model = bodies(2);
  model.joints = {slide("left", 0, 1, {0.0, 1.0}), slide("right", 0, 1, {0.0, -2.0})};
  EXPECT_NE(complaint(model).find("joint 'right' holds again what joint 'left' holds already"),
            std::string::npos);
}

TEST(RedundantJoints, ADriverHoldsItsBodysCentreToo) {
  Model model = four_bar();
  model.drivers.push_back({"motor", 1, {}, 1.0, LinearHistory{}, {}});
  EXPECT_EQ(complaint(model),
            "joints.A: as drawn, joint 'A' holds again what driver 'motor' holds already: leave "
            "one out, or let a flexure give way");
  model.joints.erase(model.joints.begin());
  EXPECT_EQ(complaint(model), "");
  model.joints.pop_back();  // the follower would be held on both sides
  model.drivers.push_back({"second", 2, Vec2{1.0, 0.0}, 1.0, LinearHistory{}, {}});
  EXPECT_NE(complaint(model).find("what drivers 'motor' and 'second' hold already"),
            std::string::npos);
}

// The size of the drawing and its place are no matter, nor is the last digit of a place.
TEST(RedundantJoints, AreJudgedWhateverTheScale) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    Model model = four_bar();
    model.joints.push_back(pin("E", 2, 1, {10.0, 20.000001}));
    for (Joint& joint : model.joints) {
      Vec2& at = std::get<RevoluteJoint>(joint.kind).at;
      at = size * at + Vec2{1e3 * size, -1e3 * size};
    }
    EXPECT_NE(complaint(model).find("joints.E"), std::string::npos) << size;
    model.joints.pop_back();
    EXPECT_EQ(complaint(model), "") << size;
  }
}

TEST(RedundantJoints, CopeWithAnyModel) {
  Model model = four_bar();
  model.joints.push_back(pin("E", 7, 1, {10.0, 20.0}));
  model.joints.push_back(slide("F", 1, 2, {0.0, 0.0}));
  model.joints.push_back(pin("G", 1, 1, {0.0, 0.0}));
  model.joints.push_back(pin("H", 1, 2, {std::nan(""), 0.0}));
  model.drivers.push_back({"motor", 99, {}, 1.0, LinearHistory{}, {}});
  EXPECT_TRUE(find_redundant_joints(model).empty());
}

TEST(RedundantJoints, OfLongChainsAreFoundSoon) {
  Model model = bodies(3000);
  for (std::size_t b = 1; b < model.bodies.size(); ++b)
    model.joints.push_back(pin("j" + std::to_string(b), b - 1, b, {static_cast<double>(b), 0.0}));
  EXPECT_TRUE(find_redundant_joints(model).empty());
  model.joints.push_back(pin("close", 2999, 0, {1.0, 5.0}));
  model.joints.push_back(pin("again", 2999, 0, {2.0, 5.0}));
  const auto start = std::chrono::steady_clock::now();
  find_redundant_joints(model);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(Joints, ThatDoNothing) {
  Model model = bodies(2);
  model.joints = {pin("A", 0, 1, {0.0, 0.0})};
  model.bodies.push_back(model.bodies[0]);
  model.bodies[2].name = "wall";
  model.joints.push_back(pin("B", 0, 2, {0.0, 0.0}));
  EXPECT_EQ(complaint(model),
            "joints.B.revolute: 'b0' and 'wall' are both fixed: a joint between them does nothing");
  model.joints[1] = slide("B", 1, 1, {1.0, 0.0});
  EXPECT_EQ(complaint(model),
            "joints.B.prismatic.bodies: a joint joins two different bodies, here both are 'b1'");
  model.joints[1] = pin("B", 1, 8, {0.0, 0.0});
  EXPECT_EQ(complaint(model), "joints.B.revolute: there is no body number 8");
}

}  // namespace
}  // namespace flexura

#include <gtest/gtest.h>

#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::ModelText;
using testing::read_valid;

std::vector<Spring> read(const std::string& springs, const std::string& angle = "rad") {
  ModelText text;
  text.units += "angle = \"" + angle + "\"\n";
  text.studies = springs;
  return read_valid(text.text()).springs;
}

const std::string between = "between = [\"ground\", \"stage.P\"]\n";

TEST(Springs, HaveStiffnessAndDamping) {
  const auto springs =
      read("[springs.a]\n" + between + "stiffness = \"3 N/mm\"\ndamping = 0.5\n" + "[springs.b]\n" +
           between + "torsional = 2\n" + "damping = \"0.2 N m s/rad\"\n");
  ASSERT_EQ(springs.size(), 2u);
  EXPECT_EQ(springs[0].stiffness, 3.0);
  EXPECT_EQ(springs[0].damping, 0.5);
  EXPECT_TRUE(springs[1].torsional);
  EXPECT_DOUBLE_EQ(springs[1].damping, 200.0);
}

TEST(Springs, DampersNeedNoStiffness) {
  const auto springs = read("[springs.a]\n" + between + "damping = \"4 N s/m\"\n" +
                            "[springs.b]\n" + between + "torsional = 0\ndamping = \"1 N mm s\"\n");
  ASSERT_EQ(springs.size(), 2u);
  EXPECT_FALSE(springs[0].torsional);
  EXPECT_EQ(springs[0].stiffness, 0.0);
  EXPECT_EQ(springs[0].damping, 4e-3);
  EXPECT_TRUE(springs[1].torsional);
  EXPECT_EQ(springs[1].damping, 1.0);  // the radian left out
}

// Moments per angle count per radian in a model, whatever the file's angles are.
TEST(Springs, DegreesOfTheFileAreRadiansOfTheModel) {
  const auto springs =
      read("[springs.a]\n" + between + "torsional = \"5 N mm/rad\"\nfree_angle = 90\n" +
               "damping = \"3 N mm s\"\n[springs.b]\n" + between + "torsional = 1\n",
           "deg");
  ASSERT_EQ(springs.size(), 2u);
  EXPECT_DOUBLE_EQ(springs[0].stiffness, 5.0);
  EXPECT_DOUBLE_EQ(*springs[0].free, 1.5707963267948966);
  EXPECT_EQ(springs[0].damping, 3.0);
  EXPECT_DOUBLE_EQ(springs[1].stiffness, 57.295779513082323);  // 1 N mm per degree
}

TEST(Bodies, MayFly) {
  ModelText text;
  text.bodies =
      "[bodies.ground]\nfree = true\nmass = 1\n[bodies.stage]\npoints = { P = [10, 5] }\n";
  const Model model = read_valid(text.text());
  EXPECT_TRUE(model.bodies[0].free);
  EXPECT_FALSE(model.bodies[1].free);
}

}  // namespace
}  // namespace flexura

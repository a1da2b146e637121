// Section properties against the textbook.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/geometry/section.hpp"

namespace flexura {
namespace {

TEST(Section, Rectangle) {
  const SectionProperties p = section_properties(RectangleSection{0.1, 2.0});
  EXPECT_DOUBLE_EQ(p.area, 0.2);
  EXPECT_DOUBLE_EQ(p.second_moment, 2.0 * 1e-3 / 12.0);
  EXPECT_DOUBLE_EQ(p.shear_area, 0.2 * 5.0 / 6.0);
  EXPECT_DOUBLE_EQ(p.depth, 0.1);
}

TEST(Section, Circle) {
  const SectionProperties p = section_properties(CircleSection{3.0});
  EXPECT_DOUBLE_EQ(p.area, std::numbers::pi * 2.25);
  EXPECT_DOUBLE_EQ(p.second_moment, std::numbers::pi * 81.0 / 64.0);
  EXPECT_DOUBLE_EQ(p.shear_area, 0.9 * p.area);
  EXPECT_DOUBLE_EQ(p.depth, 3.0);
}

/// What is left out is that of the rectangle with the same area and second moment.
TEST(Section, GeneralFillsInARectangle) {
  const SectionProperties rectangle = section_properties(RectangleSection{0.1, 2.0});
  GeneralSection general;
  general.area = rectangle.area;
  general.second_moment = rectangle.second_moment;
  const SectionProperties filled = section_properties(general);
  EXPECT_DOUBLE_EQ(filled.shear_area, rectangle.shear_area);
  EXPECT_NEAR(filled.depth, rectangle.depth, 1e-15);
  EXPECT_EQ(filled.rotary_second_moment, general.second_moment);
  general.rotary_second_moment = 2.0;
  EXPECT_EQ(section_properties(general).rotary_second_moment, 2.0);
  EXPECT_EQ(section_properties(general).second_moment, rectangle.second_moment);
  general.shear_area = 0.7;
  general.depth = 0.3;
  EXPECT_EQ(section_properties(general).shear_area, 0.7);
  EXPECT_EQ(section_properties(general).depth, 0.3);
}

}  // namespace
}  // namespace flexura

#include "flexura/core/nearest_word.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace flexura {
namespace {

const std::vector<std::string> keys = {"thickness", "width", "linear", "link2", "poissons_ratio"};

TEST(NearestWord, FindsMisspellings) {
  EXPECT_EQ(nearest_word("thicknes", keys), "thickness");
  EXPECT_EQ(nearest_word("thikcness", keys), "thickness");
  EXPECT_EQ(nearest_word("Width", keys), "width");
  EXPECT_EQ(nearest_word("lnk2", keys), "link2");
  EXPECT_EQ(nearest_word("poisson", keys), "poissons_ratio");
  EXPECT_EQ(nearest_word("GP", std::vector<std::string>{"g", "GPa", "Pa"}), "GPa");
}

TEST(NearestWord, IsSilentWhereNothingIsNear) {
  EXPECT_FALSE(nearest_word("colour", keys).has_value());
  EXPECT_FALSE(nearest_word("", keys).has_value());
  EXPECT_FALSE(nearest_word("x", std::vector<std::string>{"y"}).has_value());
  EXPECT_FALSE(nearest_word(std::string(1000, 'a'), keys).has_value());
}

TEST(NearestWord, CountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("ab", "ba"), 1u);
  EXPECT_EQ(edit_distance("GPa", "gpa"), 0u);
}

TEST(NearestWord, SuggestsOrLists) {
  EXPECT_EQ(suggestion("widht", keys), "; did you mean 'width'?");
  EXPECT_EQ(suggestion("colour", std::vector<std::string>{"a", "b"}), "; valid: a, b");
  EXPECT_EQ(suggestion("colour", {}), "");
}

}  // namespace
}  // namespace flexura

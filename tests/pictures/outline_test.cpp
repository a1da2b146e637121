#include "flexura/pictures/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace flexura::pictures {
namespace {

TEST(ConvexHull, GoesRoundCounterClockwise) {
  const std::vector<Vec2> points = {{0, 0}, {1, 1}, {2, 0}, {1, 0.2}, {2, 2}, {0, 2}, {1, 0}};
  EXPECT_EQ(convex_hull(points), (std::vector<std::size_t>{0, 2, 4, 5}));
}

TEST(ConvexHull, OfPointsInALineIsItsEnds) {
  EXPECT_EQ(convex_hull({{0, 0}, {2, 2}, {1, 1}}), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(convex_hull({{3, 1}, {3, 0}, {3, 2}}), (std::vector<std::size_t>{1, 2}));
}

TEST(ConvexHull, OfOnePlaceIsOnePoint) {
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}, {1, 1}}), std::vector<std::size_t>{0});
  EXPECT_TRUE(convex_hull({}).empty());
}

TEST(LiesInside, KeepsAMarginFromEverySide) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(lies_inside(square, {0.5, 0.5}, 0.1));
  EXPECT_FALSE(lies_inside(square, {0.5, 0.05}, 0.1));
  EXPECT_FALSE(lies_inside(square, {1.5, 0.5}, 0.0));
  EXPECT_FALSE(lies_inside({{0, 0}, {1, 0}}, {0.5, 0.0}, 0.0)) << "a line has no inside";
}

TEST(NeededPoints, AreCornersAndEnoughInBetween) {
  const std::vector<Vec2> line = {{0, 0}, {1, 0}, {2, 0}, {3, 0.001}, {4, 0}, {4, 3}, {4, 9}};
  EXPECT_EQ(needed_points(line, 0.1, 100), (std::vector<std::size_t>{0, 4, 6}));
  EXPECT_EQ(needed_points(line, 0.1, 2), (std::vector<std::size_t>{0, 2, 4, 5, 6}));
  EXPECT_EQ(needed_points(line, 0.0008, 100), (std::vector<std::size_t>{0, 3, 4, 6}));
}

TEST(NeededPoints, OfAClosedLineKeepWhatIsFurthest) {
  EXPECT_EQ(needed_points({{0, 0}, {2, 0}, {2, 2}, {0, 0}}, 0.1, 100),
            (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(needed_points({}, 1, 1).empty());
}

TEST(ShortestArms, JoinEveryPointOnce) {
  const auto arms = shortest_arms({{0, 0}, {10, 0}, {1, 0}, {2, 0}});
  EXPECT_EQ(arms, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {2, 3}, {3, 1}}));
  EXPECT_TRUE(shortest_arms({{1, 2}}).empty());
}

}  // namespace
}  // namespace flexura::pictures

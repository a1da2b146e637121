#include "flexura/report/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexura {
namespace {

PathState state(double load_factor, Vec2 point, Vec2 body) {
  PathState s;
  s.load_factor = load_factor;
  s.points = {point};
  s.bodies = {{body, 0.0}};
  return s;
}

/// The reference moves its point by (3, 4) and its body by (0, 2) over two steps.
PathResult make_path() {
  PathResult path;
  path.bodies = {"stage"};
  path.points = {"stage.P"};
  path.modelings.resize(2);
  path.reference = 1;
  path.modelings[1].states = {state(0.0, {1, 1}, {0, 0}), state(0.5, {2, 3}, {0, 1}),
                              state(1.0, {4, 5}, {0, 2})};
  path.modelings[0].states = {state(0.0, {1, 1}, {0, 0}), state(0.5, {2, 3.5}, {0, 1}),
                              state(1.0, {4, 4}, {0.5, 2})};
  return path;
}

TEST(DifferenceSeries, IsADistanceRelativeToTheLargestDisplacement) {
  const PathResult path = make_path();
  EXPECT_EQ(difference_series(path, path.modelings[0], 0), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(difference_series(path, path.modelings[0], 1), (std::vector<double>{0.0, 0.0, 0.25}));
}

TEST(DifferenceSeries, ComparesAtTheSameLoadFactorOnly) {
  PathResult path = make_path();
  path.modelings[0].states[1].load_factor = 0.25;
  const std::vector<double> series = difference_series(path, path.modelings[0], 0);
  EXPECT_TRUE(std::isnan(series[1]));
  EXPECT_EQ(series[2], 0.2);
}

TEST(DifferenceSeries, EndsWithAReferenceThatStopped) {
  PathResult path = make_path();
  path.modelings[1].states.pop_back();
  const std::vector<double> series = difference_series(path, path.modelings[0], 0);
  EXPECT_NEAR(series[1], 0.5 / std::sqrt(5.0), 1e-15);
  EXPECT_TRUE(std::isnan(series[2]));
}

TEST(DifferenceSeries, IsUnknownWhereTheReferenceDoesNotMove) {
  PathResult path = make_path();
  for (PathState& s : path.modelings[1].states) s.points = {{1, 1}};
  for (const double d : difference_series(path, path.modelings[0], 0)) EXPECT_TRUE(std::isnan(d));
  path.modelings[1].states.clear();
  for (const double d : difference_series(path, path.modelings[0], 0)) EXPECT_TRUE(std::isnan(d));
}

}  // namespace
}  // namespace flexura

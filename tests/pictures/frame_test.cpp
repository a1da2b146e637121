#include "flexura/pictures/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexura::pictures {
namespace {

Drawing one_body() {
  Drawing drawing;
  drawing.bodies.push_back({"arm", false, {1, 0}, {}, {}, {}});
  return drawing;
}

TEST(Carried, TurnsPlacesWithTheirBody) {
  const Drawing drawing = one_body();
  Frame frame = drawn_frame(drawing);
  frame.bodies[0].at = {{5, 5}, std::numbers::pi / 2};
  const Vec2 place = carried(drawing, frame, 0, {3, 0});
  EXPECT_NEAR(place.x, 5, 1e-12);
  EXPECT_NEAR(place.y, 7, 1e-12);
}

TEST(Carried, MovesFurtherToFirstOrder) {
  const Drawing drawing = one_body();
  Frame frame = drawn_frame(drawing);
  frame.bodies[0].further = {{0, 1}, 0.5};
  EXPECT_EQ(carried(drawing, frame, 0, {3, 0}), (Vec2{3, 2}));
}

/// Frames whose only point moves along a parabola.
std::vector<Frame> thrown(const std::vector<double>& times) {
  std::vector<Frame> frames;
  for (const double t : times) {
    Frame frame;
    frame.axes = {{{0, 0}, {t, t * t}}};
    frame.points = {{t, 3 - t * t}};
    frame.share = t;
    frames.push_back(frame);
  }
  return frames;
}

TEST(Resample, ReproducesAParabola) {
  const std::vector<double> times = {0, 0.4, 1, 3};
  const std::vector<Frame> between = resample(thrown(times), times, {0, 0.1, 0.7, 2.5, 3});
  const std::vector<Frame> expected = thrown({0, 0.1, 0.7, 2.5, 3});
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(between[k].points[0].y, expected[k].points[0].y, 1e-12);
    EXPECT_NEAR(between[k].share, expected[k].share, 1e-12);
    EXPECT_NEAR(distance(between[k], expected[k]), 0, 1e-12);
  }
}

TEST(Resample, OfTwoFramesIsStraight) {
  const std::vector<double> times = {0, 2};
  EXPECT_NEAR(resample(thrown(times), times, {1})[0].points[0].y, 1, 1e-12);
}

TEST(Exaggerated, DrawsWhatMovedFurtherAway) {
  const std::vector<Frame> frames = thrown({0, 0.5});
  const Frame far = exaggerated(frames[1], frames[0], 10);
  EXPECT_EQ(far.points[0], (Vec2{5, 0.5}));
  EXPECT_EQ(far.axes[0][1], (Vec2{5, 2.5}));
  EXPECT_EQ(far.share, 0.5) << "loads stay what they are";
}

TEST(MatchAxes, GivesEveryFrameThePointsOfTheFirst) {
  std::vector<Frame> frames(3);
  frames[0].axes = {{{0, 0}, {1, 0}, {2, 0}}};
  frames[1].axes = {{{0, 0}, {4, 2}}};
  frames[2].axes = {{}};
  match_axes(frames);
  EXPECT_EQ(frames[1].axes[0], (std::vector<Vec2>{{0, 0}, {2, 1}, {4, 2}}));
  EXPECT_EQ(frames[2].axes[0].size(), 3U);
}

TEST(Distance, IsTheLargestOfAnyPlace) {
  const std::vector<Frame> frames = thrown({0, 2});
  EXPECT_DOUBLE_EQ(distance(frames[0], frames[1]), std::hypot(2, 4));
}

}  // namespace
}  // namespace flexura::pictures

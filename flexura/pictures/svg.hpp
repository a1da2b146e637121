#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura::pictures {

/// A box that grows round what it is given.
struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void take(Vec2 p, double radius = 0.0);
  bool empty() const { return !(low.x <= high.x); }
};

/// From the plane of the mechanism to pixels, y downwards.
struct Screen {
  double scale = 1.0;  ///< pixels per length
  Vec2 corner;         ///< of the mechanism's plane, at the origin of the pixels

  Vec2 operator()(Vec2 p) const { return {scale * (p.x - corner.x), scale * (corner.y - p.y)}; }
};

/// Path data of SVG in pixels, to a tenth, the corners relative to each other, which is short.
class PathData {
 public:
  /// `box`, if any, is told of all that is drawn, `radius` round it.
  explicit PathData(Box* box = nullptr, double radius = 0.0) : box_(box), radius_(radius) {}

  PathData& move(Vec2 p);
  PathData& line(Vec2 p);
  PathData& curve(Vec2 control, Vec2 end);           ///< quadratic
  PathData& lines(const std::vector<Vec2>& places);  ///< moves to the first
  PathData& close();
  PathData& circle(Vec2 centre, double radius);

  const std::string& text() const { return text_; }

 private:
  void put(char letter, Vec2 p);

  Box* box_;
  double radius_;
  std::string text_;
  long x_ = 0;
  long y_ = 0;
  long start_x_ = 0;
  long start_y_ = 0;
};

/// Which of the values of an element is shown when.
struct Clock {
  std::vector<std::size_t> order;  ///< of the frames, evenly in time; empty: nothing moves
  double seconds = 4.0;
  std::size_t still = 0;  ///< the frame that is shown where nothing moves
};

/// A path, with a value of its data per frame and, if `colours` has any, of its colour.
std::string path_element(const std::string& attributes, const std::vector<std::string>& data,
                         const std::vector<std::string>& colours, const Clock& clock);

/// A path that does not move.
std::string path_element(const std::string& attributes, const PathData& data);

/// Text with what XML reserves escaped, and what is no UTF-8 or no character of XML left out.
std::string escape_xml(std::string_view text);

}  // namespace flexura::pictures

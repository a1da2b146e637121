#include "flexura/pictures/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace flexura::pictures {
namespace {

long tenths(double value) { return std::isfinite(value) ? std::lround(10.0 * value) : 0; }

std::string number(long value) {
  const long whole = std::labs(value) / 10;
  const long rest = std::labs(value) % 10;
  std::string text = value < 0 ? "-" : "";
  if (whole != 0 || rest == 0) text += std::to_string(whole);
  if (rest != 0) text += "." + std::to_string(rest);
  return text;
}

bool all_equal(const std::vector<std::string>& values) {
  return std::ranges::all_of(values, [&](const std::string& v) { return v == values.front(); });
}

/// Nothing where the value stays.
std::string animation(const char* attribute, const std::vector<std::string>& values,
                      const Clock& clock) {
  if (clock.order.empty() || all_equal(values)) return {};
  std::string list;
  for (const std::size_t k : clock.order) list += (list.empty() ? "" : ";") + values[k];
  return fmt::format(
      "<animate attributeName=\"{}\" dur=\"{:g}s\" repeatCount=\"indefinite\" values=\"{}\"/>",
      attribute, clock.seconds, list);
}

/// How many bytes the character of UTF-8 at `i` has; 0 if there is none.
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  std::size_t length = 0;
  if (first < 0x80U) length = 1;
  if (first >= 0xC2U && first < 0xE0U) length = 2;
  if (first >= 0xE0U && first < 0xF0U) length = 3;
  if (first >= 0xF0U && first < 0xF5U) length = 4;
  if (i + length > text.size()) return 0;
  for (std::size_t k = i + 1; k < i + length; ++k)
    if ((byte(k) & 0xC0U) != 0x80U) return 0;
  return length;
}

}  // namespace

void Box::take(Vec2 p, double radius) {
  low = {std::min(low.x, p.x - radius), std::min(low.y, p.y - radius)};
  high = {std::max(high.x, p.x + radius), std::max(high.y, p.y + radius)};
}

void PathData::put(char letter, Vec2 p) {
  if (box_ != nullptr) box_->take(p, radius_);
  const long x = tenths(p.x);
  const long y = tenths(p.y);
  // The first letter counts from the origin, in capitals or not.
  text_ += text_.empty() ? static_cast<char>(letter - 'a' + 'A') : letter;
  const std::string dy = number(text_.size() == 1 ? y : y - y_);
  text_ += number(text_.size() == 1 ? x : x - x_);
  text_ += (dy.front() == '-' ? "" : " ") + dy;
  x_ = x;
  y_ = y;
}

PathData& PathData::move(Vec2 p) {
  put('m', p);
  start_x_ = x_;
  start_y_ = y_;
  return *this;
}

PathData& PathData::line(Vec2 p) {
  put('l', p);
  return *this;
}

PathData& PathData::curve(Vec2 control, Vec2 end) {
  const long x = x_;
  const long y = y_;
  put('q', control);
  x_ = x;  // both places count from the start
  y_ = y;
  put(' ', end);
  return *this;
}

PathData& PathData::lines(const std::vector<Vec2>& places) {
  for (std::size_t k = 0; k < places.size(); ++k) k == 0 ? move(places[k]) : line(places[k]);
  return *this;
}

PathData& PathData::close() {
  text_ += 'z';
  x_ = start_x_;
  y_ = start_y_;
  return *this;
}

PathData& PathData::circle(Vec2 centre, double radius) {
  move(centre - Vec2{radius, 0.0});
  if (box_ != nullptr) box_->take(centre, radius + radius_);
  const std::string r = number(tenths(radius));
  const std::string d = number(2 * tenths(radius));
  text_ += fmt::format("a{0} {0} 0 1 0 {1} 0a{0} {0} 0 1 0-{1} 0z", r, d);
  return *this;
}

std::string path_element(const std::string& attributes, const std::vector<std::string>& data,
                         const std::vector<std::string>& colours, const Clock& clock) {
  std::string colour;
  if (!colours.empty()) colour = fmt::format(" color=\"{}\"", colours[clock.still]);
  const std::string moves =
      animation("d", data, clock) + (colours.empty() ? "" : animation("color", colours, clock));
  const std::string head =
      fmt::format("<path {}{} d=\"{}\"", attributes, colour, data[clock.still]);
  return head + (moves.empty() ? "/>\n" : ">" + moves + "</path>\n");
}

std::string path_element(const std::string& attributes, const PathData& data) {
  return fmt::format("<path {} d=\"{}\"/>\n", attributes, data.text());
}

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    const std::string_view character = text.substr(i, std::max<std::size_t>(1, length));
    i += character.size();
    if (character == "<") {
      escaped += "&lt;";
    } else if (character == ">") {
      escaped += "&gt;";
    } else if (character == "&") {
      escaped += "&amp;";
    } else if (character == "\"") {
      escaped += "&quot;";
    } else if (length > 1 || (length == 1 && static_cast<unsigned char>(character[0]) >= 0x20U)) {
      escaped += character;
    }
  }
  return escaped;
}

}  // namespace flexura::pictures

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flexura/pictures/outline.hpp"
#include "flexura/pictures/parts.hpp"

namespace flexura::pictures {
namespace {

constexpr double thinnest_line = 2.2;
constexpr double thinnest_ghost = 1.6;
constexpr double most_stroked = 4.0;  // pixels; what is thicker gets an outline of its own
constexpr std::size_t ghost_pieces = 14;

/// Evenly taken indices of `count` points, the first and the last among them.
std::vector<std::size_t> picked(std::size_t count, std::size_t pieces) {
  std::vector<std::size_t> indices;
  const std::size_t steps = std::min(pieces, count - 1);
  for (std::size_t k = 0; k <= steps; ++k) indices.push_back(k * (count - 1) / steps);
  return indices;
}

std::vector<Vec2> on_screen(const Screen& screen, const std::vector<Vec2>& axis,
                            const std::vector<std::size_t>& indices) {
  std::vector<Vec2> places;
  places.reserve(indices.size());
  for (const std::size_t k : indices) places.push_back(screen(axis[k]));
  return places;
}

bool is_border(const DrawnFlexure& flexure) { return !(flexure.depth > 0.0); }

double depth_at(const DrawnFlexure& flexure, std::size_t k, std::size_t count) {
  if (flexure.depths.empty()) return flexure.depth;
  return flexure.depths[k * (flexure.depths.size() - 1) / (count - 1)];
}

double greatest_depth(const DrawnFlexure& flexure) {
  return flexure.depths.empty() ? flexure.depth : *std::ranges::max_element(flexure.depths);
}

/// Whether a flexure has an outline of its own, or is a line with a width.
bool is_filled(const DrawnFlexure& flexure, const Screen& screen) {
  return greatest_depth(flexure) * screen.scale > most_stroked;
}

/// Unit normals at the points of a line, by the chord between its neighbours.
std::vector<Vec2> normals(const std::vector<Vec2>& line) {
  std::vector<Vec2> list;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec2 chord = line[std::min(k + 1, line.size() - 1)] - line[k == 0 ? 0 : k - 1];
    const double length = norm(chord);
    list.push_back(length > 0.0 ? (1.0 / length) * perp(chord) : Vec2{});
  }
  return list;
}

/// The pieces of one flexure: their data and strains, frames within pieces.
struct Pieces {
  std::vector<std::vector<std::string>> data;
  std::vector<std::vector<double>> strains;
  std::vector<double> widths;  ///< of the line; 0 where the outline is filled
};

Pieces make_pieces(const Sheet& sheet, std::size_t f) {
  const DrawnFlexure& flexure = sheet.drawing.flexures[f];
  const double scale = sheet.screen.scale;
  const bool filled = is_filled(flexure, sheet.screen);
  Pieces pieces;
  for (std::size_t n = 0; n < sheet.course.frames.size(); ++n) {
    const std::vector<Vec2>& axis = sheet.course.frames[n].axes[f];
    const Frame& ghost = sheet.course.ghosts[std::min(n, sheet.course.ghosts.size() - 1)];
    const std::vector<double> strains = bending_strains(flexure, axis, ghost.axes[f]);
    const std::vector<std::size_t> kept = picked(axis.size(), sheet.pieces);
    const std::vector<Vec2> line = on_screen(sheet.screen, axis, kept);
    const std::vector<Vec2> across = normals(line);
    if (pieces.data.size() < line.size() - 1) {
      pieces.data.resize(line.size() - 1);
      pieces.strains.resize(line.size() - 1);
      pieces.widths.resize(line.size() - 1, 0.0);
    }
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const auto width = [&](std::size_t i) {
        return std::max(thinnest_line, scale * depth_at(flexure, kept[i], axis.size()));
      };
      PathData data(sheet.box, 0.5 * width(k));
      if (filled) {
        const auto corner = [&](std::size_t i, double side) {
          return line[i] + 0.5 * side * width(i) * across[i];
        };
        data.lines({corner(k, 1), corner(k + 1, 1), corner(k + 1, -1), corner(k, -1)}).close();
      } else {
        // Through the middle of the piece.
        const std::size_t twice = kept[k] + kept[k + 1];
        const Vec2 middle =
            0.5 * (sheet.screen(axis[twice / 2]) + sheet.screen(axis[(twice + 1) / 2]));
        data.move(line[k]).curve(2.0 * middle - 0.5 * (line[k] + line[k + 1]), line[k + 1]);
        pieces.widths[k] = 0.5 * (width(k) + width(k + 1));
      }
      pieces.data[k].push_back(data.text());
      pieces.strains[k].push_back(
          *std::max_element(strains.begin() + static_cast<std::ptrdiff_t>(kept[k]),
                            strains.begin() + static_cast<std::ptrdiff_t>(kept[k + 1]) + 1));
    }
  }
  return pieces;
}

std::string pieces_text(const Pieces& pieces, double largest, const Clock& clock) {
  std::string text;
  for (std::size_t k = 0; k < pieces.data.size(); ++k) {
    std::vector<std::string> colours;
    for (const double strain : pieces.strains[k])
      colours.push_back(heat_colour(largest > 0.0 ? strain / largest : 0.0));
    // An axis whose number of points changes has pieces that not every frame knows.
    std::vector<std::string> data = pieces.data[k];
    data.resize(std::max<std::size_t>(data.size(), 1));
    const std::string attributes =
        pieces.widths[k] > 0.0
            ? fmt::format("class=\"strip\" stroke-width=\"{:.1f}\"", pieces.widths[k])
            : std::string("class=\"solid\"");
    text += path_element(attributes, data, colours, clock);
  }
  return text;
}

std::string border_text(const Sheet& sheet, std::size_t f, const std::vector<Frame>& frames,
                        const char* look) {
  // A border has hundreds of corners, of which most lie on straight sides.
  constexpr double tolerance = 0.3;  // pixels
  constexpr double longest = 40.0;
  const std::vector<Vec2>& first = frames.front().axes[f];
  std::vector<std::size_t> all(first.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::size_t> kept =
      needed_points(on_screen(sheet.screen, first, all), tolerance, longest);
  std::vector<std::string> data;
  for (const Frame& frame : frames) {
    PathData path(sheet.box, 1.0);
    path.lines(on_screen(sheet.screen, frame.axes[f], kept));
    data.push_back(path.close().text());
  }
  Clock clock = sheet.clock;
  if (frames.size() == 1) clock = {};
  return path_element(look, data, {}, clock);
}

bool is_straight(const std::vector<Vec2>& axis) {
  const Vec2 span = axis.back() - axis.front();
  return std::ranges::all_of(axis, [&](Vec2 p) {
    return std::abs(cross(span, p - axis.front())) < 1e-6 * dot(span, span);
  });
}

}  // namespace

std::size_t bytes_of_piece(const DrawnFlexure& flexure, const Screen& screen) {
  return is_filled(flexure, screen) ? 52 : 38;
}

std::string flexure_layer(const Sheet& sheet) {
  std::vector<Pieces> all(sheet.drawing.flexures.size());
  double largest = 0.0;
  std::string text;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (is_border(sheet.drawing.flexures[f])) {
      text += border_text(sheet, f, sheet.course.frames, "class=\"link\"");
      continue;
    }
    all[f] = make_pieces(sheet, f);
    for (const auto& piece : all[f].strains)
      largest = std::max(largest, *std::ranges::max_element(piece));
  }
  for (const Pieces& pieces : all) text += pieces_text(pieces, largest, sheet.clock);
  return text;
}

std::string ghost_flexures(const Sheet& sheet) {
  std::string text;
  for (std::size_t f = 0; f < sheet.drawing.flexures.size(); ++f) {
    const DrawnFlexure& flexure = sheet.drawing.flexures[f];
    if (is_border(flexure)) {
      text += border_text(sheet, f, sheet.course.ghosts, "class=\"ghost-link\"");
      continue;
    }
    std::vector<std::string> data;
    const double width = std::max(thinnest_ghost, sheet.screen.scale * flexure.depth);
    for (const Frame& ghost : sheet.course.ghosts) {
      const std::vector<Vec2>& axis = ghost.axes[f];
      PathData path(sheet.box, 0.5 * width);
      const std::size_t pieces = is_straight(axis) ? 1 : ghost_pieces;
      data.push_back(path.lines(on_screen(sheet.screen, axis, picked(axis.size(), pieces))).text());
    }
    Clock clock = sheet.clock;
    if (data.size() == 1) clock = {};
    text += path_element(fmt::format("class=\"ghost\" stroke-width=\"{:.1f}\"", width), data, {},
                         clock);
  }
  return text;
}

}  // namespace flexura::pictures

#pragma once

#include <string>
#include <vector>

#include "flexura/pictures/course.hpp"
#include "flexura/pictures/svg.hpp"

// What a picture is made of, from back to front; included by pictures/*.cpp only.

namespace flexura::pictures {

/// What all parts are drawn by.
struct Sheet {
  const Drawing& drawing;
  const Course& course;
  const Clock& clock;
  Screen screen;
  std::size_t pieces;  ///< of a flexure, each of one colour
  Box* box;            ///< grows round what is drawn
};

std::string ghost_layer(const Sheet& sheet);
std::string ghost_flexures(const Sheet& sheet);
std::string ground_layer(const Sheet& sheet);
std::string body_layer(const Sheet& sheet);
std::string flexure_layer(const Sheet& sheet);
std::string spring_layer(const Sheet& sheet);
std::string joint_layer(const Sheet& sheet);
std::string way_layer(const Sheet& sheet);
std::string load_layer(const Sheet& sheet, const std::vector<DrawnLoad>& loads);

/// Places of a body that its outline goes round, in the plane of the mechanism; as many, in the
/// same order, in every frame.
std::vector<Vec2> outline_places(const Sheet& sheet, const Frame& frame, std::size_t body);

/// About how much text a frame of a piece of a flexure takes, with its colour.
std::size_t bytes_of_piece(const DrawnFlexure& flexure, const Screen& screen);

/// Bending strain at the points of a flexure's axis, from how its curvature differs from that in
/// the ghost, as drawn.
std::vector<double> bending_strains(const DrawnFlexure& flexure, const std::vector<Vec2>& axis,
                                    const std::vector<Vec2>& ghost);

/// "#rgb" for a share from 0 to 1.
std::string heat_colour(double share);
inline constexpr int heat_levels = 24;

}  // namespace flexura::pictures

#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "flexura/geometry/section_profile.hpp"

namespace flexura {

/// `thickness` lies in the plane of motion, `width` across it.
struct RectangleSection {
  double thickness = 0.0;
  double width = 0.0;
  Profile profile = LeafProfile{};        ///< of the thickness along a flexure
  Profile width_profile = LeafProfile{};  ///< of the width along a flexure
};

struct CircleSection {
  double diameter = 0.0;
  Profile profile = LeafProfile{};  ///< of the diameter along a flexure
};

/// Any section by its properties. Left out, the shear area is 5/6 of the area and the depth (the
/// height in the plane of motion, for stress and drawing) that of the rectangle with the same
/// area and second moment, sqrt(12 I/A). `rotary_second_moment` times the density is the rotary
/// inertia per length; it differs from the second moment that bends where the section is made of
/// layers, or is an idealisation.
struct GeneralSection {
  double area = 0.0;
  double second_moment = 0.0;
  std::optional<double> shear_area;
  std::optional<double> depth;
  std::optional<double> rotary_second_moment;  ///< by default the second moment
};

using Section = std::variant<RectangleSection, CircleSection, GeneralSection>;

/// What beam theory needs of a section.
struct SectionProperties {
  double area = 0.0;
  double second_moment = 0.0;  ///< about the axis normal to the plane of motion
  double shear_area = 0.0;     ///< 5/6 A for rectangles, 9/10 A for circles
  double depth = 0.0;          ///< height in the plane of motion; extreme fibres at +-depth/2
  double rotary_second_moment = 0.0;  ///< that of rotary inertia
};

/// Of the section's own thickness and width, without its profiles.
SectionProperties section_properties(const Section& section);

/// At arc length s of a flexure of length `length`.
SectionProperties section_properties(const Section& section, double s, double length);

/// The profiles by which a section varies along a flexure; none if it does not.
std::vector<const Profile*> varying_profiles(const Section& section);

bool section_varies(const Section& section);

/// Arc lengths between 0 and `length`, both included, between which the section is smooth.
std::vector<double> section_breaks(const Section& section, double length);

}  // namespace flexura

#pragma once

#include <optional>
#include <variant>

namespace flexura {

/// `thickness` lies in the plane of motion, `width` across it.
struct RectangleSection {
  double thickness = 0.0;
  double width = 0.0;
};

struct CircleSection {
  double diameter = 0.0;
};

/// Any section by its properties. Left out, the shear area is 5/6 of the area and the depth (the
/// height in the plane of motion, for stress and drawing) that of the rectangle with the same
/// area and second moment, sqrt(12 I/A).
struct GeneralSection {
  double area = 0.0;
  double second_moment = 0.0;
  std::optional<double> shear_area;
  std::optional<double> depth;
};

using Section = std::variant<RectangleSection, CircleSection, GeneralSection>;

/// What beam theory needs of a section.
struct SectionProperties {
  double area = 0.0;
  double second_moment = 0.0;  ///< about the axis normal to the plane of motion
  double shear_area = 0.0;     ///< 5/6 A for rectangles, 9/10 A for circles
  double depth = 0.0;          ///< height in the plane of motion; extreme fibres at +-depth/2
};

SectionProperties section_properties(const Section& section);

}  // namespace flexura

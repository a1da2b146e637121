#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "flexura/results/result.hpp"

namespace flexura {

/// What of a result is to be drawn.
struct PictureRequest {
  std::string study;
  std::string modeling = {};  ///< its label; of a linkage the method; empty: the study's reference
  std::size_t mode = 1;       ///< of studies of kind `modes` and `buckling`, the lowest first
  bool moving = true;
  /// How many times as far as they are displacements are drawn; of a mode the amplitude in length
  /// units. Default: 1, or what lets the eye see them, which the picture then says.
  std::optional<double> exaggeration = {};
};

/// A picture, or a sentence that says why there is none.
struct Picture {
  std::string svg;
  std::string error;

  bool ok() const { return error.empty(); }
};

/// Whether studies of that kind have a shape to draw: all but `linear` and `response`.
bool can_be_drawn(const std::string& study_kind);

/// A self-contained SVG of the mechanism in its most deformed state, pale as drawn behind it; if
/// moving, animated (SMIL): paths, modes and the states of buckling to and fro, motions and turns
/// once and again. Flexures have their true outline, but are never thinner than a line, and the
/// colour of their bending strain. The same result gives the same text. Not longer than about
/// 150 kB, unless there are more than a hundred flexures. Of a study that stopped early, what
/// converged.
Picture make_picture(const Result& result, const PictureRequest& request);

}  // namespace flexura

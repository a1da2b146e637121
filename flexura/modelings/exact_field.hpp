#pragma once

#include <vector>

#include "flexura/assembly/angle_field.hpp"
#include "flexura/modelings/flexure_properties.hpp"
#include "flexura/modelings/point_compliances.hpp"

namespace flexura {

/// Pieces [ends[p], ends[p+1]] of the arc length with `modes` Legendre modes each.
struct ExactPieces {
  std::vector<double> ends;
  int modes = 0;

  std::size_t pieces() const { return ends.size() - 1; }
  std::size_t modes_per_piece() const { return static_cast<std::size_t>(modes); }
  std::size_t unknowns() const { return pieces() * modes_per_piece(); }
};

/// By which a flexure is finer that errors are estimated by.
inline constexpr int more_modes = 4;

/// Gauss points per piece, or per interval of a varying section.
int exact_points(const ExactPieces& pieces);
int varying_exact_points(const ExactPieces& pieces);

/// The angle field of moments M = EI_0/L sum_i y_i P_i, whose turns are the integrals of M/EI;
/// EI_0 is the flexure's (mean) bending stiffness. Constant sections: closed form.
AngleField constant_section_field(const FlexureProperties& flexure, const ExactPieces& pieces);

struct VaryingField {
  AngleField field;
  PointCompliances compliances;
};

/// Likewise, EI varying: turns are integrals of P_i/EI, the stiffness those of P_i P_j/EI, by
/// quadrature graded to the section.
VaryingField varying_section_field(const FlexureProperties& flexure, const ExactPieces& pieces);

}  // namespace flexura

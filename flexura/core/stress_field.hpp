#pragma once

#include <cstddef>
#include <vector>

#include "flexura/core/plane_stress.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// Stress over a strip of quadrilaterals in one state. Node (column, row) is number
/// column * rows + row, and quadrilaterals lie between neighbouring columns and rows. Elements of
/// high order are so many of them along and across; they too are numbered column by column.
struct StressField {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::size_t order_along = 1;
  std::size_t order_across = 1;
  std::vector<Vec2> drawn;             ///< places of the nodes before any load
  std::vector<Vec2> places;            ///< and in the state
  std::vector<PlaneStress> stresses;   ///< true (Cauchy) stress at the nodes, recovered
  std::vector<double> error_energies;  ///< of the stresses' errors, by element: an estimate
  double energy = 0.0;                 ///< of the stresses

  std::size_t node(std::size_t column, std::size_t row) const { return column * rows + row; }
  /// Element of the quadrilateral between a column and the next, a row and the next.
  std::size_t element(std::size_t column, std::size_t row) const {
    return column / order_along * ((rows - 1) / order_across) + row / order_across;
  }
};

}  // namespace flexura

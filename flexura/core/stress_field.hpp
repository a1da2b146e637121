#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "flexura/core/plane_stress.hpp"
#include "flexura/core/vec2.hpp"

namespace flexura {

/// Stress over a flexure in one state. Of a strip, node (column, row) is number
/// column * rows + row, and quadrilaterals lie between neighbouring columns and rows. Elements of
/// high order are so many of them along and across; they too are numbered column by column. A mesh
/// of any shape has `pieces` instead, and no columns and rows.
struct StressField {
  /// Part of an element between some of its nodes, counter-clockwise: a quadrilateral, or a
  /// triangle.
  struct Piece {
    std::array<std::size_t, 4> nodes{};
    std::size_t corners = 4;
    std::size_t element = 0;
  };

  std::size_t columns = 0;
  std::size_t rows = 0;
  std::size_t order_along = 1;
  std::size_t order_across = 1;
  std::vector<Piece> pieces;
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
  /// Calls `visit` with every piece; of a strip, its quadrilaterals.
  template <class Visit>
  void for_pieces(const Visit& visit) const {
    for (const Piece& piece : pieces) visit(piece);
    for (std::size_t c = 0; c + 1 < columns; ++c)
      for (std::size_t r = 0; r + 1 < rows; ++r)
        visit(Piece{
            {node(c, r), node(c + 1, r), node(c + 1, r + 1), node(c, r + 1)}, 4, element(c, r)});
  }
};

}  // namespace flexura

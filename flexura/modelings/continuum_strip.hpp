#pragma once

#include <cstddef>
#include <vector>

#include "flexura/core/envelope_ldlt.hpp"
#include "flexura/core/vec2.hpp"
#include "flexura/modelings/continuum_mesh.hpp"

namespace flexura {

/// How the nodes of an end face move: with three unknowns of the face's pose (displacement over the
/// flexure's length, rotation) if it is the action end, and, where faces may contract, with the
/// slides of all nodes but the last along the face, over the length; the last node's keeps the
/// mean of the slides at zero.
class StripFace {
 public:
  StripFace(const StripMesh& mesh, bool action_end, bool contracting);

  std::size_t unknowns() const { return pose_ + slides_; }
  /// Places of the nodes, and their derivatives, at the face's unknowns.
  void move(const double* y);
  Vec2 place(std::size_t row) const { return places_[row]; }
  Vec2 slope(std::size_t row, std::size_t i) const { return slopes_[row * unknowns() + i]; }
  Vec2 second(std::size_t row, std::size_t i, std::size_t j) const;
  Vec2 axis_end() const { return end_; }

 private:
  double share(std::size_t row, std::size_t slide) const;

  std::size_t pose_ = 0;
  std::size_t slides_ = 0;
  double length_ = 0.0;
  std::vector<Vec2> drawn_;
  Vec2 drawn_end_;
  Vec2 along_;                   // the face, from the first node to the last
  std::vector<double> weights_;  // of the nodes, in the mean
  Vec2 end_;
  double turn_ = 0.0;
  std::vector<Vec2> places_;
  std::vector<Vec2> slopes_;
};

/// Half of a strip, its unknowns numbered from the end face to the middle column of nodes, which
/// both halves share: eliminated from both ends, they meet there.
struct StripSide {
  StripSide(const StripMesh& mesh, bool from_action_end, std::size_t face_unknowns);

  bool reversed = false;
  std::size_t face = 0;     ///< unknowns of the end face: the first
  std::size_t columns = 0;  ///< of nodes behind it
  std::size_t node_columns = 0;
  std::size_t rows = 0;
  std::size_t first_element = 0;  ///< columns of elements
  std::size_t end_element = 0;
  Envelope shape;

  std::size_t size() const { return face + 2 * columns * rows; }
  std::size_t pivots() const { return size() - 2 * rows; }
  /// Distance of a column of nodes from the end face.
  std::size_t depth(std::size_t column) const {
    return reversed ? node_columns - 1 - column : column;
  }
  std::size_t column(std::size_t depth) const {
    return reversed ? node_columns - 1 - depth : depth;
  }
  /// First unknown of a node that is not on the face.
  std::size_t unknown(std::size_t column, std::size_t row) const {
    return face + 2 * ((depth(column) - 1) * rows + row);
  }
};

}  // namespace flexura

#include "flexura/modelings/continuum_strip.hpp"

#include <algorithm>

#include "flexura/core/quadrature.hpp"

namespace flexura {

StripFace::StripFace(const StripMesh& mesh, bool action_end, bool contracting)
    : pose_(action_end ? 3 : 0),
      slides_(contracting ? mesh.rows - 1 : 0),
      length_(mesh.length),
      drawn_end_(action_end ? mesh.chord : Vec2{}) {
  const std::size_t column = action_end ? mesh.columns - 1 : 0;
  for (std::size_t r = 0; r < mesh.rows; ++r) drawn_.push_back(mesh.nodes[mesh.node(column, r)]);
  const Vec2 across = drawn_.back() - drawn_.front();
  along_ = (1.0 / norm(across)) * across;
  const std::size_t q = mesh.cross_line.order();
  const QuadratureRule& rule = gauss_lobatto(static_cast<int>(q) + 1);
  weights_.assign(mesh.rows, 0.0);
  for (std::size_t e = 0; e < mesh.across; ++e)
    for (std::size_t a = 0; a <= q; ++a) weights_[e * q + a] += rule.weights[a];
  places_.resize(mesh.rows);
  slopes_.resize(mesh.rows * unknowns());
}

double StripFace::share(std::size_t row, std::size_t slide) const {
  if (row + 1 == places_.size()) return -weights_[slide] / weights_[row];
  return row == slide ? 1.0 : 0.0;
}

void StripFace::move(const double* y) {
  end_ = drawn_end_;
  turn_ = 0.0;
  if (pose_ > 0) {
    end_ = end_ + length_ * Vec2{y[0], y[1]};
    turn_ = y[2];
  }
  const Vec2 along = rotate(turn_, along_);
  for (std::size_t r = 0; r < places_.size(); ++r) {
    Vec2* slope = slopes_.data() + r * unknowns();
    Vec2 arm = rotate(turn_, drawn_[r] - drawn_end_);
    for (std::size_t k = 0; k < slides_; ++k) {
      slope[pose_ + k] = length_ * share(r, k) * along;
      arm = arm + y[pose_ + k] * slope[pose_ + k];
    }
    places_[r] = end_ + arm;
    if (pose_ == 0) continue;
    slope[0] = {length_, 0.0};
    slope[1] = {0.0, length_};
    slope[2] = perp(arm);
  }
}

Vec2 StripFace::second(std::size_t row, std::size_t i, std::size_t j) const {
  if (pose_ == 0) return {};
  if (i == 2 && j == 2) return end_ - places_[row];
  if (i == 2 && j >= pose_) return perp(slope(row, j));
  if (j == 2 && i >= pose_) return perp(slope(row, i));
  return {};
}

namespace {

/// Last unknown that meets each: that of the far corner of the elements around a node.
Envelope envelope_of(const StripMesh& mesh, const StripSide& side) {
  const std::size_t p = mesh.line.order();
  const std::size_t q = mesh.cross_line.order();
  const auto far_depth = [&](std::size_t depth) {
    return std::min(depth / p * p + p, side.columns);
  };
  std::vector<std::size_t> last(side.size());
  for (std::size_t i = 0; i < side.face; ++i)
    last[i] = side.face + 2 * far_depth(0) * side.rows - 1;
  for (std::size_t d = 1; d <= side.columns; ++d) {
    for (std::size_t r = 0; r < side.rows; ++r) {
      const std::size_t far_row = std::min(r / q * q + q, side.rows - 1);
      const std::size_t i = side.face + 2 * ((d - 1) * side.rows + r);
      const std::size_t corner = side.face + 2 * ((far_depth(d) - 1) * side.rows + far_row) + 1;
      last[i] = last[i + 1] = std::max(corner, i + 1);
    }
  }
  for (std::size_t i = 1; i < last.size(); ++i) last[i] = std::max(last[i], last[i - 1]);
  return Envelope(std::move(last));
}

}  // namespace

StripSide::StripSide(const StripMesh& mesh, bool from_action_end, std::size_t face_unknowns)
    : reversed(from_action_end), face(face_unknowns), node_columns(mesh.columns), rows(mesh.rows) {
  const std::size_t half = mesh.along / 2;
  first_element = reversed ? half : 0;
  end_element = reversed ? mesh.along : half;
  columns = (end_element - first_element) * mesh.line.order();
  shape = envelope_of(mesh, *this);
}

}  // namespace flexura

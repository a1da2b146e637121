#include "flexura/modelings/exact_field.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"

namespace flexura {
namespace {

// Gauss points beyond one per mode: products of two modes and a smooth function of the angle.
constexpr int more_points = 6;
constexpr int least_varying_points = 12;  // what VaryingSection::breaks are graded for

/// Integrals of P_i/L from the start of the piece to x in [-1, 1] of it, and of all before it.
void fill_turns(const ExactPieces& pieces, double length, std::size_t piece, double x,
                double* row) {
  const std::size_t m = pieces.modes_per_piece();
  const auto share = [&](std::size_t p) { return (pieces.ends[p + 1] - pieces.ends[p]) / length; };
  for (std::size_t p = 0; p < piece; ++p) row[p * m] = share(p);
  integrate_legendre(x, std::span(row + piece * m, m));
  for (std::size_t i = 0; i < m; ++i) row[piece * m + i] *= 0.5 * share(piece);
}

/// Quadrature of one piece with a varying section.
class VaryingPiece {
 public:
  VaryingPiece(const FlexureProperties& flexure, const ExactPieces& pieces, std::size_t piece)
      : flexure_(flexure),
        start_(pieces.ends[piece]),
        length_(pieces.ends[piece + 1] - start_),
        first_(piece * pieces.modes_per_piece()),
        legendre_(pieces.modes_per_piece()) {}

  /// Adds `weight` ds EI_0/(EI L) P_i at s to `turns`, from the piece's first mode on.
  double add_turns(double s, double weight, double* turns) {
    evaluate_legendre(2.0 * (s - start_) / length_ - 1.0, legendre_);
    const double factor = weight * flexure_.bending_stiffness /
                          (flexure_.at(s).bending_stiffness * flexure_.axis.length());
    for (std::size_t i = 0; i < legendre_.size(); ++i) turns[first_ + i] += factor * legendre_[i];
    return factor * flexure_.bending_stiffness / flexure_.axis.length();
  }

  /// Adds P_i P_j/EI ds at s to the stiffness and P_i/EI ds to the tip's turn.
  void add_stiffness(double s, double weight, AngleField& field) {
    const double factor = add_turns(s, weight, field.tip_turn.data());
    for (std::size_t i = 0; i < legendre_.size(); ++i)
      for (std::size_t j = 0; j < legendre_.size(); ++j)
        field.stiffness[(first_ + i) * field.unknowns + first_ + j] +=
            factor * legendre_[i] * legendre_[j];
  }

 private:
  const FlexureProperties& flexure_;
  double start_;
  double length_;
  std::size_t first_;
  std::vector<double> legendre_;
};

/// Cuts of [start, end] at breaks inside.
std::vector<double> cuts_between(double start, double end, const std::vector<double>& breaks) {
  std::vector<double> cuts{start};
  for (const double b : breaks)
    if (b > start && b < end) cuts.push_back(b);
  cuts.push_back(end);
  return cuts;
}

}  // namespace

int exact_points(const ExactPieces& pieces) { return pieces.modes + more_points; }

int varying_exact_points(const ExactPieces& pieces) {
  return std::max(least_varying_points, pieces.modes + more_points);
}

AngleField constant_section_field(const FlexureProperties& flexure, const ExactPieces& pieces) {
  const AxisCurve& axis = flexure.axis;
  const double length = axis.length();
  const std::size_t m = pieces.modes_per_piece();
  const std::size_t n = pieces.unknowns();
  const QuadratureRule& rule = gauss_legendre(exact_points(pieces));

  AngleField field;
  field.unknowns = n;
  field.stiffness.assign(n * n, 0.0);
  field.tip_turn.assign(n, 0.0);
  const std::size_t points = pieces.pieces() * rule.nodes.size();
  field.weights.reserve(points);
  field.angles.reserve(points);
  field.turns.assign(points * n, 0.0);
  Vec2 drawn;
  for (std::size_t piece = 0; piece < pieces.pieces(); ++piece) {
    const double start = pieces.ends[piece];
    const double half = 0.5 * (pieces.ends[piece + 1] - start);
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t k = piece * m + i;
      field.stiffness[k * n + k] = flexure.bending_stiffness / length * (2.0 * half / length) /
                                   (2.0 * static_cast<double>(i) + 1.0);
    }
    field.tip_turn[piece * m] = 2.0 * half / length;
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double angle = axis.tangent_angle(start + half * (1.0 + rule.nodes[g]));
      fill_turns(pieces, length, piece, rule.nodes[g],
                 field.turns.data() + field.weights.size() * n);
      field.weights.push_back(half * rule.weights[g]);
      field.angles.push_back(angle);
      field.places.push_back(start + half * (1.0 + rule.nodes[g]));
      drawn = drawn + field.weights.back() * unit(angle);
    }
  }
  field.offset = axis.position(length) - axis.position(0.0) - drawn;
  field.complete_pairs();
  return field;
}

VaryingField varying_section_field(const FlexureProperties& flexure, const ExactPieces& pieces) {
  const AxisCurve& axis = flexure.axis;
  const std::size_t n = pieces.unknowns();
  const QuadratureRule& rule = gauss_legendre(varying_exact_points(pieces));
  const std::vector<double> breaks = flexure.smooth_breaks();

  VaryingField varying;
  AngleField& field = varying.field;
  field.unknowns = n;
  field.stiffness.assign(n * n, 0.0);
  field.tip_turn.assign(n, 0.0);
  Vec2 drawn;
  for (std::size_t p = 0; p < pieces.pieces(); ++p) {
    VaryingPiece piece(flexure, pieces, p);
    const std::vector<double> cuts = cuts_between(pieces.ends[p], pieces.ends[p + 1], breaks);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      const double half = 0.5 * (cuts[c + 1] - cuts[c]);
      const std::vector<double> before = field.tip_turn;
      for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
        const double share = 0.5 * (1.0 + rule.nodes[g]);  // of the interval before the point
        const double s = cuts[c] + 2.0 * half * share;
        std::vector<double> turns = before;
        for (std::size_t q = 0; q < rule.nodes.size(); ++q)
          piece.add_turns(cuts[c] + half * share * (1.0 + rule.nodes[q]),
                          half * share * rule.weights[q], turns.data());
        field.turns.insert(field.turns.end(), turns.begin(), turns.end());
        field.weights.push_back(half * rule.weights[g]);
        field.angles.push_back(axis.tangent_angle(s));
        field.places.push_back(s);
        varying.compliances.add(flexure.at(s));
        drawn = drawn + field.weights.back() * unit(field.angles.back());
      }
      for (std::size_t g = 0; g < rule.nodes.size(); ++g)
        piece.add_stiffness(cuts[c] + half * (1.0 + rule.nodes[g]), half * rule.weights[g], field);
    }
  }
  field.offset = axis.position(axis.length()) - axis.position(0.0) - drawn;
  field.complete_pairs();
  return varying;
}

}  // namespace flexura

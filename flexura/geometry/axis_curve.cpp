#include "flexura/geometry/axis_curve.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"

namespace flexura {
namespace {

constexpr int speed_points = 32;  // Gauss points for the arc length of one spline piece
constexpr int angle_samples = 8;  // per piece; the tangent may turn by less than pi between two

using Equations = std::vector<Eigen::Triplet<double>>;

Vec2 derivative(const Vec2 (&c)[4], double t) {
  return c[1] + (2.0 * t) * c[2] + (3.0 * t * t) * c[3];
}

Vec2 second_derivative(const Vec2 (&c)[4], double t) { return 2.0 * c[2] + (6.0 * t) * c[3]; }

double angle_between(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

/// Arc length of a piece from t = 0 to t.
double piece_length(const Vec2 (&c)[4], double t) {
  const QuadratureRule& rule = gauss_legendre(speed_points);
  double length = 0.0;
  for (std::size_t g = 0; g < rule.nodes.size(); ++g)
    length += rule.weights[g] * norm(derivative(c, 0.5 * t * (1.0 + rule.nodes[g])));
  return 0.5 * t * length;
}

/// Turning of the tangent from t = 0 to t, counted continuously.
double piece_turning(const Vec2 (&c)[4], double t) {
  double turning = 0.0;
  Vec2 before = derivative(c, 0.0);
  for (int k = 1; k <= angle_samples && t > 0.0; ++k) {
    const double to = std::min(t, static_cast<double>(k) / angle_samples);
    const Vec2 now = derivative(c, to);
    turning += angle_between(before, now);
    before = now;
    if (to == t) break;
  }
  return turning;
}

/// Rows for the slopes (d r / d chord length) at one end of the spline: clamped, not-a-knot, or,
/// where there are too few points for that, a vanishing third derivative.
void add_end_condition(const std::vector<double>& h, const std::vector<Vec2>& slope, bool at_start,
                       const std::optional<Vec2>& tangent, bool vanishing, Equations& rows,
                       std::vector<Vec2>& right) {
  const int last = static_cast<int>(h.size());
  const int row = at_start ? 0 : last;
  const auto r = static_cast<std::size_t>(row);
  if (tangent) {
    rows.emplace_back(row, row, 1.0);
    right[r] = (1.0 / norm(*tangent)) * *tangent;
    return;
  }
  const std::size_t end = at_start ? 0 : h.size() - 1;
  const int i = static_cast<int>(end);
  if (vanishing) {
    rows.emplace_back(row, i, 1.0);
    rows.emplace_back(row, i + 1, 1.0);
    right[r] = 2.0 * slope[end];
    return;
  }
  const std::size_t next = at_start ? 1 : end - 1;
  const int j = static_cast<int>(next);
  const double p = 1.0 / (h[end] * h[end]);
  const double q = 1.0 / (h[next] * h[next]);
  rows.emplace_back(row, i, p);
  rows.emplace_back(row, i + 1, p);
  rows.emplace_back(row, j, -q);
  rows.emplace_back(row, j + 1, -q);
  right[r] = (2.0 * p) * slope[end] - (2.0 * q) * slope[next];
}

/// Slopes at the points of the C2 cubic over the cumulative chord length.
std::vector<Vec2> solve_slopes(const SplineAxis& spline, const std::vector<double>& h,
                               const std::vector<Vec2>& slope) {
  const std::size_t n = spline.points.size();
  Equations rows;
  std::vector<Vec2> right(n);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const int i = static_cast<int>(k);
    rows.emplace_back(i, i - 1, h[k]);
    rows.emplace_back(i, i, 2.0 * (h[k - 1] + h[k]));
    rows.emplace_back(i, i + 1, h[k - 1]);
    right[k] = 3.0 * (h[k] * slope[k - 1] + h[k - 1] * slope[k]);
  }
  // Not-a-knot needs a knot inside; at both ends of three points it is the same equation twice.
  const bool both_free = !spline.start_tangent && !spline.end_tangent;
  const bool vanishing = n == 2 || (n == 3 && both_free);
  if (n == 2 && both_free) return {slope[0], slope[0]};
  add_end_condition(h, slope, true, spline.start_tangent, vanishing, rows, right);
  add_end_condition(h, slope, false, spline.end_tangent, vanishing, rows, right);

  Eigen::SparseMatrix<double> matrix(static_cast<int>(n), static_cast<int>(n));
  matrix.setFromTriplets(rows.begin(), rows.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  Eigen::MatrixXd b(static_cast<int>(n), 2);
  for (std::size_t k = 0; k < n; ++k) b.row(static_cast<int>(k)) << right[k].x, right[k].y;
  const Eigen::MatrixXd d = lu.solve(b);
  std::vector<Vec2> slopes(n);
  for (std::size_t k = 0; k < n; ++k)
    slopes[k] = {d(static_cast<int>(k), 0), d(static_cast<int>(k), 1)};
  return slopes;
}

}  // namespace

AxisCurve::AxisCurve(const AxisShape& shape) : shape_(shape), breaks_{0.0} {
  if (const auto* line = std::get_if<LineAxis>(&shape_)) {
    breaks_.push_back(norm(line->end - line->start));
  } else if (const auto* arc = std::get_if<ArcAxis>(&shape_)) {
    breaks_.push_back(arc->radius * std::abs(arc->sweep));
    turning_ = std::abs(arc->sweep);
  } else {
    make_spline(std::get<SplineAxis>(shape_));
  }
}

void AxisCurve::make_spline(const SplineAxis& spline) {
  const std::size_t pieces = spline.points.size() - 1;
  std::vector<double> h(pieces);
  std::vector<Vec2> slope(pieces);
  for (std::size_t k = 0; k < pieces; ++k) {
    const Vec2 chord = spline.points[k + 1] - spline.points[k];
    h[k] = norm(chord);
    slope[k] = (1.0 / h[k]) * chord;
  }
  const std::vector<Vec2> d = solve_slopes(spline, h, slope);
  for (std::size_t k = 0; k < pieces; ++k) {
    Cubic piece;
    piece.c[0] = spline.points[k];
    piece.c[1] = h[k] * d[k];
    piece.c[2] = h[k] * (3.0 * slope[k] - 2.0 * d[k] - d[k + 1]);
    piece.c[3] = h[k] * (d[k] + d[k + 1] - 2.0 * slope[k]);
    if (k == 0) {
      piece.start_angle = std::atan2(piece.c[1].y, piece.c[1].x);
    } else {
      const Cubic& before = pieces_.back();
      piece.start_angle = before.start_angle + piece_turning(before.c, 1.0);
    }
    turning_ += std::abs(piece_turning(piece.c, 1.0));
    breaks_.push_back(breaks_.back() + piece_length(piece.c, 1.0));
    pieces_.push_back(piece);
  }
}

std::size_t AxisCurve::piece_at(double s) const {
  const auto after = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, s);
  return static_cast<std::size_t>(after - breaks_.begin()) - 1;
}

double AxisCurve::parameter_at(std::size_t piece, double s) const {
  const Vec2(&c)[4] = pieces_[piece].c;
  const double target = s - breaks_[piece];
  const double length = breaks_[piece + 1] - breaks_[piece];
  double t = target / length;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double step = (piece_length(c, t) - target) / norm(derivative(c, t));
    t -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return t;
}

Vec2 AxisCurve::position(double s) const {
  if (const auto* line = std::get_if<LineAxis>(&shape_))
    return line->start + (s / length()) * (line->end - line->start);
  if (const auto* arc = std::get_if<ArcAxis>(&shape_))
    return arc->centre + arc->radius * unit(arc->start + arc->sweep * (s / length()));
  const std::size_t piece = piece_at(s);
  const double t = parameter_at(piece, s);
  const Vec2(&c)[4] = pieces_[piece].c;
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

double AxisCurve::tangent_angle(double s) const {
  if (const auto* line = std::get_if<LineAxis>(&shape_))
    return std::atan2(line->end.y - line->start.y, line->end.x - line->start.x);
  if (const auto* arc = std::get_if<ArcAxis>(&shape_))
    return arc->start + std::copysign(0.5 * M_PI, arc->sweep) + arc->sweep * (s / length());
  const std::size_t piece = piece_at(s);
  return pieces_[piece].start_angle + piece_turning(pieces_[piece].c, parameter_at(piece, s));
}

double AxisCurve::curvature(double s) const {
  if (std::holds_alternative<LineAxis>(shape_)) return 0.0;
  if (std::holds_alternative<ArcAxis>(shape_)) return std::get<ArcAxis>(shape_).sweep / length();
  const std::size_t piece = piece_at(s);
  const double t = parameter_at(piece, s);
  const Vec2 first = derivative(pieces_[piece].c, t);
  const double speed = norm(first);
  return cross(first, second_derivative(pieces_[piece].c, t)) / (speed * speed * speed);
}

}  // namespace flexura

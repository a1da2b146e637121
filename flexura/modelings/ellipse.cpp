#include "flexura/modelings/ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/modelings/compliance.hpp"

namespace flexura {
namespace {

/// Eigenvalues of a symmetric 2x2 matrix, greater first, with the direction of the greater. By the
/// half-angle, which keeps full precision where the matrix is nearly a multiple of the identity.
struct Principal {
  double greater = 0.0;
  double lesser = 0.0;
  double angle = 0.0;  // in (-pi/2, pi/2]
};

Principal principal_values(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy);
  const double radius = std::hypot(0.5 * (xx - yy), xy);
  const double greater = mean + radius;
  // the product of the eigenvalues is exact where their difference would cancel
  const double determinant = xx * yy - xy * xy;
  const double lesser = greater > 0.0 ? std::max(0.0, determinant / greater) : 0.0;
  double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  if (angle <= -0.5 * std::numbers::pi) angle += std::numbers::pi;
  return {greater, lesser, angle};
}

ComplianceMatrix to_array(const Eigen::Matrix3d& c) {
  ComplianceMatrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      out[i][j] = c(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return out;
}

}  // namespace

Eigen::Matrix3d shift_compliance(const Eigen::Matrix3d& compliance, Vec2 from, Vec2 to) {
  Eigen::Matrix3d move = Eigen::Matrix3d::Identity();  // displacement at `to` from that at `from`
  move(0, 2) = -(to.y - from.y);
  move(1, 2) = to.x - from.x;
  return move * compliance * move.transpose();
}

std::optional<Ellipse> make_ellipse(const Eigen::Matrix3d& compliance, Vec2 at) {
  const double w = compliance(2, 2);
  if (!(w > 0.0)) return {};
  Ellipse ellipse;
  ellipse.weight = w;
  ellipse.centre = elastic_centre(compliance, at);
  const Eigen::Matrix3d c = shift_compliance(compliance, at, ellipse.centre);
  const Principal p = principal_values(c(0, 0), 0.5 * (c(0, 1) + c(1, 0)), c(1, 1));
  ellipse.major = std::sqrt(p.greater / w);
  ellipse.minor = std::sqrt(p.lesser / w);
  // the long semi-axis lies across the direction of the greater compliance
  ellipse.orientation = p.angle + 0.5 * std::numbers::pi;
  if (ellipse.orientation > 0.5 * std::numbers::pi) ellipse.orientation -= std::numbers::pi;
  return ellipse;
}

std::optional<Line2> antipolar_line(const Ellipse& ellipse, Vec2 p) {
  const Vec2 u = unit(ellipse.orientation);
  const Vec2 v = perp(u);
  const Vec2 d = p - ellipse.centre;
  const double along = dot(d, u);
  const double across = dot(d, v);
  const double size = norm(d);
  if (size <= 1e-12 * ellipse.major || size == 0.0) return {};
  // A segment of elastic weight: every point beside its line has that line for antipolar.
  if (ellipse.minor <= 1e-9 * ellipse.major) {
    if (std::abs(across) > 1e-12 * size) return Line2{ellipse.centre, v, 0.0};
    return Line2{ellipse.centre, u, -ellipse.major * ellipse.major / along};
  }
  const Vec2 n =
      along / (ellipse.major * ellipse.major) * u + across / (ellipse.minor * ellipse.minor) * v;
  const double length = norm(n);
  return Line2{ellipse.centre, (1.0 / length) * n, -1.0 / length};
}

ElasticityRecord make_elasticity_record(ElasticityRecord::Of of, const std::string& name, Vec2 at,
                                        const Eigen::Matrix3d& compliance) {
  ElasticityRecord record;
  record.of = of;
  record.name = name;
  record.at = at;
  record.compliance = to_array(compliance);
  record.ellipse = make_ellipse(compliance, at);
  const Principal p = principal_values(
      compliance(0, 0), 0.5 * (compliance(0, 1) + compliance(1, 0)), compliance(1, 1));
  record.principal_compliances = {p.greater, p.lesser};
  record.principal_directions = {unit(p.angle), perp(unit(p.angle))};
  if (record.ellipse) record.antipolar = antipolar_line(*record.ellipse, at);
  return record;
}

}  // namespace flexura

#include <algorithm>
#include <cmath>
#include <limits>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/modelings/linkage_links.hpp"

namespace flexura {
namespace {

constexpr int plate_stations = 25;
constexpr double small = 1e-5;  // of internal unknowns, which are of order one

/// Displacements and stresses of a field's nodes by the unknowns of a link.
struct FieldRows {
  std::vector<Vec2> drawn;  // from the base end
  Eigen::MatrixXd displacement;
  Eigen::MatrixXd stress;
};

FieldRows rows_of(const MotionPort& port, const Eigen::MatrixXd& inside) {
  const auto field_at = [&](const Eigen::VectorXd& y) { return *port.stress_field(y.data()); };
  const StressField drawn = field_at(Eigen::VectorXd::Zero(inside.rows()));
  const auto nodes = static_cast<Eigen::Index>(drawn.drawn.size());
  FieldRows rows{drawn.drawn, Eigen::MatrixXd::Zero(2 * nodes, inside.cols()),
                 Eigen::MatrixXd::Zero(3 * nodes, inside.cols())};
  for (Eigen::Index j = 0; j < inside.cols(); ++j) {
    const double largest = inside.col(j).lpNorm<Eigen::Infinity>();
    if (largest == 0.0) continue;
    const double h = small / largest;
    const StressField ahead = field_at(h * inside.col(j)), behind = field_at(-h * inside.col(j));
    for (Eigen::Index n = 0; n < nodes; ++n) {
      const auto k = static_cast<std::size_t>(n);
      const Vec2 moved = (0.5 / h) * (ahead.places[k] - behind.places[k]);
      const PlaneStress stress = (0.5 / h) * (ahead.stresses[k] - behind.stresses[k]);
      rows.displacement.col(j).segment<2>(2 * n) << moved.x, moved.y;
      rows.stress.col(j).segment<3>(3 * n) << stress.xx, stress.yy, stress.xy;
    }
  }
  return rows;
}

/// The node farthest to one side of the chord among those near its middle.
std::size_t middle_node(const std::vector<Vec2>& drawn, Vec2 chord, double side) {
  const double length = norm(chord);
  const Vec2 along = (1.0 / length) * chord, across = perp(along);
  std::size_t best = 0;
  double best_score = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const double off = std::abs(dot(drawn[n], along) - 0.5 * length);
    const double score = side * dot(drawn[n], across) - 10.0 * off;
    if (score <= best_score) continue;
    best_score = score;
    best = n;
  }
  return best;
}

}  // namespace

void add_plate_readings(ElasticLink& link, const MotionPort& port, const Material& material,
                        const Eigen::MatrixXd& inside) {
  FieldRows rows = rows_of(port, inside);
  // the base end moves and turns the rest with it
  for (std::size_t n = 0; n < rows.drawn.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(2 * n);
    rows.displacement(row, 0) += 1.0;
    rows.displacement(row + 1, 1) += 1.0;
    rows.displacement(row, 2) -= rows.drawn[n].y;
    rows.displacement(row + 1, 2) += rows.drawn[n].x;
  }
  const Vec2 chord = link.action - link.base;
  const double length = norm(chord);
  const Vec2 along = (1.0 / length) * chord, across = perp(along);
  const auto middle_of = [&](std::size_t n) {
    const double s = dot(rows.drawn[n], along) / length * (plate_stations - 1);
    return static_cast<std::size_t>(std::clamp(std::lround(s), 0L, plate_stations - 1L));
  };
  for (std::size_t n = 0; n < rows.drawn.size(); ++n) link.field.station.push_back(middle_of(n));
  const Eigen::Index size = link.size();
  const Eigen::RowVectorXd none = Eigen::RowVectorXd::Zero(size);
  for (int k = 0; k < plate_stations; ++k) {
    ElasticLink::Station station;
    station.s = length * k / (plate_stations - 1);
    station.place = link.base + station.s * along;
    // drawn by its chord: what the nearest node does
    std::size_t nearest = 0;
    for (std::size_t n = 0; n < rows.drawn.size(); ++n)
      if (norm(rows.drawn[n] - station.s * along) < norm(rows.drawn[nearest] - station.s * along))
        nearest = n;
    station.displacement = rows.displacement.middleRows<2>(2 * static_cast<Eigen::Index>(nearest));
    station.bending_stress = {none, {}};
    station.axial_stress = {none, {}};
    link.stations.push_back(std::move(station));
  }
  const std::size_t upper = middle_node(rows.drawn, chord, 1.0);
  const std::size_t lower = middle_node(rows.drawn, chord, -1.0);
  const auto strain = [&](std::size_t n) {
    const auto row = static_cast<Eigen::Index>(3 * n);
    const auto xx = rows.stress.row(row), yy = rows.stress.row(row + 1),
               xy = rows.stress.row(row + 2);
    const auto normal_stress = [&](Vec2 d) {
      return Eigen::RowVectorXd(d.x * d.x * xx + d.y * d.y * yy + 2.0 * d.x * d.y * xy);
    };
    return Eigen::RowVectorXd(
        (normal_stress(along) - material.poissons_ratio * normal_stress(across)) /
        material.youngs_modulus);
  };
  link.strain = {0.5 * (strain(upper) - strain(lower)), {}};
  link.axial_strain = {0.5 * (strain(upper) + strain(lower)), {}};
  const auto transverse = [&](std::size_t n) {
    const auto row = static_cast<Eigen::Index>(2 * n);
    return Eigen::RowVectorXd(across.x * rows.displacement.row(row) +
                              across.y * rows.displacement.row(row + 1));
  };
  Eigen::RowVectorXd deflection = 0.5 * (transverse(upper) + transverse(lower));
  for (const Eigen::Index end : {0, 3}) {
    deflection[end] -= 0.5 * across.x;
    deflection[end + 1] -= 0.5 * across.y;
  }
  link.deflection = {deflection, {}};
  link.field.stress = std::move(rows.stress);
}

}  // namespace flexura

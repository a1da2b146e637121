#include <algorithm>

#include "flexura/core/cuthill_mckee.hpp"
#include "flexura/modelings/continuum_link_motion.hpp"

namespace flexura {
namespace {

/// Where each of a mesh's unknowns stands in a narrow band. Vertices are the free nodes, in the
/// order of their unknowns, and the action end behind them.
std::vector<std::size_t> band_order(const LinkMesh& mesh) {
  Neighbours neighbours(mesh.pose / 2 + 1);
  std::vector<std::size_t> unknowns;
  const auto vertex = [&](std::size_t i) { return std::min(i, mesh.pose) / 2; };
  for (const LinkBlock& block : mesh.blocks)
    for (std::size_t e = 0; e < block.elements(); ++e) {
      mesh.element_unknowns(block, e, unknowns);
      for (const std::size_t i : unknowns)
        for (const std::size_t j : unknowns)
          if (vertex(i) != vertex(j)) neighbours[vertex(i)].push_back(vertex(j));
    }
  for (std::vector<std::size_t>& own : neighbours) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  std::vector<std::size_t> order(mesh.size());
  std::size_t next = 0;
  for (const std::size_t v : reverse_cuthill_mckee(neighbours)) {
    const std::size_t own = 2 * v == mesh.pose ? 3 : 2;
    for (std::size_t i = 0; i < own; ++i) order[2 * v + i] = next++;
  }
  return order;
}

}  // namespace

LinkMotionPort::LinkMotionPort(const MeshLink& link, const LineAxis& axis, const Material& material,
                               double density, const ContinuumSettings& settings)
    : refinement_(link, axis),
      mesh_(link, axis),
      material_(material),
      density_(density),
      settings_(settings),
      border_(border_of(link.mesh)),
      order_(band_order(mesh_)) {
  place_masses();
}

void LinkMotionPort::place_masses() {
  for (const LinkBlock& block : mesh_.blocks) {
    masses_.push_back(make_tables(block.kind, mass_quadrature_of(block.kind)));
    mesh_.map_elements(block, masses_.back());
  }
  std::vector<std::size_t> unknowns;
  for_elements([&](const LinkBlock& block, std::size_t e, const ElementTables& tables,
                   std::size_t /*first*/) {
    unknowns_of(block, e, unknowns);
    // a triangle between the attachments alone may have none of its own
    if (unknowns.empty()) unknowns.push_back(0);
    const auto [low, high] = std::minmax_element(unknowns.begin(), unknowns.end());
    width_ = std::max(width_, *high - *low);
    const std::size_t per = tables.nodes_per_element();
    const std::size_t count = tables.points.size();
    for (std::size_t g = 0; g < count; ++g) {
      Vec2 place;
      for (std::size_t k = 0; k < per; ++k)
        place = place + tables.values[g * per + k] * mesh_.nodes[block.nodes[e * per + k]];
      const double s = dot(place, mesh_.chord) / mesh_.length;
      points_.push_back({std::clamp(s, 0.0, mesh_.length),
                         density_ * tables.maps[e * count + g].volume,
                         false,
                         *low,
                         *high - *low + 1,
                         {}});
    }
  });
}

Vec2 LinkMotionPort::place(std::size_t node, const double* y) const {
  const std::size_t first = mesh_.unknown[node];
  if (first == LinkMesh::at_base) return mesh_.nodes[node];
  if (first == LinkMesh::at_action) {
    const Pose tip = tip_pose(y);
    return tip.position + arm_of(node, tip.rotation);
  }
  return mesh_.nodes[node] + mesh_.length * Vec2{y[order_[first]], y[order_[first + 1]]};
}

/// Places of the mass points, first and second rates.
void LinkMotionPort::move_points(const double* y, const double* v, const double* a,
                                 const std::vector<Vec2>& places, MemberWork& work) const {
  const auto pair = [&](const double* of, std::size_t first) {
    return mesh_.length * Vec2{of[order_[first]], of[order_[first + 1]]};
  };
  const double spin = v[pose(2)];
  std::vector<Vec2> rates(places.size()), seconds(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const std::size_t first = mesh_.unknown[n];
    if (first == LinkMesh::at_base) continue;
    if (first != LinkMesh::at_action) {
      rates[n] = pair(v, first);
      seconds[n] = pair(a, first);
      continue;
    }
    const Vec2 arm = arm_of(n, y[pose(2)]);
    rates[n] = pair(v, mesh_.pose) + spin * perp(arm);
    seconds[n] = pair(a, mesh_.pose) + a[pose(2)] * perp(arm) - spin * spin * arm;
  }
  for_elements(
      [&](const LinkBlock& block, std::size_t e, const ElementTables& tables, std::size_t first) {
        const std::size_t per = tables.nodes_per_element();
        for (std::size_t g = 0; g < tables.points.size(); ++g) {
          Vec2 place, rate, second;
          for (std::size_t k = 0; k < per; ++k) {
            const std::size_t n = block.nodes[e * per + k];
            const double value = tables.values[g * per + k];
            place = place + value * places[n];
            rate = rate + value * rates[n];
            second = second + value * seconds[n];
          }
          work.places[first + g] = place;
          work.rates[first + g] = rate;
          work.seconds[first + g] = second;
        }
      });
}

std::vector<Vec2> LinkMotionPort::drawn_axis(std::span<const SectionState> /*sections*/,
                                             const double* y) const {
  std::vector<Vec2> border;
  for (const std::size_t n : border_) border.push_back(place(n, y));
  return border;
}

std::vector<double> LinkMotionPort::adopt(std::span<const SectionState> /*sections*/,
                                          std::span<const double> internal) const {
  std::vector<double> y(mesh_.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[order_[i]] = internal[i];
  return y;
}

std::shared_ptr<const MotionPort> LinkMotionPort::refined() const {
  constexpr std::size_t largest = 3000;  // slopes of all places have the width of the band each
  if (mesh_.size() > largest) return nullptr;
  return std::make_shared<LinkMotionPort>(refinement_.fine_link(), refinement_.axis(), material_,
                                          density_, settings_);
}

void LinkMotionPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const LinkMesh& fine = refinement_.fine();
  const std::vector<std::size_t> order = band_order(fine);
  std::fill(refined.begin(), refined.end(), 0.0);
  std::vector<Vec2> moved = places_at(internal.data());
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] = moved[n] - mesh_.nodes[n];
  refinement_.prolong_nodes(moved, &order, refined.data());
  for (std::size_t i = 0; i < 3; ++i) refined[order[fine.pose + i]] = internal[pose(i)];
}

}  // namespace flexura

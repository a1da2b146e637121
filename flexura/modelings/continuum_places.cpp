#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/continuum_port.hpp"

namespace flexura {

std::vector<Vec2> strip_displacements(const ContinuumStrip& strip, const double* nodes,
                                      const double* base, const double* action) {
  const StripMesh& mesh = strip.mesh;
  StripFace faces[2] = {strip.base_face, strip.action_face};
  faces[0].move(base);
  faces[1].move(action);
  std::vector<Vec2> moved;
  moved.reserve(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.columns; ++c) {
    for (std::size_t r = 0; r < mesh.rows; ++r) {
      if (c == 0 || c + 1 == mesh.columns) {
        moved.push_back(faces[c == 0 ? 0 : 1].place(r) - mesh.nodes[mesh.node(c, r)]);
        continue;
      }
      const double* u = nodes + strip.unknowns.node(c, r);
      moved.push_back(mesh.length * Vec2{u[0], u[1]});
    }
  }
  return moved;
}

namespace {

std::vector<Vec2> displacements(const ContinuumStrip& strip, std::span<const double> y) {
  return strip_displacements(strip, y.data(), y.data() + strip.unknowns.base_face,
                             y.data() + strip.unknowns.action_face);
}

/// A place of a strip in another mesh of it: element and reference coordinates.
struct MeshPlace {
  std::size_t ex = 0, ey = 0;
  double xi = 0.0, eta = 0.0;
};
/// From arc length and share of the thickness, 0 to 1.
MeshPlace find_place(const StripMesh& mesh, double s, double share) {
  MeshPlace place;
  place.ex = mesh.find(s, place.xi);
  const double across = share * static_cast<double>(mesh.across);
  place.ey = std::min(mesh.across - 1, static_cast<std::size_t>(std::max(across, 0.0)));
  place.eta = std::clamp(2.0 * (across - static_cast<double>(place.ey)) - 1.0, -1.0, 1.0);
  return place;
}

/// Interpolates from the nodes.
template <class Value>
Value at_place(const StripMesh& mesh, const MeshPlace& place, const std::vector<Value>& nodal) {
  const auto n = mesh.line.values(place.xi);
  const auto m = mesh.cross_line.values(place.eta);
  Value sum{};
  for (std::size_t a = 0; a < n.size(); ++a)
    for (std::size_t b = 0; b < m.size(); ++b)
      sum = sum + (n[a] * m[b]) * nodal[mesh.element_node(place.ex, place.ey, a * m.size() + b)];
  return sum;
}

double share_of_row(const StripMesh& mesh, std::size_t row) {
  const std::size_t q = mesh.cross_line.order();
  const std::size_t e = std::min(row / q, mesh.across - 1);
  return (static_cast<double>(e) + 0.5 * (1.0 + mesh.cross_line.place(row - e * q))) /
         static_cast<double>(mesh.across);
}

}  // namespace

/// What all nodes move by along a change of the unknowns from the last linearization.
std::vector<Vec2> ContinuumPort::node_changes(const double* scratch, const double* step) const {
  const StripMesh& mesh = strip_->mesh;
  const ContinuumUnknowns& unknowns = strip_->unknowns;
  StripFace faces[2] = {strip_->base_face, strip_->action_face};
  faces[0].move(scratch + faces_);
  faces[1].move(scratch + faces_ + faces[0].unknowns());
  const std::size_t at[2] = {unknowns.base_face, unknowns.action_face};
  std::vector<Vec2> changes(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.columns; ++c) {
    for (std::size_t r = 0; r < mesh.rows; ++r) {
      Vec2& change = changes[mesh.node(c, r)];
      if (c > 0 && c + 1 < mesh.columns) {
        const double* u = step + unknowns.node(c, r);
        change = mesh.length * Vec2{u[0], u[1]};
        continue;
      }
      const std::size_t side = c == 0 ? 0 : 1;
      for (std::size_t i = 0; i < faces[side].unknowns(); ++i)
        change = change + step[at[side] + i] * faces[side].slope(r, i);
    }
  }
  return changes;
}

/// Enhanced strains and independent ones of one half go along with its nodes.
void ContinuumPort::follow_strains(std::size_t side, const double* scratch, double residual,
                                   const std::vector<Vec2>& changes, double* step) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t strains_per = 3 * mesh.points.size();
  const auto* places = reinterpret_cast<const Vec2*>(scratch + places_);
  std::vector<Vec2> here(per), moved(per);
  for (std::size_t ex = sides_[side].first_element; ex < sides_[side].end_element; ++ex) {
    for (std::size_t ey = 0; ey < mesh.across; ++ey) {
      const std::size_t e = mesh.element(ex, ey);
      for (std::size_t a = 0; a < per; ++a) {
        here[a] = places[mesh.element_node(ex, ey, a)];
        moved[a] = changes[mesh.element_node(ex, ey, a)];
      }
      const ElementChange change{here.data(), moved.data(), scratch + gaps_ + strains_per * e,
                                 residual};
      double* strains = step + strip_->unknowns.strains + strains_per * e;
      if (strip_->enhanced) {
        double* enhanced = step + strip_->unknowns.enhanced + enhanced_modes * e;
        const EnhancedStrains modes(mesh, ex, ey);
        follow_enhanced(scratch + follow_ + follow_size * e, change, enhanced);
        flexura::follow_strains(mesh, e, change, &modes, enhanced, strains);
      } else {
        flexura::follow_strains(mesh, e, change, nullptr, nullptr, strains);
      }
    }
  }
}

std::vector<SectionState> ContinuumPort::sections(const Eigen::Vector3d& load,
                                                  std::span<const double> internal) const {
  const double* y = internal.data() + strip_->unknowns.action_face;
  const Vec2 tip = strip_->mesh.chord + strip_->mesh.length * Vec2{y[0], y[1]};
  return strip_sections(strip_->mesh, *grid_, displacements(*strip_, internal), tip, load);
}

std::vector<SectionState> strip_sections(const StripMesh& mesh, const StationGrid& grid,
                                         const std::vector<Vec2>& moved, Vec2 tip,
                                         const Eigen::Vector3d& load) {
  const QuadratureRule& rule = gauss_legendre(static_cast<int>(mesh.cross_line.order()) + 1);
  std::vector<SectionState> states;
  double turn = 0.0;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    Vec2 mean, moment, drawn_mean, drawn_moment;
    for (std::size_t e = 0; e < mesh.across; ++e) {
      for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
        const double share = (static_cast<double>(e) + 0.5 * (1.0 + rule.nodes[g])) /
                             static_cast<double>(mesh.across);
        const double weight = 0.5 * rule.weights[g] / static_cast<double>(mesh.across);
        const MeshPlace place = find_place(mesh, grid.s[k], share);
        const Vec2 drawn = at_place(mesh, place, mesh.nodes);
        const Vec2 now = drawn + at_place(mesh, place, moved);
        mean = mean + weight * now;
        drawn_mean = drawn_mean + weight * drawn;
        moment = moment + weight * (share - 0.5) * now;
        drawn_moment = drawn_moment + weight * (share - 0.5) * drawn;
      }
    }
    const double angle = std::atan2(cross(drawn_moment, moment), dot(drawn_moment, moment));
    turn += std::remainder(angle - turn, 2.0 * std::numbers::pi);
    const Vec2 place = grid.positions[k] + mean - drawn_mean;
    states.push_back(section_at(grid, k, {place, turn}, tip, load));
  }
  return states;
}

namespace {

std::shared_ptr<const ContinuumStrip> make_finer(const ContinuumStrip& strip) {
  constexpr std::size_t largest = 40000;
  const StripMesh& mesh = strip.mesh;
  if (strip.unknowns.enhanced > largest) return nullptr;
  ContinuumSettings finer = strip.settings;
  const auto order = static_cast<int>(mesh.line.order());
  const auto order_across = static_cast<int>(mesh.cross_line.order());
  finer.across = static_cast<int>(mesh.across);
  finer.order = order;
  finer.order_across = order_across;
  if (order == 1 && order_across == 1) {
    finer.elements = 2 * static_cast<int>(mesh.along);
    finer.across = 2 * static_cast<int>(mesh.across);
  } else {
    finer.order = order + 1;
    finer.order_across = order_across + 1;
  }
  return std::make_shared<ContinuumStrip>(strip.shape, strip.material, finer, strip.tolerance);
}

}  // namespace

std::shared_ptr<const ContinuumStrip> ContinuumStrip::finer() const {
  std::call_once(finer_made_, [this] { finer_ = make_finer(*this); });
  return finer_;
}

double strip_error_ratio(const StripMesh& mesh) {
  return mesh.line.order() == 1 && mesh.cross_line.order() == 1 ? 4.0 / 3.0 : 1.0;
}

std::shared_ptr<const TwoPort> ContinuumPort::refined() const {
  auto finer = strip_->finer();
  return finer ? std::make_shared<ContinuumPort>(std::move(finer)) : nullptr;
}

double ContinuumPort::error_ratio() const { return strip_error_ratio(strip_->mesh); }

void prolong_nodes(const StripMesh& mesh, const std::vector<Vec2>& moved,
                   const ContinuumStrip& fine, std::span<double> nodes) {
  for (std::size_t c = 1; c + 1 < fine.mesh.columns; ++c) {
    for (std::size_t r = 0; r < fine.mesh.rows; ++r) {
      const MeshPlace place = find_place(mesh, fine.mesh.station(c), share_of_row(fine.mesh, r));
      const Vec2 u = at_place(mesh, place, moved);
      nodes[fine.unknowns.node(c, r)] = u.x / mesh.length;
      nodes[fine.unknowns.node(c, r) + 1] = u.y / mesh.length;
    }
  }
}

/// Displacements through the nodes, strains through the quadrature points; enhanced strains start
/// anew. All linear, so that slopes are prolonged likewise.
void ContinuumPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const auto finer = strip_->finer();
  const ContinuumStrip& fine = *finer;
  std::fill(refined.begin(), refined.end(), 0.0);
  prolong_nodes(strip_->mesh, displacements(*strip_, internal), fine, refined);
  std::copy_n(internal.begin() + static_cast<std::ptrdiff_t>(strip_->unknowns.action_face), 3,
              refined.begin() + static_cast<std::ptrdiff_t>(fine.unknowns.action_face));
  prolong_strains(internal, fine, refined);
}

void ContinuumPort::prolong_strains(std::span<const double> internal, const ContinuumStrip& fine,
                                    std::span<double> refined) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t points = mesh.points.size();
  const std::size_t across = mesh.cross_line.order() + 1;
  const std::size_t fine_points = fine.mesh.points.size();
  for (std::size_t e = 0; e < fine.elements(); ++e) {
    const std::size_t ex = e / fine.mesh.across;
    const std::size_t ey = e % fine.mesh.across;
    for (std::size_t g = 0; g < fine_points; ++g) {
      const StripMesh::Point& point = fine.mesh.points[g];
      const double s =
          fine.mesh.stations[ex] +
          0.5 * (1.0 + point.xi) * (fine.mesh.stations[ex + 1] - fine.mesh.stations[ex]);
      const double share = (static_cast<double>(ey) + 0.5 * (1.0 + point.eta)) /
                           static_cast<double>(fine.mesh.across);
      const MeshPlace place = find_place(mesh, s, share);
      const auto n = through_gauss(points / across, place.xi);
      const auto m = through_gauss(across, place.eta);
      const double* strains = internal.data() + strip_->unknowns.strains +
                              3 * points * mesh.element(place.ex, place.ey);
      double* out = refined.data() + fine.unknowns.strains + 3 * (e * fine_points + g);
      for (std::size_t a = 0; a < points; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          out[i] += n[a / across] * m[a % across] * strains[3 * a + i];
    }
  }
}

}  // namespace flexura

#include <algorithm>
#include <cmath>

#include "flexura/core/cuthill_mckee.hpp"
#include "flexura/modelings/continuum_assembly.hpp"
#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"
#include "flexura/modelings/link_compliance.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {
namespace {

/// A link of any shape in motion: masses at quadrature points of its elements. Unknowns are those
/// of LinkMesh in an order that makes the band of the matrices narrow.
class LinkMotionPort final : public MotionPort {
 public:
  LinkMotionPort(const MeshLink& link, const Material& material, double density,
                 const ContinuumSettings& settings);

  std::size_t internal_size() const override { return mesh_.size(); }
  BandLayout layout() const override { return band_layout(mesh_.size(), width_); }
  const std::vector<MassPoint>& points() const override { return points_; }
  /// The band, then the turn of the action end that it was worked out at.
  std::size_t scratch_size() const override { return turn_at() + 1; }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override {
    return link_sections(mesh_.chord, tip_pose(y), load, false);
  }
  std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                               const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;

 private:
  void number_unknowns();
  void place_masses(double density);
  std::size_t turn_at() const { return mesh_.size() * (width_ + 1); }
  std::size_t pose(std::size_t i) const { return order_[mesh_.pose + i]; }
  Pose tip_pose(const double* y) const {
    return {mesh_.chord + mesh_.length * Vec2{y[pose(0)], y[pose(1)]}, y[pose(2)]};
  }
  Vec2 arm_of(std::size_t node, double turn) const {
    return rotate(turn, mesh_.nodes[node] - mesh_.chord);
  }
  Vec2 place(std::size_t node, const double* y) const;
  /// Unknowns of an element, in this port's order.
  void unknowns_of(const LinkBlock& block, std::size_t element,
                   std::vector<std::size_t>& unknowns) const {
    mesh_.element_unknowns(block, element, unknowns);
    for (std::size_t& i : unknowns) i = order_[i];
  }
  bool is_moved(const LinkBlock& block, std::size_t element) const;
  template <class Density, std::size_t Nodes>
  double assemble(const Density& density, const LinkBlock& block, const std::vector<Vec2>& places,
                  MemberWork& work) const;
  void add_element(const LinkBlock& block, std::size_t element, const ElementTangent& tangent,
                   MemberWork& work) const;
  void move_points(const double* y, const double* v, const double* a,
                   const std::vector<Vec2>& places, MemberWork& work) const;
  /// Calls `use` with block, element, the block's tables for masses and its first mass point.
  template <class Use>
  void for_elements(const Use& use) const;

  LinkMesh mesh_;
  Material material_;
  ContinuumSettings settings_;
  std::vector<std::size_t> border_;
  std::vector<ElementTables> masses_;  // of every block
  std::vector<std::size_t> order_;     // of LinkMesh's unknowns in the band
  std::size_t width_ = 0;
  std::vector<MassPoint> points_;
};

LinkMotionPort::LinkMotionPort(const MeshLink& link, const Material& material, double density,
                               const ContinuumSettings& settings)
    : mesh_(link), material_(material), settings_(settings), border_(border_of(link.mesh)) {
  number_unknowns();
  place_masses(density);
}

template <class Use>
void LinkMotionPort::for_elements(const Use& use) const {
  std::size_t first = 0;
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const ElementTables& tables = masses_[b];
    for (std::size_t e = 0; e < mesh_.blocks[b].elements(); ++e, first += tables.points.size())
      use(mesh_.blocks[b], e, tables, first);
  }
}

/// Vertices are the free nodes, in the order of their unknowns, and the action end behind them.
void LinkMotionPort::number_unknowns() {
  Neighbours neighbours(mesh_.pose / 2 + 1);
  std::vector<std::size_t> unknowns;
  const auto vertex = [&](std::size_t i) { return std::min(i, mesh_.pose) / 2; };
  for (const LinkBlock& block : mesh_.blocks)
    for (std::size_t e = 0; e < block.elements(); ++e) {
      mesh_.element_unknowns(block, e, unknowns);
      for (const std::size_t i : unknowns)
        for (const std::size_t j : unknowns)
          if (vertex(i) != vertex(j)) neighbours[vertex(i)].push_back(vertex(j));
    }
  for (std::vector<std::size_t>& own : neighbours) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  order_.resize(mesh_.size());
  std::size_t next = 0;
  for (const std::size_t v : reverse_cuthill_mckee(neighbours)) {
    const std::size_t own = 2 * v == mesh_.pose ? 3 : 2;
    for (std::size_t i = 0; i < own; ++i) order_[2 * v + i] = next++;
  }
}

void LinkMotionPort::place_masses(double density) {
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
                         density * tables.maps[e * count + g].volume,
                         false,
                         *low,
                         *high - *low + 1,
                         {}});
    }
  });
}

bool LinkMotionPort::is_moved(const LinkBlock& block, std::size_t element) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t* nodes = block.nodes.data() + element * per;
  return std::any_of(nodes, nodes + per,
                     [&](std::size_t n) { return mesh_.unknown[n] == LinkMesh::at_action; });
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

/// What the forces of nodes at the action end add to the second derivative by its turn.
double second_by_turn(const LinkMesh& mesh, const std::size_t* nodes, std::size_t count,
                      double turn, const Vec2* forces) {
  double second = 0.0;
  for (std::size_t a = 0; a < count; ++a)
    if (mesh.unknown[nodes[a]] == LinkMesh::at_action)
      second -= dot(rotate(turn, mesh.nodes[nodes[a]] - mesh.chord), forces[a]);
  return second;
}

void LinkMotionPort::add_element(const LinkBlock& block, std::size_t element,
                                 const ElementTangent& tangent, MemberWork& work) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t* nodes = block.nodes.data() + element * per;
  const double turn = work.scratch[turn_at()];
  std::vector<std::size_t> unknowns;
  unknowns_of(block, element, unknowns);
  const auto n = static_cast<Eigen::Index>(2 * per);
  const auto m = static_cast<Eigen::Index>(unknowns.size());
  const Eigen::MatrixXd slopes = mesh_.slopes(block, element, turn).leftCols(m);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
      stiffness(tangent.stiffness.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> forces(tangent.forces.data(), n);
  Eigen::MatrixXd k = slopes.transpose() * (stiffness.selfadjointView<Eigen::Lower>() * slopes);
  if (is_moved(block, element))
    k(m - 1, m - 1) += second_by_turn(mesh_, nodes, per, turn,
                                      reinterpret_cast<const Vec2*>(tangent.forces.data()));
  const Eigen::VectorXd force = slopes.transpose() * forces;
  const BandLayout rows = layout();
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t row = unknowns[static_cast<std::size_t>(i)];
    work.columns[4 * row] += force[i];
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto [low, high] = std::minmax(row, unknowns[static_cast<std::size_t>(j)]);
      rows.row(work.scratch.data(), high)[low] += k(i, j);
    }
  }
}

template <class Density, std::size_t Nodes>
double LinkMotionPort::assemble(const Density& density, const LinkBlock& block,
                                const std::vector<Vec2>& places, MemberWork& work) const {
  const std::size_t per = block.tables.nodes_per_element();
  const bool enhanced = settings_.enhanced && block.kind == ElementKind::quad4;
  ElementAssembly<Nodes, Density> element(block.tables, density);
  ElementTangent tangent;
  std::vector<Vec2> here(per);
  double energy = 0.0;
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const std::size_t* nodes = block.nodes.data() + e * per;
    for (std::size_t a = 0; a < per; ++a) here[a] = places[nodes[a]];
    if (enhanced) {
      const EnhancedStrains modes({mesh_.nodes[nodes[0]], mesh_.nodes[nodes[1]],
                                   mesh_.nodes[nodes[2]], mesh_.nodes[nodes[3]]});
      element.settle(e, here.data(), &modes, tangent);
    } else {
      element.settle(e, here.data(), nullptr, tangent);
    }
    energy += tangent.energy;
    add_element(block, e, tangent, work);
  }
  return energy;
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

MotionPort::Answer LinkMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                            const double* v, const double* a,
                                            MemberWork& work) const {
  std::vector<Vec2> places(mesh_.nodes.size());
  for (std::size_t n = 0; n < places.size(); ++n) places[n] = place(n, y);
  std::fill(work.columns.begin(), work.columns.end(), 0.0);
  std::fill(work.scratch.begin(), work.scratch.end(), 0.0);
  const Pose tip = tip_pose(y);
  work.scratch[turn_at()] = tip.rotation;
  Answer answer;
  with_density(material_, settings_, [&](const auto& density) {
    using Density = std::remove_cvref_t<decltype(density)>;
    for (const LinkBlock& block : mesh_.blocks)
      answer.energy += block.kind == ElementKind::quad4
                           ? assemble<Density, 4>(density, block, places, work)
                           : assemble<Density, 0>(density, block, places, work);
  });
  answer.tip = {tip.position.x, tip.position.y, tip.rotation};
  const double lever[3] = {mesh_.length, mesh_.length, 1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    work.columns[4 * pose(c)] -= lever[c] * load[static_cast<Eigen::Index>(c)];
    work.columns[4 * pose(c) + c + 1] = -lever[c];
  }
  move_points(y, v, a, places, work);
  return answer;
}

void LinkMotionPort::add_forces(const Vec2* forces, MemberWork& work, double* residual) const {
  std::vector<Vec2> nodal(mesh_.nodes.size());
  for_elements(
      [&](const LinkBlock& block, std::size_t e, const ElementTables& tables, std::size_t first) {
        const std::size_t per = tables.nodes_per_element();
        for (std::size_t g = 0; g < tables.points.size(); ++g)
          for (std::size_t k = 0; k < per; ++k) {
            Vec2& sum = nodal[block.nodes[e * per + k]];
            sum = sum + tables.values[g * per + k] * forces[first + g];
          }
      });
  const double turn = work.scratch[turn_at()];
  for (std::size_t n = 0; n < nodal.size(); ++n) {
    if (mesh_.unknown[n] == LinkMesh::at_base) continue;
    const bool at_tip = mesh_.unknown[n] == LinkMesh::at_action;
    const std::size_t first = at_tip ? mesh_.pose : mesh_.unknown[n];
    residual[order_[first]] += mesh_.length * nodal[n].x;
    residual[order_[first + 1]] += mesh_.length * nodal[n].y;
    if (at_tip) residual[pose(2)] += cross(arm_of(n, turn), nodal[n]);
  }
}

void LinkMotionPort::linearize(const Eigen::Vector3d& /*load*/, const double* y,
                               const Vec2* weights, MemberWork& work) const {
  std::copy_n(work.scratch.begin(), work.tangent.size(), work.tangent.begin());
  std::fill(work.slopes.begin(), work.slopes.end(), Vec2{});
  const double turn = y[pose(2)];
  double second = 0.0;
  Vec2* slope = work.slopes.data();
  for_elements(
      [&](const LinkBlock& block, std::size_t e, const ElementTables& tables, std::size_t first) {
        const std::size_t per = tables.nodes_per_element();
        const std::size_t count = points_[first].count;
        const std::size_t low = points_[first].first;
        for (std::size_t g = 0; g < tables.points.size(); ++g, slope += count)
          for (std::size_t k = 0; k < per; ++k) {
            const std::size_t n = block.nodes[e * per + k];
            const double value = tables.values[g * per + k];
            if (mesh_.unknown[n] == LinkMesh::at_base) continue;
            const bool at_tip = mesh_.unknown[n] == LinkMesh::at_action;
            const std::size_t own = at_tip ? mesh_.pose : mesh_.unknown[n];
            slope[order_[own] - low].x += value * mesh_.length;
            slope[order_[own + 1] - low].y += value * mesh_.length;
            if (!at_tip) continue;
            const Vec2 arm = arm_of(n, turn);
            slope[pose(2) - low] = slope[pose(2) - low] + value * perp(arm);
            if (weights) second -= value * dot(arm, weights[first + g]);
          }
      });
  layout().row(work.tangent.data(), pose(2))[pose(2)] += second;
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

}  // namespace

std::shared_ptr<const MotionPort> make_link_motion_port(const MeshLink& link,
                                                        const Material& material, double density,
                                                        const ContinuumSettings& settings) {
  return std::make_shared<LinkMotionPort>(link, material, density, settings);
}

}  // namespace flexura

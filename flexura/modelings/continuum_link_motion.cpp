#include "flexura/modelings/continuum_link_motion.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/modelings/continuum_assembly.hpp"
#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_link_field.hpp"

namespace flexura {
bool LinkMotionPort::is_moved(const LinkBlock& block, std::size_t element) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t* nodes = block.nodes.data() + element * per;
  return std::any_of(nodes, nodes + per,
                     [&](std::size_t n) { return mesh_.unknown[n] == LinkMesh::at_action; });
}

namespace {

/// What the forces of nodes at the action end add to the second derivative by its turn.
double second_by_turn(const LinkMesh& mesh, const std::size_t* nodes, std::size_t count,
                      double turn, const Vec2* forces) {
  double second = 0.0;
  for (std::size_t a = 0; a < count; ++a)
    if (mesh.unknown[nodes[a]] == LinkMesh::at_action)
      second -= dot(rotate(turn, mesh.nodes[nodes[a]] - mesh.chord), forces[a]);
  return second;
}

}  // namespace

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
                                const std::vector<Vec2>& places, MemberWork* work,
                                double* strains) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t strains_per = 3 * block.tables.points.size();
  const bool enhanced = settings_.enhanced && block.kind == ElementKind::quad4;
  ElementAssembly<Nodes, Density> element(block.tables, density);
  ElementTangent tangent;
  std::vector<Vec2> here(per);
  double energy = 0.0;
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const std::size_t* nodes = block.nodes.data() + e * per;
    for (std::size_t a = 0; a < per; ++a) here[a] = places[nodes[a]];
    double* own = strains ? strains + 3 * block.first_point + e * strains_per : nullptr;
    if (enhanced) {
      const EnhancedStrains modes({mesh_.nodes[nodes[0]], mesh_.nodes[nodes[1]],
                                   mesh_.nodes[nodes[2]], mesh_.nodes[nodes[3]]});
      element.settle(e, here.data(), &modes, tangent, own);
    } else {
      element.settle(e, here.data(), nullptr, tangent, own);
    }
    energy += tangent.energy;
    if (work) add_element(block, e, tangent, *work);
  }
  return energy;
}

double LinkMotionPort::assemble_all(const std::vector<Vec2>& places, MemberWork* work,
                                    double* strains) const {
  double energy = 0.0;
  with_density(material_, settings_, [&](const auto& density) {
    using Density = std::remove_cvref_t<decltype(density)>;
    for (const LinkBlock& block : mesh_.blocks)
      energy += block.kind == ElementKind::quad4
                    ? assemble<Density, 4>(density, block, places, work, strains)
                    : assemble<Density, 0>(density, block, places, work, strains);
  });
  return energy;
}

MotionPort::Answer LinkMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                            const double* v, const double* a,
                                            MemberWork& work) const {
  const std::vector<Vec2> places = places_at(y);
  std::fill(work.columns.begin(), work.columns.end(), 0.0);
  std::fill(work.scratch.begin(), work.scratch.end(), 0.0);
  const Pose tip = tip_pose(y);
  work.scratch[turn_at()] = tip.rotation;
  Answer answer;
  answer.energy = assemble_all(places, &work, nullptr);
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

std::optional<StressField> LinkMotionPort::stress_field(const double* y) const {
  const std::vector<Vec2> places = places_at(y);
  std::vector<double> strains(3 * mesh_.points);
  assemble_all(places, nullptr, strains.data());
  return recover_link_stress(mesh_, material_, settings_, places, strains.data());
}

std::shared_ptr<const MotionPort> make_link_motion_port(const MeshLink& link,
                                                        const Material& material, double density,
                                                        const ContinuumSettings& settings) {
  return std::make_shared<LinkMotionPort>(link, link_axis(link), material, density, settings);
}

}  // namespace flexura

#include "flexura/modelings/continuum_link.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "flexura/modelings/continuum_assembly.hpp"
#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_link_factor.hpp"
#include "flexura/modelings/continuum_link_field.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"
#include "flexura/modelings/continuum_link_refined.hpp"
#include "flexura/modelings/link_compliance.hpp"

namespace flexura {
namespace {

/// Unknowns: those of the mesh, enhanced strains of four-node elements, strains of every quadrature
/// point, and the cosine (less 1) and sine by which the action nodes are turned. These two follow
/// the rotation of the action end to first order, as strains follow places, and end as its own:
/// turned by it at once, the nodes would strain fine elements about them by its square, over and
/// over.
class LinkPort final : public TwoPort {
 public:
  LinkPort(const MeshLink& link, const LineAxis& axis, const Material& material,
           const ContinuumSettings& settings);

  std::size_t internal_size() const override { return turned_ + 2; }
  std::size_t nodal_size() const override { return mesh_.size(); }
  std::size_t scratch_size() const override { return scratch_size_; }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  void advance(const double* scratch, double residual, const Eigen::Vector3d& load,
               double* step) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& /*load*/,
                          const double* /*internal*/) const override {
    throw std::logic_error("a continuum's second derivatives are never laid out as one matrix");
  }
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return link_sections(mesh_.chord, tip_pose(internal.data()), load, false);
  }
  std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                               std::span<const double> internal) const override;
  std::optional<StressField> stress_field(std::span<const double> internal) const override {
    return recover_link_stress(mesh_, material_, settings_, places_at(internal.data()),
                               internal.data() + strains_);
  }
  std::shared_ptr<const TwoPort> refined() const override;
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return link_error_ratio; }

 private:
  /// Of what a linearization works on. `short_of` is what the turn of the action nodes lacks.
  struct Work {
    double* scratch;
    const double* y;
    LinkFactor& factor;
    Eigen::Matrix<double, Eigen::Dynamic, 4> sides;
    double turn;
    Vec2 short_of;
    double energy;
  };
  Pose tip_pose(const double* y) const {
    const double* tip = y + mesh_.pose;
    return {mesh_.chord + mesh_.length * Vec2{tip[0], tip[1]}, tip[2]};
  }
  /// A turn as cosine and sine.
  static Vec2 turned(Vec2 turn, Vec2 arm) { return turn.x * arm + turn.y * perp(arm); }
  Vec2 turn_of_nodes(const double* y) const { return {1.0 + y[turned_], y[turned_ + 1]}; }
  Vec2 place(std::size_t node, const double* y, const Pose& tip) const;
  std::vector<Vec2> places_at(const double* y) const;
  bool is_enhanced(const LinkBlock& block) const {
    return settings_.enhanced && block.kind == ElementKind::quad4;
  }
  template <class Density>
  void assemble_all(const Density& density, Work& work) const;
  template <class Density, std::size_t Nodes>
  void assemble(const Density& density, const LinkBlock& block, Work& work) const;
  void add_element(const LinkBlock& block, std::size_t element, const ElementTangent& tangent,
                   Work& work) const;
  void add_moved_element(const LinkBlock& block, std::size_t element, const ElementTangent& tangent,
                         Work& work) const;
  void follow(const LinkBlock& block, const double* scratch, double residual,
              const std::vector<Vec2>& changes, double* step) const;

  static constexpr std::size_t follow_size = enhanced_modes * 9;

  LinkRefinement refinement_;
  LinkMesh mesh_;
  Material material_;
  ContinuumSettings settings_;
  std::vector<std::size_t> border_;
  std::size_t enhanced_ = 0;  // unknowns
  std::size_t strains_ = 0;
  std::size_t turned_ = 0;
  std::size_t gaps_ = 0;  // scratch; the places of the nodes come first
  std::size_t follow_ = 0;
  std::size_t solution_ = 0;
  std::size_t turn_ = 0;  // of the action end, and what its nodes lack of it
  std::size_t scratch_size_ = 0;
  mutable LinkFactors factors_;
};

LinkPort::LinkPort(const MeshLink& link, const LineAxis& axis, const Material& material,
                   const ContinuumSettings& settings)
    : refinement_(link, axis),
      mesh_(link, axis),
      material_(material),
      settings_(settings),
      border_(border_of(link.mesh)),
      factors_(mesh_.pattern) {
  std::size_t enhanced = 0;
  for (const LinkBlock& block : mesh_.blocks)
    if (is_enhanced(block)) enhanced += block.elements();
  enhanced_ = mesh_.size();
  strains_ = enhanced_ + enhanced_modes * enhanced;
  turned_ = strains_ + 3 * mesh_.points;
  gaps_ = 2 * mesh_.nodes.size();
  follow_ = gaps_ + 3 * mesh_.points;
  solution_ = follow_ + follow_size * enhanced;
  turn_ = solution_ + 4 * mesh_.size();
  scratch_size_ = turn_ + 3;
}

Vec2 LinkPort::place(std::size_t node, const double* y, const Pose& tip) const {
  const std::size_t first = mesh_.unknown[node];
  if (first == LinkMesh::at_base) return mesh_.nodes[node];
  if (first == LinkMesh::at_action)
    return tip.position + turned(turn_of_nodes(y), mesh_.nodes[node] - mesh_.chord);
  return mesh_.nodes[node] + mesh_.length * Vec2{y[first], y[first + 1]};
}

std::vector<Vec2> LinkPort::places_at(const double* y) const {
  const Pose tip = tip_pose(y);
  std::vector<Vec2> places;
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) places.push_back(place(n, y, tip));
  return places;
}

/// An element that is not fastened to the action end.
void LinkPort::add_element(const LinkBlock& block, std::size_t element,
                           const ElementTangent& tangent, Work& work) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t* nodes = block.nodes.data() + element * per;
  const double length = mesh_.length;
  const double square = length * length;
  double* values = work.factor.values();
  const int* at = mesh_.places.data() + mesh_.first_place[block.first_element + element];
  for (std::size_t a = 0; a < per; ++a) {
    const std::size_t first = mesh_.unknown[nodes[a]];
    if (first == LinkMesh::at_base) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const double* row = tangent.stiffness.data() + (2 * a + i) * 2 * per;
      work.sides(static_cast<Eigen::Index>(first + i), 0) += length * tangent.forces[2 * a + i];
      for (std::size_t b = 0; b <= a; ++b) {
        if (mesh_.unknown[nodes[b]] == LinkMesh::at_base) continue;
        values[*at++] += square * row[2 * b];
        if (b < a || i == 1) values[*at++] += square * row[2 * b + 1];
      }
    }
  }
}

/// An element some of whose nodes move with the action end.
void LinkPort::add_moved_element(const LinkBlock& block, std::size_t element,
                                 const ElementTangent& tangent, Work& work) const {
  const std::size_t per = block.tables.nodes_per_element();
  std::vector<std::size_t> unknowns;
  mesh_.element_unknowns(block, element, unknowns);
  const Eigen::MatrixXd slopes = mesh_.slopes(block, element, work.turn);
  const Eigen::Index n = slopes.rows();
  const Eigen::Index m = slopes.cols();
  Eigen::VectorXd misfit = Eigen::VectorXd::Zero(n);
  double second = 0.0;  // by the turn, of what the forces work on
  for (std::size_t a = 0; a < per; ++a) {
    const std::size_t node = block.nodes[element * per + a];
    if (mesh_.unknown[node] != LinkMesh::at_action) continue;
    const Vec2 arm = mesh_.nodes[node] - mesh_.chord;
    const Vec2 lack = turned(work.short_of, arm);
    misfit.segment<2>(static_cast<Eigen::Index>(2 * a)) << lack.x, lack.y;
    second -= dot(rotate(work.turn, arm), {tangent.forces[2 * a], tangent.forces[2 * a + 1]});
  }
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
      stiffness(tangent.stiffness.data(), n, n);
  Eigen::MatrixXd k = slopes.transpose() * (stiffness.selfadjointView<Eigen::Lower>() * slopes);
  k(m - 1, m - 1) += second;
  const Eigen::VectorXd force =
      slopes.transpose() * (Eigen::Map<const Eigen::VectorXd>(tangent.forces.data(), n) +
                            stiffness.selfadjointView<Eigen::Lower>() * misfit);
  const int* at = mesh_.places.data() + mesh_.first_place[block.first_element + element];
  for (Eigen::Index i = 0; i < m; ++i) {
    work.sides(static_cast<Eigen::Index>(unknowns[static_cast<std::size_t>(i)]), 0) += force[i];
    for (Eigen::Index j = 0; j <= i; ++j) work.factor.values()[*at++] += k(i, j);
  }
}

template <class Density, std::size_t Nodes>
void LinkPort::assemble(const Density& density, const LinkBlock& block, Work& work) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t strains_per = 3 * block.tables.points.size();
  const auto* places = reinterpret_cast<const Vec2*>(work.scratch);
  ElementAssembly<Nodes, Density> assembly(block.tables, density);
  ElementTangent tangent;
  std::vector<Vec2> here(per);
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const std::size_t* nodes = block.nodes.data() + e * per;
    for (std::size_t a = 0; a < per; ++a) here[a] = places[nodes[a]];
    const std::size_t first = 3 * block.first_point + strains_per * e;
    const ElementState state{here.data(), work.y + strains_ + first,
                             work.y + enhanced_ + enhanced_modes * e};
    double* gaps = work.scratch + gaps_ + first;
    if (is_enhanced(block)) {
      const EnhancedStrains modes({mesh_.nodes[nodes[0]], mesh_.nodes[nodes[1]],
                                   mesh_.nodes[nodes[2]], mesh_.nodes[nodes[3]]});
      assembly.assemble(e, state, &modes, tangent, gaps);
      double* follow = work.scratch + follow_ + follow_size * e;
      std::copy(tangent.follow.begin(), tangent.follow.end(), follow);
      std::copy(tangent.rest.begin(), tangent.rest.end(), follow + tangent.follow.size());
    } else {
      assembly.assemble(e, state, nullptr, tangent, gaps);
    }
    work.energy += tangent.energy;
    const auto moved = [&](std::size_t n) { return mesh_.unknown[n] == LinkMesh::at_action; };
    if (std::any_of(nodes, nodes + per, moved))
      add_moved_element(block, e, tangent, work);
    else
      add_element(block, e, tangent, work);
  }
}

template <class Density>
void LinkPort::assemble_all(const Density& density, Work& work) const {
  for (const LinkBlock& block : mesh_.blocks) {
    if (block.kind == ElementKind::quad4)
      assemble<Density, 4>(density, block, work);
    else if (block.kind == ElementKind::triangle6)
      assemble<Density, 6>(density, block, work);
    else
      assemble<Density, 0>(density, block, work);
  }
}

TipResponse LinkPort::linearize(const Eigen::Vector3d& load, const double* internal,
                                double* scratch) const {
  const Pose tip = tip_pose(internal);
  auto* places = reinterpret_cast<Vec2*>(scratch);
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) places[n] = place(n, internal, tip);
  const Vec2 short_of = unit(tip.rotation) - turn_of_nodes(internal);
  scratch[turn_] = tip.rotation;
  scratch[turn_ + 1] = short_of.x;
  scratch[turn_ + 2] = short_of.y;
  std::unique_ptr<LinkFactor> factor = factors_.take();
  factor->clear();
  const auto size = static_cast<Eigen::Index>(mesh_.size());
  Work work{scratch, internal, *factor, {}, tip.rotation, short_of, 0.0};
  work.sides.setZero(size, 4);
  with_density(material_, settings_, [&](const auto& density) { assemble_all(density, work); });
  const Eigen::Vector3d scale(mesh_.length, mesh_.length, 1.0);
  work.sides.bottomRows<3>().col(0) -= scale.cwiseProduct(load);
  work.sides.bottomRightCorner<3, 3>() = scale.asDiagonal();

  TipResponse response;
  response.tip << tip.position.x, tip.position.y, tip.rotation;
  response.strain_energy = work.energy;
  const LinkFactor::Pivots pivots = factor->factorize();
  response.singular = pivots.weak;
  if (!pivots.weak) {
    response.negative = pivots.negative;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 4>> solution(scratch + solution_, size, 4);
    solution = factor->solve(work.sides);
    response.tip -= scale.cwiseProduct(solution.bottomRows<3>().col(0));
    response.flexibility = scale.asDiagonal() * solution.bottomRightCorner<3, 3>();
    response.flexibility = 0.5 * (response.flexibility + response.flexibility.transpose().eval());
  }
  factors_.give_back(std::move(factor));
  return response;
}

void LinkPort::advance(const double* scratch, double residual, const Eigen::Vector3d& load,
                       double* step) const {
  const auto size = static_cast<Eigen::Index>(mesh_.size());
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 4>> solution(scratch + solution_,
                                                                            size, 4);
  Eigen::Map<Eigen::VectorXd>(step, size) =
      solution.rightCols<3>() * load - residual * solution.col(0);
  const double* tip = step + mesh_.pose;
  const Vec2 turn =
      residual * Vec2{scratch[turn_ + 1], scratch[turn_ + 2]} + tip[2] * perp(unit(scratch[turn_]));
  step[turned_] = turn.x;
  step[turned_ + 1] = turn.y;
  std::vector<Vec2> changes(mesh_.nodes.size());
  for (std::size_t n = 0; n < changes.size(); ++n) {
    const std::size_t first = mesh_.unknown[n];
    if (first == LinkMesh::at_base) continue;
    const double* u = first == LinkMesh::at_action ? tip : step + first;
    changes[n] = mesh_.length * Vec2{u[0], u[1]};
    if (first == LinkMesh::at_action)
      changes[n] = changes[n] + turned(turn, mesh_.nodes[n] - mesh_.chord);
  }
  for (const LinkBlock& block : mesh_.blocks) follow(block, scratch, residual, changes, step);
}

/// Enhanced strains and independent ones go along with the nodes.
void LinkPort::follow(const LinkBlock& block, const double* scratch, double residual,
                      const std::vector<Vec2>& changes, double* step) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t strains_per = 3 * block.tables.points.size();
  const auto* places = reinterpret_cast<const Vec2*>(scratch);
  std::vector<Vec2> here(per), moved(per);
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const std::size_t* nodes = block.nodes.data() + e * per;
    for (std::size_t a = 0; a < per; ++a) {
      here[a] = places[nodes[a]];
      moved[a] = changes[nodes[a]];
    }
    const std::size_t first = 3 * block.first_point + strains_per * e;
    const ElementChange change{here.data(), moved.data(), scratch + gaps_ + first, residual};
    if (is_enhanced(block)) {
      double* enhanced = step + enhanced_ + enhanced_modes * e;
      follow_enhanced(scratch + follow_ + follow_size * e, change, enhanced);
      const EnhancedStrains modes({mesh_.nodes[nodes[0]], mesh_.nodes[nodes[1]],
                                   mesh_.nodes[nodes[2]], mesh_.nodes[nodes[3]]});
      follow_strains(block.tables, e, change, &modes, enhanced, step + strains_ + first);
    } else {
      follow_strains(block.tables, e, change, nullptr, nullptr, step + strains_ + first);
    }
  }
}

/// The border of the link.
std::vector<Vec2> LinkPort::drawn_axis(std::span<const SectionState> /*sections*/,
                                       std::span<const double> internal) const {
  const Pose tip = tip_pose(internal.data());
  std::vector<Vec2> border;
  for (const std::size_t n : border_) border.push_back(place(n, internal.data(), tip));
  return border;
}

std::shared_ptr<const TwoPort> LinkPort::refined() const {
  constexpr std::size_t largest = 12000;
  if (mesh_.size() > largest) return nullptr;
  return std::make_shared<LinkPort>(refinement_.fine_link(), refinement_.axis(), material_,
                                    settings_);
}

/// Displacements through the nodes, strains through the quadrature points; enhanced strains start
/// anew. All linear, so that slopes are prolonged likewise.
void LinkPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const LinkMesh& fine = refinement_.fine();
  std::fill(refined.begin(), refined.end(), 0.0);
  std::vector<Vec2> moved = places_at(internal.data());
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] = moved[n] - mesh_.nodes[n];
  refinement_.prolong_nodes(moved, nullptr, refined.data());
  std::copy_n(internal.data() + mesh_.pose, 3, refined.data() + fine.pose);
  const std::size_t turned = refined.size() - 2;
  refinement_.prolong_strains(mesh_, internal.data() + strains_,
                              refined.data() + turned - 3 * fine.points);
  std::copy_n(internal.data() + turned_, 2, refined.data() + turned);
}

}  // namespace

std::shared_ptr<const TwoPort> make_link_port(const MeshLink& link, const Material& material,
                                              const ContinuumSettings& settings) {
  return std::make_shared<LinkPort>(link, link_axis(link), material, settings);
}

Eigen::Matrix3d link_compliance(const MeshLink& link, const Material& material) {
  const LinkPort port(link, link_axis(link), material, {});
  const std::vector<double> rest(port.internal_size(), 0.0);
  std::vector<double> scratch(port.scratch_size());
  const TipResponse response = port.linearize(Eigen::Vector3d::Zero(), rest.data(), scratch.data());
  return response.singular ? Eigen::Matrix3d::Identity().eval() : response.flexibility;
}

}  // namespace flexura

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "flexura/modelings/continuum_element.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"
#include "flexura/modelings/continuum_link_refined.hpp"
#include "flexura/modelings/link_compliance.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {

/// A link of any shape in motion: masses at quadrature points of its elements. Unknowns are those
/// of LinkMesh in an order that makes the band of the matrices narrow.
class LinkMotionPort final : public MotionPort {
 public:
  LinkMotionPort(const MeshLink& link, const LineAxis& axis, const Material& material,
                 double density, const ContinuumSettings& settings);

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
  std::optional<StressField> stress_field(const double* y) const override;
  std::shared_ptr<const MotionPort> refined() const override;
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return link_error_ratio; }

 private:
  void place_masses();
  std::size_t turn_at() const { return mesh_.size() * (width_ + 1); }
  std::size_t pose(std::size_t i) const { return order_[mesh_.pose + i]; }
  Pose tip_pose(const double* y) const {
    return {mesh_.chord + mesh_.length * Vec2{y[pose(0)], y[pose(1)]}, y[pose(2)]};
  }
  Vec2 arm_of(std::size_t node, double turn) const {
    return rotate(turn, mesh_.nodes[node] - mesh_.chord);
  }
  Vec2 place(std::size_t node, const double* y) const;
  std::vector<Vec2> places_at(const double* y) const {
    std::vector<Vec2> places;
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) places.push_back(place(n, y));
    return places;
  }
  /// Unknowns of an element, in this port's order.
  void unknowns_of(const LinkBlock& block, std::size_t element,
                   std::vector<std::size_t>& unknowns) const {
    mesh_.element_unknowns(block, element, unknowns);
    for (std::size_t& i : unknowns) i = order_[i];
  }
  bool is_moved(const LinkBlock& block, std::size_t element) const;
  template <class Density, std::size_t Nodes>
  double assemble(const Density& density, const LinkBlock& block, const std::vector<Vec2>& places,
                  MemberWork* work, double* strains) const;
  /// The energy; forces and stiffness into the work, strains of the quadrature points into
  /// `strains`, where they are not null.
  double assemble_all(const std::vector<Vec2>& places, MemberWork* work, double* strains) const;
  void add_element(const LinkBlock& block, std::size_t element, const ElementTangent& tangent,
                   MemberWork& work) const;
  void move_points(const double* y, const double* v, const double* a,
                   const std::vector<Vec2>& places, MemberWork& work) const;
  /// Calls `use` with block, element, the block's tables for masses and its first mass point.
  template <class Use>
  void for_elements(const Use& use) const;

  LinkRefinement refinement_;
  LinkMesh mesh_;
  Material material_;
  double density_;
  ContinuumSettings settings_;
  std::vector<std::size_t> border_;
  std::vector<ElementTables> masses_;  // of every block
  std::vector<std::size_t> order_;     // of LinkMesh's unknowns in the band
  std::size_t width_ = 0;
  std::vector<MassPoint> points_;
};

template <class Use>
void LinkMotionPort::for_elements(const Use& use) const {
  std::size_t first = 0;
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const ElementTables& tables = masses_[b];
    for (std::size_t e = 0; e < mesh_.blocks[b].elements(); ++e, first += tables.points.size())
      use(mesh_.blocks[b], e, tables, first);
  }
}

}  // namespace flexura

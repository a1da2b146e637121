#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <variant>
#include <vector>

#include "flexura/energy/continuum.hpp"
#include "flexura/modelings/continuum.hpp"
#include "flexura/modelings/continuum_assembly.hpp"
#include "flexura/modelings/continuum_strip.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {

/// Which doubles of the internal unknowns are what: displacements of the nodes between the faces
/// (over the length), unknowns of the base face and of the action face, enhanced strains of every
/// element, strains of every quadrature point.
struct ContinuumUnknowns {
  ContinuumUnknowns(const StripMesh& mesh, std::size_t base, std::size_t action, bool enhanced);

  std::size_t rows = 0;
  std::size_t base_face = 0;
  std::size_t action_face = 0;
  std::size_t enhanced = 0;
  std::size_t strains = 0;
  std::size_t size = 0;

  std::size_t node(std::size_t column, std::size_t row) const {
    return 2 * ((column - 1) * rows + row);
  }
};

/// What is worked out for a strip before any load: mesh, numbering, settings.
struct ContinuumStrip {
  ContinuumStrip(const StripShape& outline, const Material& material,
                 const ContinuumSettings& settings, double tolerance);

  StripShape shape;
  Material material;
  ContinuumSettings settings;
  double tolerance;
  StripMesh mesh;
  bool enhanced;  ///< four-node elements with enhanced strains
  StripFace base_face;
  StripFace action_face;
  ContinuumUnknowns unknowns;

  /// Elements of order 1 halved both ways; others of an order more. Made once, when first asked
  /// for. Null where that would take more than it is worth.
  std::shared_ptr<const ContinuumStrip> finer() const;

  std::size_t elements() const { return mesh.along * mesh.across; }
  std::size_t face_unknowns(std::size_t side) const {
    return side == 0 ? base_face.unknowns() : action_face.unknowns();
  }

 private:
  mutable std::once_flag finer_made_;
  mutable std::shared_ptr<const ContinuumStrip> finer_;
};

/// Displacements of all nodes, by those of the nodes between the faces (numbered as
/// ContinuumUnknowns::node says) and the unknowns of the faces.
std::vector<Vec2> strip_displacements(const ContinuumStrip& strip, const double* nodes,
                                      const double* base, const double* action);

/// Stresses of a strip from the displacements of all its nodes and the strains of its quadrature
/// points.
StressField recover_stress(const ContinuumStrip& strip, const std::vector<Vec2>& moved,
                           const double* strains);

/// The mean place of a section and the turn of its first moment, which are those of the face that
/// would do the same work; with the forces that hold the load on the tip.
std::vector<SectionState> strip_sections(const StripMesh& mesh, const StationGrid& grid,
                                         const std::vector<Vec2>& moved, Vec2 tip,
                                         const Eigen::Vector3d& load);

/// As TwoPort::error_ratio.
double strip_error_ratio(const StripMesh& mesh);
/// Displacements of the nodes of a finer mesh, over the length, from those of all nodes of `mesh`.
void prolong_nodes(const StripMesh& mesh, const std::vector<Vec2>& moved,
                   const ContinuumStrip& fine, std::span<double> nodes);

class ContinuumPort final : public TwoPort {
 public:
  explicit ContinuumPort(std::shared_ptr<const ContinuumStrip> strip);

  std::size_t internal_size() const override { return strip_->unknowns.size; }
  std::size_t nodal_size() const override { return strip_->unknowns.enhanced; }
  std::size_t scratch_size() const override { return scratch_size_; }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  void advance(const double* scratch, double residual, const Eigen::Vector3d& load,
               double* step) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override;
  std::optional<StressField> stress_field(std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override;
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override;

 private:
  /// One half of the strip in the scratch: its matrix, and right-hand sides (one, or four where the
  /// load is) behind it.
  struct SideWork {
    std::size_t matrix = 0;
    std::size_t sides = 0;
  };
  /// Of what both halves work on.
  struct Work {
    double* scratch = nullptr;
    const double* y = nullptr;
    std::array<double, 2> energy{};
    std::array<EnvelopePivots, 2> pivots;
  };
  template <class Density, std::size_t Nodes>
  void assemble(std::size_t side, const Density& density, const StripFace& face, Work& work) const;
  void eliminate_side(std::size_t side, const StripFace& face, const Eigen::Vector3d& load,
                      Work& work) const;
  void add_element(std::size_t side, std::size_t ex, std::size_t ey, const ElementTangent& tangent,
                   double* scratch) const;
  void add_face(std::size_t side, std::size_t ex, std::size_t ey, const ElementTangent& tangent,
                const StripFace& face, double* scratch) const;
  bool at_face(std::size_t side, std::size_t ex) const {
    return sides_[side].reversed ? ex + 1 == strip_->mesh.along : ex == 0;
  }
  /// First unknown of an element's node that is not on the face.
  std::size_t unknown_of(std::size_t side, std::size_t ex, std::size_t ey, std::size_t a) const {
    const std::size_t q = strip_->mesh.cross_line.order();
    return sides_[side].unknown(ex * strip_->mesh.line.order() + a / (q + 1), ey * q + a % (q + 1));
  }
  /// Nodes of an element that are not on the end face: from the first to behind the last.
  std::pair<std::size_t, std::size_t> free_nodes(std::size_t side, std::size_t ex) const;
  bool meet(Work& work, TipResponse& response) const;
  void solve_side(std::size_t side, const double* scratch, double residual,
                  const Eigen::Vector3d& load, double* step) const;
  std::vector<Vec2> node_changes(const double* scratch, const double* step) const;
  void follow_strains(std::size_t side, const double* scratch, double residual,
                      const std::vector<Vec2>& changes, double* step) const;
  void prolong_strains(std::span<const double> internal, const ContinuumStrip& fine,
                       std::span<double> refined) const;
  /// Doubles of `follow_` per element: how its enhanced strains follow, and their rest.
  static constexpr std::size_t follow_size = enhanced_modes * 9;
  std::size_t columns(std::size_t side) const { return side == 0 ? 1 : 4; }

  std::shared_ptr<const ContinuumStrip> strip_;
  std::array<StripSide, 2> sides_;
  std::array<SideWork, 2> at_;
  std::size_t places_ = 0;  // of all nodes
  std::size_t faces_ = 0;   // unknowns of both faces
  std::size_t middle_ = 0;  // matrix of the middle column, then its four right-hand sides
  std::size_t gaps_ = 0;    // strains of places and enhanced ones less the independent ones
  std::size_t follow_ = 0;  // of enhanced strains
  std::size_t scratch_size_ = 0;
  std::shared_ptr<const StationGrid> grid_;
};

}  // namespace flexura

#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "flexura/geometry/mesh_refinement.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"

namespace flexura {

/// A link's mesh with its elements divided into four, made where it is asked for first.
class LinkRefinement {
 public:
  LinkRefinement(const MeshLink& coarse, const LineAxis& axis) : coarse_(coarse), axis_(axis) {}

  const MeshLink& coarse() const { return coarse_; }
  const LineAxis& axis() const { return axis_; }
  const MeshLink& fine_link() const { return made().of.link; }
  const LinkMesh& fine() const { return made().mesh; }

  /// Unknowns of the fine mesh's free nodes from what all nodes of the coarse one have moved by, at
  /// the places `order` says, or as they are numbered.
  void prolong_nodes(const std::vector<Vec2>& moved, const std::vector<std::size_t>* order,
                     double* fine) const;
  /// Strains of the quadrature points, three each.
  void prolong_strains(const LinkMesh& mesh, const double* strains, double* fine) const;

 private:
  struct Made {
    MeshRefinement of;
    LinkMesh mesh;
  };
  const Made& made() const;

  MeshLink coarse_;
  LineAxis axis_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<Made> made_;
};

/// As TwoPort::error_ratio. The stress is singular where a border that is held meets one that is
/// free, and errors fall like the power 1.4 of the element size in the end, whatever the elements
/// (a clamped corner of 90 degrees has the exponent 0.71; Williams, J. Appl. Mech. 19, 1952).
inline constexpr double link_error_ratio = 1.6;

}  // namespace flexura

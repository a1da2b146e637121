#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/assembly/two_port.hpp"
#include "flexura/model/modeling_settings.hpp"
#include "flexura/modelings/beam_mesh.hpp"
#include "flexura/modelings/flexure_inertia.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {

/// TwoPort::error_ratio of a halved mesh: the error at the ends falls as h^(2 order).
double halving_error_ratio(const BeamMesh& mesh);

/// Interpolates `components` values per node of `mesh`, the first node's zeros left out, at the
/// nodes of `finer`.
void prolong_nodes(const BeamMesh& mesh, const BeamMesh& finer, std::size_t components,
                   std::span<const double> coarse, std::span<double> fine);

/// What a dead load along a flexure does on its nodes, per load factor: the potential is
///     -load_factor (R(-turn) w).r  summed over the axis, r from the base end.
struct DeadLoad {
  std::vector<Vec2> nodal;  ///< integral of shape value and w, of every node but the first
  double along = 0.0;       ///< of w . r as drawn
  double across = 0.0;      ///< of w turned by +90 degrees . r as drawn

  /// Adds gradient (every fourth double of `columns`), derivatives by turn and load factor of the
  /// gradient (`coupling`) and of the potential itself. Unknowns: displacement over `length` and
  /// rotation of each node.
  void add(const Surroundings& surroundings, double length, const double* y, double* columns,
           double* coupling, FieldResponse& field) const;
};
DeadLoad dead_load_on(const BeamMesh& mesh, const FlexureProperties& flexure);

/// Displacement elements in a row, assembled.
struct DisplacementElements {
  std::size_t unknowns = 0;
  std::size_t width = 0;  ///< half bandwidth
  std::size_t tip = 0;    ///< place of the tip's displacement x, y (over `length`) and rotation
  double length = 0.0;
  Vec2 chord;  ///< from base to tip, as drawn
};

/// The rest of TwoPort::linearize once the scratch holds the energy's gradient (every fourth double
/// of the first 4 m) and, behind, its Hessian as a band: puts the load on the tip and eliminates.
void eliminate_displacements(const DisplacementElements& e, const Eigen::Vector3d& load,
                             const double* y, double* scratch, TipResponse& response);

/// The rest of TwoPort::linearize_in. Behind the first 8 m doubles, which hold the answer, the
/// scratch has W_y,turn and W_y,factor (every four doubles) and then what `eliminate_displacements`
/// asks for; `field` the partial derivatives of W.
void eliminate_with_fields(const DisplacementElements& e, const Eigen::Vector3d& load,
                           const double* y, double* scratch, TipResponse& response,
                           FieldResponse& field);

/// TwoPort::hessian of the same.
Eigen::MatrixXd displacement_hessian(const DisplacementElements& e, double* scratch);

/// Adds to the sections' forces what acts along the flexure ahead of them; `nodes` are the places
/// of the grid's nodes.
void add_dead_forces(const StationGrid& grid, const FlexureProperties& flexure,
                     const Surroundings& surroundings, const std::vector<Vec2>& nodes,
                     std::vector<SectionState>& states);

/// Exact beam elements with the forces as unknowns (see make_beam_port).
std::shared_ptr<const TwoPort> make_force_beam_port(const FlexureProperties& flexure,
                                                    const BeamSettings& settings);

/// Elements by von Karman's strains or by the linear theory. Precondition: axial compliance > 0.
std::shared_ptr<const TwoPort> make_hermite_beam_port(const FlexureProperties& flexure,
                                                      const BeamSettings& settings);

/// Their motion: see motion_ports.hpp.
std::shared_ptr<const MotionPort> make_force_beam_motion_port(const FlexureProperties& flexure,
                                                              const FlexureInertia& inertia,
                                                              const BeamSettings& settings);
std::shared_ptr<const MotionPort> make_hermite_motion_port(const FlexureProperties& flexure,
                                                           const FlexureInertia& inertia,
                                                           const BeamSettings& settings);

/// The first source's elements as it prints them. Preconditions: a straight axis, axial compliance
/// > 0.
std::shared_ptr<const TwoPort> make_printed_beam_port(const FlexureProperties& flexure,
                                                      int elements);

}  // namespace flexura

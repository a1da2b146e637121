#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// One flexure of a linkage, linear about its rigid link, in axes that move with the link and are
/// the drawn ones at the start. Its unknowns u are displacements from where rigid links take it, in
/// those axes: base end (x, y, rotation), action end, then what is inside.
struct ElasticLink {
  /// Transverse load per length that an element's interpolation leaves out: by its values at the
  /// element's ends. Added to what u says.
  struct InertiaPart {
    std::size_t element = 0;
    Eigen::RowVector2d by_load = Eigen::RowVector2d::Zero();
  };
  /// A number that results show, by u.
  struct Reading {
    Eigen::RowVectorXd by_u;
    std::vector<InertiaPart> inertia;
  };
  /// A straight element that carries its own inertia between its ends.
  struct Element {
    Vec2 ends[2];  ///< as drawn
    Vec2 normal;
    Eigen::Matrix<double, 2, Eigen::Dynamic> displacement[2];  ///< of the ends by u
    double mass_per_length = 0.0;
  };
  /// A piece of the axis as it takes part in stress stiffening and rotary inertia: the rotation of
  /// its section and its normal force by u, its length and rotary inertia.
  struct Slice {
    Eigen::RowVectorXd rotation;
    Eigen::RowVectorXd normal_force;
    double length = 0.0;
    double rotary_inertia = 0.0;
  };
  /// Where results show the axis and its stress.
  struct Station {
    double s = 0.0;  ///< arc length
    Vec2 place;      ///< as drawn
    Eigen::Matrix<double, 2, Eigen::Dynamic> displacement;
    Reading bending_stress;  ///< of the fibre on the side of +n
    Reading axial_stress;
  };

  /// Of a link of any shape: stresses of its nodes.
  struct Field {
    std::vector<std::size_t> station;  ///< nearest to the node
    Eigen::MatrixXd stress;            ///< xx, yy, xy in the link's axes, by u: three rows per node
  };

  Eigen::Index size() const { return stiffness.rows(); }

  Eigen::Index whole_size = 0;  ///< unknowns before any were left out; 0: none were
  Vec2 base, action;            ///< ends as drawn
  Eigen::MatrixXd stiffness;
  std::vector<Vec2> places;  ///< of its mass, as drawn
  std::vector<double> masses;
  Eigen::MatrixXd slopes;  ///< displacements of the places by u: two rows each
  std::vector<Slice> slices;
  std::vector<Element> elements;
  /// First of two unknowns that are a displacement in the plane; others do not turn with the link.
  std::vector<Eigen::Index> pairs;

  Reading strain;        ///< bending strain of the fibre on the side of +n at mid-length
  Reading axial_strain;  ///< at mid-length
  Reading deflection;    ///< of mid-length across the line between the ends
  std::vector<Station> stations;
  Field field;  ///< empty for strips
};

/// Matrices of a link that do not change in its own axes. With places r + s u in axes that turn at
/// the rate w, the forces of inertia are those of
///     s^T [s u'' + 2 w J s u' + (w' J - w^2) s u] + s^T [(w' J - w^2) r + acceleration of origin],
/// J the turn by +90 degrees: the coupling matrices of Turcic and Midha, eqs. (11) to (13), for any
/// interpolation.
struct LinkInertia {
  Eigen::MatrixXd mass;         ///< sum of m s^T s, and rotary inertia
  Eigen::MatrixXd mass_turned;  ///< sum of m s^T J s: their [mc]
  Eigen::MatrixXd mass_places;  ///< translation alone: sum of m s^T s
  Eigen::MatrixX2d push;        ///< sum of m s^T: by the acceleration of the origin
  Eigen::VectorXd pull;         ///< sum of m s^T r
  Eigen::VectorXd twist;        ///< sum of m s^T J r
  Eigen::VectorXd rotary;       ///< of sections, by w'
};
/// `origin`: as drawn, what places r are counted from.
LinkInertia link_inertia(const ElasticLink& link, Vec2 origin);

/// The same link with displacements of two bodies, at places away from its ends, for the unknowns
/// of its ends: where it is clamped to them. No arm where an end keeps its own.
void attach_with_arms(ElasticLink& link, Vec2 base_arm, Vec2 action_arm);

}  // namespace flexura

#pragma once

#include "flexura/assembly/elastic_link.hpp"
#include "flexura/modelings/flexure_inertia.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Straight two-node elements along the axis, with a linear axial displacement and a cubic
/// deflection: Euler and Bernoulli's (Turcic and Midha, eqs. (5) and (6)), or Timoshenko's with the
/// shape functions that solve his equations without loads (Friedman and Kosmatka, Comput. Struct.
/// 47, 1993) where the flexure has shear compliance.
ElasticLink make_beam_link(const FlexureProperties& flexure, const FlexureInertia& inertia,
                           int elements);

class MotionPort;
/// A modeling's flexure, linear about its drawn state, with no more of its own vibrations than
/// `most_modes` of the lowest with both ends held (Craig and Bampton, AIAA J. 6, 1968): enough to
/// be exact where the flexure has as few unknowns.
ElasticLink make_port_link(const FlexureProperties& flexure, const FlexureInertia& inertia,
                           const Material& material, const MotionPort& port, int most_modes);

/// Stresses of a link that has a stress field, and stations along its chord; `inside`: internal
/// unknowns of the port by those of the link. Strain and deflection at mid-length are those of the
/// two nodes nearest to the border there.
void add_plate_readings(ElasticLink& link, const MotionPort& port, const Material& material,
                        const Eigen::MatrixXd& inside);

}  // namespace flexura

#include "flexura/modelings/continuum_element.hpp"

namespace flexura {

EnhancedStrains::EnhancedStrains(const StripMesh& mesh, std::size_t ex, std::size_t ey) {
  Vec2 by_xi, by_eta;
  constexpr double xi[4] = {-0.25, -0.25, 0.25, 0.25};
  constexpr double eta[4] = {-0.25, 0.25, -0.25, 0.25};
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec2 node = mesh.nodes[mesh.element_node(ex, ey, a)];
    by_xi = by_xi + xi[a] * node;
    by_eta = by_eta + eta[a] * node;
  }
  middle_jacobian = cross(by_xi, by_eta);
  const double i11 = by_eta.y / middle_jacobian, i12 = -by_eta.x / middle_jacobian;
  const double i21 = -by_xi.y / middle_jacobian, i22 = by_xi.x / middle_jacobian;
  // E = J^-T e J^-1, times the squares of the reference coordinates' lengths: strains, not metrics
  const double a = dot(by_xi, by_xi);
  const double b = dot(by_eta, by_eta);
  const double ab = norm(by_xi) * norm(by_eta);
  carry = {{{a * i11 * i11, b * i21 * i21, ab * i11 * i21},
            {a * i12 * i12, b * i22 * i22, ab * i12 * i22},
            {a * 2.0 * i11 * i12, b * 2.0 * i21 * i22, ab * (i11 * i22 + i12 * i21)}}};
}

std::array<std::array<double, enhanced_modes>, 3> EnhancedStrains::at(const StripMesh::Point& point,
                                                                      double jacobian) const {
  const double share = middle_jacobian / jacobian;
  std::array<std::array<double, enhanced_modes>, 3> modes;
  for (std::size_t i = 0; i < 3; ++i)
    modes[i] = {share * carry[i][0] * point.xi, share * carry[i][1] * point.eta,
                share * carry[i][2] * point.xi, share * carry[i][2] * point.eta};
  return modes;
}

}  // namespace flexura

#include "flexura/modelings/continuum_element.hpp"

#include "flexura/core/by_processor.hpp"

namespace flexura {

FLEXURA_BY_PROCESSOR void add_rows(const double (&x)[4], const double (&y)[4],
                                   const double* __restrict dx, const double* __restrict dy,
                                   std::size_t count, double* __restrict row_x,
                                   double* __restrict row_y, std::size_t apart) {
  double* __restrict row_xy = row_x + apart;
  double* __restrict row_yy = row_y + apart;
  for (std::size_t c = 0; c < count; ++c) {
    row_x[c] += x[0] * dx[c] + x[1] * dy[c];
    row_xy[c] += x[2] * dx[c] + x[3] * dy[c];
    row_y[c] += y[0] * dx[c] + y[1] * dy[c];
    row_yy[c] += y[2] * dx[c] + y[3] * dy[c];
  }
}

EnhancedStrains::EnhancedStrains(const StripMesh& mesh, std::size_t ex, std::size_t ey)
    : EnhancedStrains(std::array<Vec2, 4>{
          mesh.nodes[mesh.element_node(ex, ey, 0)], mesh.nodes[mesh.element_node(ex, ey, 1)],
          mesh.nodes[mesh.element_node(ex, ey, 2)], mesh.nodes[mesh.element_node(ex, ey, 3)]}) {}

EnhancedStrains::EnhancedStrains(const std::array<Vec2, 4>& nodes) {
  Vec2 by_xi, by_eta;
  constexpr double xi[4] = {-0.25, -0.25, 0.25, 0.25};
  constexpr double eta[4] = {-0.25, 0.25, -0.25, 0.25};
  for (std::size_t a = 0; a < 4; ++a) {
    by_xi = by_xi + xi[a] * nodes[a];
    by_eta = by_eta + eta[a] * nodes[a];
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

std::array<std::array<double, enhanced_modes>, 3> EnhancedStrains::at(const ElementPoint& point,
                                                                      double jacobian) const {
  const double share = middle_jacobian / jacobian;
  std::array<std::array<double, enhanced_modes>, 3> modes;
  for (std::size_t i = 0; i < 3; ++i)
    modes[i] = {share * carry[i][0] * point.xi, share * carry[i][1] * point.eta,
                share * carry[i][2] * point.xi, share * carry[i][2] * point.eta};
  return modes;
}

void follow_enhanced(const double* follow, const ElementChange& change, double* enhanced) {
  for (std::size_t m = 0; m < enhanced_modes; ++m) {
    enhanced[m] = -change.residual * follow[8 * enhanced_modes + m];
    for (std::size_t a = 0; a < 4; ++a)
      enhanced[m] -= follow[8 * m + 2 * a] * change.changes[a].x +
                     follow[8 * m + 2 * a + 1] * change.changes[a].y;
  }
}

void follow_strains(const ElementTables& tables, std::size_t element, const ElementChange& change,
                    const EnhancedStrains* modes, const double* enhanced, double* strains) {
  const std::size_t per = tables.nodes_per_element();
  const std::size_t points = tables.points.size();
  for (std::size_t g = 0; g < points; ++g) {
    const ElementTables::Map& map = tables.maps[element * points + g];
    Vec2 now[2], by[2];
    for (std::size_t a = 0; a < per; ++a) {
      const double d[2] = {tables.by_xi[g * per + a], tables.by_eta[g * per + a]};
      for (std::size_t k = 0; k < 2; ++k) {
        now[k] = now[k] + d[k] * change.places[a];
        by[k] = by[k] + d[k] * change.changes[a];
      }
    }
    const StrainSlopes b =
        strain_slopes(deformation_gradient(now[0], now[1], map.inverse), map.inverse);
    for (std::size_t i = 0; i < 3; ++i)
      strains[3 * g + i] = change.residual * change.gaps[3 * g + i] + b[i][0] * by[0].x +
                           b[i][1] * by[1].x + b[i][2] * by[0].y + b[i][3] * by[1].y;
    if (!modes) continue;
    const auto extra = modes->at(tables.points[g], map.jacobian());
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t m = 0; m < enhanced_modes; ++m)
        strains[3 * g + i] += extra[i][m] * enhanced[m];
  }
}

}  // namespace flexura

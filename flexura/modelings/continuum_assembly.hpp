#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "flexura/modelings/continuum_element.hpp"

namespace flexura {

/// Forces and stiffness of one element; `Nodes` is their number, or 0 where it is known only at run
/// time. `modes` is null where there are no enhanced strains.
template <std::size_t Nodes, class Density>
class ElementAssembly {
 public:
  ElementAssembly(const ElementTables& mesh, const Density& density)
      : mesh_(mesh), density_(density), nodes_(mesh.nodes_per_element()) {}

  /// `gaps` receives the strains of the places and the enhanced ones less the independent ones,
  /// if it is not null.
  void assemble(std::size_t element, const ElementState& state, const EnhancedStrains* modes,
                ElementTangent& out, double* gaps) {
    out.energy = 0.0;
    out.forces.assign(2 * nodes(), 0.0);
    out.stiffness.assign(4 * nodes() * nodes(), 0.0);
    coupling_ = {};
    own_ = {};
    out.rest = {};
    for (std::size_t g = 0; g < mesh_.points.size(); ++g)
      add_point(element * mesh_.points.size() + g, g, state, modes, out,
                gaps ? gaps + 3 * g : nullptr);
    if constexpr (Nodes == 0) interleave(out);
    if (modes) eliminate_enhanced(out);
  }

  /// In motion: strains are those of the places, and enhanced ones, which have no mass, at any
  /// moment where the energy is least. `strains` receives both together, if it is not null.
  void settle(std::size_t element, const Vec2* places, const EnhancedStrains* modes,
              ElementTangent& out, double* strains = nullptr) {
    std::array<double, enhanced_modes> enhanced{};
    for (int k = 0; k < 10; ++k) {
      assemble(element, {places, nullptr, enhanced.data()}, modes, out, nullptr);
      double rest = 0.0;
      for (std::size_t m = 0; modes && m < enhanced_modes; ++m) {
        enhanced[m] -= out.rest[m];
        rest = std::max(rest, std::abs(out.rest[m]));
      }
      if (rest < 1e-14) break;
    }
    if (!strains) return;
    const std::vector<double> none(3 * mesh_.points.size(), 0.0);  // so that gaps are the strains
    ElementTangent unused;
    assemble(element, {places, none.data(), enhanced.data()}, modes, unused, strains);
  }

 private:
  /// From rows of all x and then all y to pairs of both, as nodes are numbered.
  void interleave(ElementTangent& out) {
    row_.resize(2 * nodes());
    for (std::size_t r = 0; r < 2 * nodes(); ++r) {
      double* row = out.stiffness.data() + r * 2 * nodes();
      std::copy_n(row, 2 * nodes(), row_.begin());
      for (std::size_t c = 0; c <= r / 2; ++c) {
        row[2 * c] = row_[c];
        row[2 * c + 1] = row_[nodes() + c];
      }
    }
  }

  std::size_t nodes() const {
    if constexpr (Nodes > 0) return Nodes;
    return nodes_;
  }

  void add_point(std::size_t at, std::size_t g, const ElementState& state,
                 const EnhancedStrains* modes, ElementTangent& out, double* gap) {
    const ElementTables::Map& map = mesh_.maps[at];
    const double* dx = mesh_.by_xi.data() + g * nodes();
    const double* dy = mesh_.by_eta.data() + g * nodes();
    Vec2 by_xi, by_eta;
    for (std::size_t a = 0; a < nodes(); ++a) {
      by_xi = by_xi + dx[a] * state.places[a];
      by_eta = by_eta + dy[a] * state.places[a];
    }
    const DeformationGradient f = deformation_gradient(by_xi, by_eta, map.inverse);
    std::array<double, 3> total = f.strain();
    std::array<std::array<double, enhanced_modes>, 3> extra{};
    if (modes) {
      extra = modes->at(mesh_.points[g], map.jacobian());
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t m = 0; m < enhanced_modes; ++m)
          total[i] += extra[i][m] * state.enhanced[m];
    }
    const double* own = state.strains ? state.strains + 3 * g : total.data();
    if (gap)
      for (std::size_t i = 0; i < 3; ++i) gap[i] = total[i] - own[i];
    PointEnergy point = point_energy(density_, own, total);
    out.energy += map.volume * point.energy;
    for (std::size_t i = 0; i < 3; ++i) {
      point.stress[i] *= map.volume;
      point.carried[i] *= map.volume;
      for (std::size_t j = 0; j < 3; ++j) point.moduli[i][j] *= map.volume;
    }
    const StrainSlopes b = strain_slopes(f, map.inverse);
    add_nodes(b, point, map.inverse, dx, dy, out);
    if (modes) add_enhanced(b, point, extra, dx, dy, out);
  }

  /// By the chain rule through (g_xi, g_eta), whose slopes by the nodes are the shape functions'.
  void add_nodes(const StrainSlopes& b, const PointEnergy& point,
                 const std::array<double, 4>& inverse, const double* dx, const double* dy,
                 ElementTangent& out) const {
    double db[3][4];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 4; ++c)
        db[i][c] = point.moduli[i][0] * b[0][c] + point.moduli[i][1] * b[1][c] +
                   point.moduli[i][2] * b[2][c];
    double h[4][4];
    double force[4];
    for (std::size_t r = 0; r < 4; ++r) {
      force[r] = b[0][r] * point.stress[0] + b[1][r] * point.stress[1] + b[2][r] * point.stress[2];
      for (std::size_t c = 0; c < 4; ++c)
        h[r][c] = b[0][r] * db[0][c] + b[1][r] * db[1][c] + b[2][r] * db[2][c];
    }
    for (std::size_t r = 0; r < 2; ++r) {
      for (std::size_t c = 0; c < 2; ++c) {
        const double* k = inverse.data() + 2 * r;
        const double* l = inverse.data() + 2 * c;
        const double s = k[0] * l[0] * point.carried[0] + k[1] * l[1] * point.carried[1] +
                         (k[0] * l[1] + k[1] * l[0]) * point.carried[2];
        h[r][c] += s;
        h[2 + r][2 + c] += s;
      }
    }
    const std::size_t stride = 2 * nodes();
    for (std::size_t a = 0; a < nodes(); ++a) {
      out.forces[2 * a] += dx[a] * force[0] + dy[a] * force[1];
      out.forces[2 * a + 1] += dx[a] * force[2] + dy[a] * force[3];
      double x[4], y[4];
      for (std::size_t c = 0; c < 4; ++c) {
        x[c] = dx[a] * h[0][c] + dy[a] * h[1][c];
        y[c] = dx[a] * h[2][c] + dy[a] * h[3][c];
      }
      double* row_x = out.stiffness.data() + 2 * a * stride;
      double* row_y = row_x + stride;
      if constexpr (Nodes == 0) {
        add_rows(x, y, dx, dy, a + 1, row_x, row_y, nodes());
        continue;
      }
      for (std::size_t c = 0; c <= a; ++c) {
        row_x[2 * c] += x[0] * dx[c] + x[1] * dy[c];
        row_x[2 * c + 1] += x[2] * dx[c] + x[3] * dy[c];
        row_y[2 * c] += y[0] * dx[c] + y[1] * dy[c];
        row_y[2 * c + 1] += y[2] * dx[c] + y[3] * dy[c];
      }
    }
  }

  void add_enhanced(const StrainSlopes& b, const PointEnergy& point,
                    const std::array<std::array<double, enhanced_modes>, 3>& extra,
                    const double* dx, const double* dy, ElementTangent& out) {
    for (std::size_t m = 0; m < enhanced_modes; ++m) {
      double s[3];
      for (std::size_t i = 0; i < 3; ++i)
        s[i] = point.moduli[i][0] * extra[0][m] + point.moduli[i][1] * extra[1][m] +
               point.moduli[i][2] * extra[2][m];
      double t[4];
      for (std::size_t r = 0; r < 4; ++r) t[r] = b[0][r] * s[0] + b[1][r] * s[1] + b[2][r] * s[2];
      for (std::size_t a = 0; a < 4; ++a) {
        coupling_[m][2 * a] += dx[a] * t[0] + dy[a] * t[1];
        coupling_[m][2 * a + 1] += dx[a] * t[2] + dy[a] * t[3];
      }
      for (std::size_t n = 0; n <= m; ++n)
        own_[m][n] += extra[0][n] * s[0] + extra[1][n] * s[1] + extra[2][n] * s[2];
      out.rest[m] += extra[0][m] * point.stress[0] + extra[1][m] * point.stress[1] +
                     extra[2][m] * point.stress[2];
    }
  }

  /// The enhanced strains belong to the element alone.
  void eliminate_enhanced(ElementTangent& out) {
    std::array<std::array<double, 9>, enhanced_modes> solved;  // of coupling, and rest
    for (std::size_t m = 0; m < enhanced_modes; ++m) {
      std::copy(coupling_[m].begin(), coupling_[m].end(), solved[m].begin());
      solved[m][8] = out.rest[m];
    }
    for (std::size_t j = 0; j < enhanced_modes; ++j) {  // L D L^T: the block is positive definite
      const double inverse = 1.0 / own_[j][j];
      for (std::size_t i = j + 1; i < enhanced_modes; ++i) {
        const double l = own_[i][j] * inverse;
        for (std::size_t k = j + 1; k <= i; ++k) own_[i][k] -= l * own_[k][j];
        for (std::size_t c = 0; c < 9; ++c) solved[i][c] -= l * solved[j][c];
      }
    }
    for (std::size_t j = enhanced_modes; j-- > 0;) {
      const double inverse = 1.0 / own_[j][j];
      for (std::size_t i = j + 1; i < enhanced_modes; ++i)
        for (std::size_t c = 0; c < 9; ++c) solved[j][c] -= own_[i][j] * solved[i][c];
      for (std::size_t c = 0; c < 9; ++c) solved[j][c] *= inverse;
    }
    for (std::size_t r = 0; r < 8; ++r) {
      for (std::size_t m = 0; m < enhanced_modes; ++m) {
        out.forces[r] -= coupling_[m][r] * solved[m][8];
        for (std::size_t c = 0; c <= (r | 1U); ++c)
          out.stiffness[8 * r + c] -= coupling_[m][r] * solved[m][c];
      }
    }
    for (std::size_t m = 0; m < enhanced_modes; ++m) {
      std::copy_n(solved[m].begin(), 8, out.follow.begin() + static_cast<std::ptrdiff_t>(8 * m));
      out.rest[m] = solved[m][8];
    }
  }

  const ElementTables& mesh_;
  const Density& density_;
  std::size_t nodes_;
  std::vector<double> row_;
  std::array<std::array<double, 8>, enhanced_modes> coupling_{};
  std::array<std::array<double, enhanced_modes>, enhanced_modes> own_{};
};

}  // namespace flexura

// Manufactured solutions of the plane continuum: the elements' own residual and tangent, loaded by
// the body forces that a chosen displacement field needs, have to give that field back at the
// order that their interpolation allows.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "flexura/core/quadrature.hpp"
#include "flexura/energy/continuum.hpp"
#include "flexura/modelings/continuum_assembly.hpp"
#include "tests/support/measured.hpp"

namespace flexura::testing {
namespace {

/// The chosen field, whose strains are up to 20 %, with its gradient by the place.
struct ChosenField {
  Vec2 displacement;
  std::array<Vec2, 2> gradient;  // d/dX, d/dY
};

ChosenField chosen(Vec2 at) {
  constexpr double size = 0.05, wave = 3.0;
  const double sx = std::sin(wave * at.x + 0.3), cx = std::cos(wave * at.x + 0.3);
  const double sy = std::sin(wave * at.y - 0.4), cy = std::cos(wave * at.y - 0.4);
  return {size * Vec2{sx * cy, cx + sy},
          {size * wave * Vec2{cx * cy, -sx}, size * wave * Vec2{-sx * sy, cy}}};
}

/// First Piola-Kirchhoff stress F S, its columns by X and Y.
template <class Density>
std::array<Vec2, 2> stress_of(const Density& density, const std::array<Vec2, 2>& gradient) {
  const DeformationGradient f{1.0 + gradient[0].x, gradient[1].x, gradient[0].y,
                              1.0 + gradient[1].y};
  const std::array<double, 3> e = f.strain();
  using Jet = Jet2<3>;
  const Jet w = density(Jet::variable(0, e[0]), Jet::variable(1, e[1]), Jet::variable(2, e[2]));
  const double s11 = w.gradient[0], s22 = w.gradient[1], s12 = w.gradient[2];
  return {Vec2{f.f11 * s11 + f.f12 * s12, f.f21 * s11 + f.f22 * s12},
          Vec2{f.f11 * s12 + f.f12 * s22, f.f21 * s12 + f.f22 * s22}};
}

/// A sixth of a thick ring under the chosen field's body forces, held at all of its border.
template <class Density>
class ManufacturedRing {
 public:
  ManufacturedRing(const Density& density, const ContinuumSettings& settings)
      : density_(density),
        enhanced_(settings.order == 1 && settings.enhanced),
        mesh_(make_strip_mesh(
            StripShape(AxisCurve(ArcAxis{{0.0, 0.0}, 2.5, 0.0, std::numbers::pi / 3.0}),
                       Section(RectangleSection{1.0, 1.0})),
            settings, 1e-8)) {
    for (const Vec2 place : mesh_.nodes) places_.push_back(place + chosen(place).displacement);
    unknown_.assign(mesh_.nodes.size(), -1);
    for (std::size_t c = 1; c + 1 < mesh_.columns; ++c)
      for (std::size_t r = 1; r + 1 < mesh_.rows; ++r)
        unknown_[mesh_.node(c, r)] = 2 * free_nodes_++;
  }

  /// Root of the mean square of what the solution misses, at many points of every element.
  double error() {
    solve();
    double square = 0.0, area = 0.0;
    at_points([&](const PointOfElement& point) {
      Vec2 u = -1.0 * point.place;
      for (std::size_t a = 0; a < point.nodes.size(); ++a)
        u = u + point.values[a] * places_[point.nodes[a]];
      const Vec2 off = u - chosen(point.place).displacement;
      square += point.area * dot(off, off);
      area += point.area;
    });
    return std::sqrt(square / area);
  }

 private:
  struct PointOfElement {
    Vec2 place;
    double area = 0.0;
    std::vector<std::size_t> nodes;
    std::vector<double> values;
    std::vector<Vec2> slopes;  // of the shape functions by the place
  };

  /// Of a rule four points finer than what the elements take.
  template <class Use>
  void at_points(const Use& use) const {
    const QuadratureRule& rule = gauss_legendre(static_cast<int>(mesh_.line.order()) + 5);
    for (std::size_t ex = 0; ex < mesh_.along; ++ex)
      for (std::size_t ey = 0; ey < mesh_.across; ++ey)
        for (std::size_t i = 0; i < rule.nodes.size(); ++i)
          for (std::size_t j = 0; j < rule.nodes.size(); ++j)
            use(point_of(ex, ey, rule.nodes[i], rule.nodes[j], rule.weights[i] * rule.weights[j]));
  }

  PointOfElement point_of(std::size_t ex, std::size_t ey, double xi, double eta,
                          double weight) const {
    const auto along = mesh_.line.values(xi), along_slope = mesh_.line.slopes(xi);
    const auto across = mesh_.cross_line.values(eta), across_slope = mesh_.cross_line.slopes(eta);
    PointOfElement point;
    std::vector<Vec2> by_reference;
    Vec2 by_xi, by_eta;
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = 0; j < across.size(); ++j) {
        point.nodes.push_back(mesh_.element_node(ex, ey, point.nodes.size()));
        point.values.push_back(along[i] * across[j]);
        by_reference.push_back({along_slope[i] * across[j], along[i] * across_slope[j]});
        const Vec2 node = mesh_.nodes[point.nodes.back()];
        point.place = point.place + point.values.back() * node;
        by_xi = by_xi + by_reference.back().x * node;
        by_eta = by_eta + by_reference.back().y * node;
      }
    const double jacobian = cross(by_xi, by_eta);
    point.area = weight * jacobian;
    for (const Vec2 d : by_reference)
      point.slopes.push_back((1.0 / jacobian) *
                             Vec2{d.x * by_eta.y - d.y * by_xi.y, d.y * by_xi.x - d.x * by_eta.x});
    return point;
  }

  /// Work of the body forces -Div P on the shape functions, by parts: all of the border is held.
  Eigen::VectorXd body_forces() const {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(2 * free_nodes_);
    at_points([&](const PointOfElement& point) {
      const auto stress = stress_of(density_, chosen(point.place).gradient);
      for (std::size_t a = 0; a < point.nodes.size(); ++a) {
        const Eigen::Index i = unknown_[point.nodes[a]];
        if (i < 0) continue;
        const Vec2 f = point.area * (point.slopes[a].x * stress[0] + point.slopes[a].y * stress[1]);
        forces[i] += f.x;
        forces[i + 1] += f.y;
      }
    });
    return forces;
  }

  void add_element(std::size_t ex, std::size_t ey, ElementAssembly<0, Density>& element,
                   std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& residual) const {
    const std::size_t per = mesh_.nodes_per_element();
    std::vector<Vec2> here(per);
    std::vector<Eigen::Index> at(2 * per);
    for (std::size_t a = 0; a < per; ++a) {
      const std::size_t node = mesh_.element_node(ex, ey, a);
      here[a] = places_[node];
      at[2 * a] = unknown_[node];
      at[2 * a + 1] = unknown_[node] < 0 ? -1 : unknown_[node] + 1;
    }
    const EnhancedStrains modes(mesh_, ex, ey);
    ElementTangent tangent;
    element.settle(mesh_.element(ex, ey), here.data(), enhanced_ ? &modes : nullptr, tangent);
    for (std::size_t r = 0; r < 2 * per; ++r) {
      if (at[r] < 0) continue;
      residual[at[r]] += tangent.forces[r];
      for (std::size_t c = 0; c <= r; ++c)
        if (at[c] >= 0)
          entries.emplace_back(std::max(at[r], at[c]), std::min(at[r], at[c]),
                               tangent.stiffness[2 * per * r + c]);
    }
  }

  void solve() {
    const Eigen::VectorXd load = body_forces();
    ElementAssembly<0, Density> element(mesh_, density_);
    double step = 1.0;
    for (int k = 0; k < 20 && step > 1e-14; ++k) {
      Eigen::VectorXd residual = -load;
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t ex = 0; ex < mesh_.along; ++ex)
        for (std::size_t ey = 0; ey < mesh_.across; ++ey)
          add_element(ex, ey, element, entries, residual);
      Eigen::SparseMatrix<double> tangent(load.size(), load.size());
      tangent.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(tangent);
      ASSERT_EQ(factor.info(), Eigen::Success);
      const Eigen::VectorXd change = factor.solve(-residual);
      for (std::size_t n = 0; n < places_.size(); ++n)
        if (unknown_[n] >= 0)
          places_[n] = places_[n] + Vec2{change[unknown_[n]], change[unknown_[n] + 1]};
      const double now = change.norm() / std::sqrt(static_cast<double>(change.size()));
      if (k > 2 && now > 0.5 * step) return;  // rounding
      step = now;
    }
  }

  Density density_;
  bool enhanced_;
  StripMesh mesh_;
  std::vector<Vec2> places_;
  std::vector<Eigen::Index> unknown_;  // first of a node's two; -1: held
  Eigen::Index free_nodes_ = 0;
};

template <class Density>
double error(const Density& density, int order, int fineness, bool enhanced = true) {
  ContinuumSettings settings;
  settings.order = order;
  settings.elements = 2 * fineness;
  settings.across = fineness;
  settings.enhanced = enhanced;
  return ManufacturedRing<Density>(density, settings).error();
}

/// Displacements converge by one more than the order of the elements (Ciarlet and Raviart's
/// estimate with Nitsche's trick); the least of both meshes' errors stays far above rounding.
template <class Density>
void expect_theoretical_orders(const Density& density, const std::string& name) {
  for (int order = 1; order <= 8; ++order) {
    const int coarse = order < 3 ? 8 : order < 7 ? 4 : 3;
    const double fine = error(density, order, 2 * coarse);
    const double observed = std::log2(error(density, order, coarse) / fine);
    note_measured(name + "_order_" + std::to_string(order), observed);
    note_measured(name + "_error_" + std::to_string(order), fine);
    EXPECT_GT(fine, 1e-13) << "rounding";
    EXPECT_NEAR(observed, order + 1.0, 0.15) << name << ", elements of order " << order;
  }
}

TEST(ContinuumManufactured, StVenantKirchhoffHasTheTheoreticalOrders) {
  expect_theoretical_orders(StVenantKirchhoff(lame_constants(2100.0, 0.35), PlaneKind::stress),
                            "stress");
}

TEST(ContinuumManufactured, NeoHookeanHasTheTheoreticalOrders) {
  expect_theoretical_orders(NeoHookean(lame_constants(2100.0, 0.35), PlaneKind::stress), "stress");
  expect_theoretical_orders(NeoHookean(lame_constants(2100.0, 0.35), PlaneKind::strain), "strain");
}

/// Four-node elements without enhanced strains are of the same order, with a larger error.
TEST(ContinuumManufactured, PlainFourNodeElementsAreOfSecondOrder) {
  const StVenantKirchhoff density(lame_constants(2100.0, 0.35), PlaneKind::stress);
  const double observed = std::log2(error(density, 1, 8, false) / error(density, 1, 16, false));
  note_measured("order", observed);
  EXPECT_NEAR(observed, 2.0, 0.1);
}

}  // namespace
}  // namespace flexura::testing

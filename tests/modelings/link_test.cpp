// Links of any shape: their elements, and the two-port that they make.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "flexura/modelings/continuum.hpp"
#include "flexura/modelings/continuum_assembly.hpp"
#include "flexura/modelings/continuum_link.hpp"
#include "flexura/modelings/continuum_link_mesh.hpp"
#include "flexura/modelings/link_compliance.hpp"
#include "tests/support/plane_mesh.hpp"

namespace flexura::testing {
namespace {

constexpr ElementKind all_kinds[] = {ElementKind::triangle3, ElementKind::triangle6,
                                     ElementKind::quad4, ElementKind::quad8, ElementKind::quad9};

Material material(double youngs_modulus, double poissons_ratio) {
  Material made;
  made.youngs_modulus = youngs_modulus;
  made.poissons_ratio = poissons_ratio;
  return made;
}

struct Held {
  TipResponse response;
  std::vector<double> internal;
  int iterations = 0;
};

/// A port held at its base, solved for a load on its tip that grows in `steps`.
Held solve(const TwoPort& port, const Eigen::Vector3d& load, int steps = 1) {
  Held held;
  held.internal.assign(port.internal_size(), 0.0);
  std::vector<double> scratch(port.scratch_size());
  std::vector<double> step(port.internal_size());
  for (int s = 1; s <= steps; ++s) {
    const Eigen::Vector3d share = load * s / steps;
    double before = INFINITY;
    for (held.iterations = 0; held.iterations < 40; ++held.iterations) {
      held.response = port.linearize(share, held.internal.data(), scratch.data());
      EXPECT_FALSE(held.response.singular);
      port.advance(scratch.data(), 1.0, Eigen::Vector3d::Zero(), step.data());
      double size = 0.0;
      for (std::size_t i = 0; i < step.size(); ++i) {
        held.internal[i] += step[i];
        size = std::max(size, std::abs(step[i]));
      }
      if (size < 1e-13 || (size < 1e-9 && size > 0.1 * before)) break;
      before = size;
    }
  }
  held.response = port.linearize(load, held.internal.data(), scratch.data());
  return held;
}

Held solve(const MeshLink& link, const Material& of, const Eigen::Vector3d& load,
           const ContinuumSettings& settings = {}) {
  return solve(*make_link_port(link, of, settings), load);
}

/// A bar whose inner nodes lie anyhow.
MeshLink distorted_bar(ElementKind kind) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.06, 0.06);
  return mapped_link(kind, 4, 3, [&](Vec2 p) {
    Vec2 place{4.0 * p.x, 2.0 * (p.y - 0.5)};
    if (p.x == 0.0 || p.x == 1.0) return place;
    place.x += shift(random);
    if (p.y > 0.0 && p.y < 1.0) place.y += shift(random);
    return place;
  });
}

class LinkElement : public ::testing::TestWithParam<ElementKind> {};

/// Constant stress stays constant on any mesh: a bar without lateral contraction, pulled to half
/// its length more, E/2 (s^2 - 1) s A = F.
TEST_P(LinkElement, PassesThePatchTest) {
  const double stretch = 1.5;
  const double area = 2.0;
  const double force = 100.0 * 0.5 * (stretch * stretch - 1.0) * stretch * area;
  const Held held = solve(distorted_bar(GetParam()), material(100.0, 0.0), {force, 0.0, 0.0});
  EXPECT_NEAR(held.response.tip[0], 4.0 * stretch, 1e-12);
  EXPECT_NEAR(held.response.tip[1], 0.0, 1e-12);
  EXPECT_NEAR(held.response.tip[2], 0.0, 1e-12);
  const double energy = 100.0 * 0.5 * std::pow(0.5 * (stretch * stretch - 1.0), 2) * area * 4.0;
  EXPECT_NEAR(held.response.strain_energy, energy, 1e-11 * energy);
}

/// Turned and shifted as a whole, elements store no energy and exert no forces.
TEST_P(LinkElement, IsFreeToTurn) {
  const LinkMesh mesh(distorted_bar(GetParam()));
  const NeoHookean density(lame_constants(100.0, 0.3), PlaneKind::stress);
  for (const LinkBlock& block : mesh.blocks) {
    ElementAssembly<0, NeoHookean> assembly(block.tables, density);
    ElementTangent tangent;
    const std::size_t per = block.tables.nodes_per_element();
    for (std::size_t e = 0; e < block.elements(); ++e) {
      std::vector<Vec2> places;
      for (std::size_t a = 0; a < per; ++a)
        places.push_back(Vec2{3.0, -5.0} + rotate(2.6, mesh.nodes[block.nodes[e * per + a]]));
      assembly.assemble(e, {places.data(), nullptr, nullptr}, nullptr, tangent, nullptr);
      EXPECT_NEAR(tangent.energy, 0.0, 1e-13);
      for (const double force : tangent.forces) EXPECT_NEAR(force, 0.0, 1e-12);
    }
  }
}

/// The flexibility is the slope of the tip by the load, at a large displacement.
TEST_P(LinkElement, KnowsItsFlexibility) {
  const auto port = make_link_port(bar_link(GetParam(), 6, 2, 6.0, 1.0), material(100.0, 0.3), {});
  const Eigen::Vector3d load(0.02, 0.1, 0.3);
  const Held held = solve(*port, load);
  EXPECT_GT(held.response.tip[2], 0.1);
  const double h = 1e-5;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d change = h * Eigen::Vector3d::Unit(c);
    const Eigen::Vector3d slope =
        (solve(*port, load + change).response.tip - solve(*port, load - change).response.tip) /
        (2.0 * h);
    EXPECT_LT((slope - held.response.flexibility.col(c)).norm(),
              1e-6 * held.response.flexibility.norm());
  }
  EXPECT_EQ(held.response.negative, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, LinkElement, ::testing::ValuesIn(all_kinds), [](const auto& kind) {
  return "nodes_" + std::to_string(nodes_of(kind.param));
});

/// The same strip by the modeling of strips, of high order.
Held solve_strip(double length, double height, const Material& of, const Eigen::Vector3d& load) {
  const StripShape shape(AxisCurve(LineAxis{{0.0, 0.0}, {length, 0.0}}),
                         RectangleSection{height, 1.0});
  ContinuumSettings settings;
  settings.elements = 24;
  settings.order = 8;
  settings.order_across = 8;
  return solve(*make_continuum_port(shape, of, settings, 1e-8), load, 20);
}

class LinkOrder : public ::testing::TestWithParam<ElementKind> {};

/// Without lateral contraction there is nothing singular at the ends: quadratic elements converge
/// with the fourth power of their size, linear ones with the second.
TEST_P(LinkOrder, ConvergesToTheStrip) {
  const Material of = material(1000.0, 0.0);
  const Eigen::Vector3d load(0.2, 0.5, 2.0);
  const Eigen::Vector3d right = solve_strip(10.0, 1.0, of, load).response.tip;
  EXPECT_GT(right[2], 0.4);
  std::vector<double> errors;
  for (const int n : {10, 20, 40})
    errors.push_back(
        (solve(bar_link(GetParam(), n, n / 5, 10.0, 1.0), of, load).response.tip - right).norm() /
        10.0);
  const bool linear = nodes_of(GetParam()) <= 4;
  RecordProperty("error", std::to_string(errors.back()));
  EXPECT_GT(std::log2(errors[1] / errors[2]), linear ? 1.6 : 3.1) << errors[1] << " " << errors[2];
  EXPECT_LT(errors[2], GetParam() == ElementKind::triangle3 ? 0.05 : linear ? 2e-3 : 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, LinkOrder, ::testing::ValuesIn(all_kinds), [](const auto& kind) {
  return "nodes_" + std::to_string(nodes_of(kind.param));
});

/// Ends held from contracting: the corners there are singular, and what remains is small.
TEST(Link, EqualsTheStrip) {
  const Material of = material(1000.0, 0.3);
  const Eigen::Vector3d load(0.2, 0.5, 2.0);
  const Eigen::Vector3d right = solve_strip(10.0, 1.0, of, load).response.tip;
  for (const ElementKind kind : {ElementKind::triangle6, ElementKind::quad9, ElementKind::quad8}) {
    const Eigen::Vector3d tip = solve(bar_link(kind, 80, 8, 10.0, 1.0), of, load).response.tip;
    EXPECT_LT((tip - right).norm() / 10.0, 5e-5) << name_of(kind);
  }
}

/// However fine the mesh about the attachments is, a large turn of the tip is found in few steps: a
/// node that turned at once would strain its elements by the square of the turn.
TEST(Link, NeedsFewIterationsOnFineMeshes) {
  const Material of = material(1000.0, 0.3);
  const Held coarse = solve(bar_link(ElementKind::quad9, 20, 2, 10.0, 1.0), of, {0.2, 0.5, 2.0});
  const Held fine = solve(bar_link(ElementKind::quad9, 150, 12, 10.0, 1.0), of, {0.2, 0.5, 2.0});
  EXPECT_GT(fine.response.tip[2], 0.4);
  EXPECT_LE(fine.iterations, 8);
  EXPECT_LE(fine.iterations, coarse.iterations + 1);
}

/// The compliance matrix of the modelings linear and scmbm is the flexibility at rest.
TEST(Link, BendsAsABeamWhereItIsSlender) {
  const double l = 50.0, e = 1000.0;
  const Eigen::Matrix3d c =
      link_compliance(bar_link(ElementKind::quad9, 100, 2, l, 1.0), material(e, 0.0));
  const double bending = e / 12.0;
  EXPECT_NEAR(c(0, 0), l / e, 1e-6 * c(0, 0));
  EXPECT_NEAR(c(2, 2), l / bending, 1e-6 * c(2, 2));
  EXPECT_NEAR(c(1, 2), l * l / (2.0 * bending), 1e-5 * c(1, 2));
  EXPECT_NEAR(c(1, 1), l * l * l / (3.0 * bending) + l * 1.2 * 2.0 / e, 1e-5 * c(1, 1));
}

/// Displacement of the middle of the right edge of Cook's tapered panel (48 long, 44 and 16 high, E
/// = 1, a third of lateral contraction), clamped at its left edge, under a unit shear force spread
/// over its right edge, which is free: 23.96.
double cook_panel(ElementKind kind, int n) {
  MeshLink link = mapped_link(kind, n, n, [](Vec2 p) {
    return Vec2{48.0 * p.x, 44.0 * p.x + (44.0 - 28.0 * p.x) * p.y};
  });
  const std::vector<std::size_t> edge = std::move(link.action);
  // the action end is that of an element of its own, apart
  const std::size_t apart = link.mesh.nodes.size();
  for (const Vec2 place : {Vec2{100.0, 0.0}, Vec2{101.0, 0.0}, Vec2{100.0, 1.0}})
    link.mesh.nodes.push_back(place);
  link.mesh.add(ElementKind::triangle3, {apart, apart + 1, apart + 2}, 0);
  link.action = {apart, apart + 1, apart + 2};
  const LinkMesh mesh(link);
  const StVenantKirchhoff density(lame_constants(1.0, 1.0 / 3.0), PlaneKind::stress);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(mesh.size()),
                                                        static_cast<Eigen::Index>(mesh.size()));
  stiffness
      .topLeftCorner(static_cast<Eigen::Index>(mesh.pose), static_cast<Eigen::Index>(mesh.pose))
      .setZero();
  for (const LinkBlock& block : mesh.blocks) {
    if (nodes_of(block.kind) == 3 && kind != ElementKind::triangle3) continue;
    ElementAssembly<0, StVenantKirchhoff> assembly(block.tables, density);
    ElementTangent tangent;
    const std::size_t per = block.tables.nodes_per_element();
    for (std::size_t e = 0; e < block.elements(); ++e) {
      const std::size_t* nodes = block.nodes.data() + e * per;
      std::vector<Vec2> places;
      for (std::size_t a = 0; a < per; ++a) places.push_back(mesh.nodes[nodes[a]]);
      const std::array<double, enhanced_modes> none{};
      if (kind == ElementKind::quad4) {
        const EnhancedStrains modes({places[0], places[1], places[2], places[3]});
        assembly.assemble(e, {places.data(), nullptr, none.data()}, &modes, tangent, nullptr);
      } else {
        assembly.assemble(e, {places.data(), nullptr, nullptr}, nullptr, tangent, nullptr);
      }
      for (std::size_t i = 0; i < 2 * per; ++i)
        for (std::size_t j = 0; j < 2 * per; ++j) {
          const std::size_t row = mesh.unknown[nodes[i / 2]], column = mesh.unknown[nodes[j / 2]];
          if (row >= LinkMesh::at_action || column >= LinkMesh::at_action) continue;
          stiffness(static_cast<Eigen::Index>(row + i % 2),
                    static_cast<Eigen::Index>(column + j % 2)) +=
              tangent.stiffness[std::max(i, j) * 2 * per + std::min(i, j)];
        }
    }
  }
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.size()));
  Eigen::Index middle_row = 0;
  for (const std::size_t node : edge) {
    const double height = link.mesh.nodes[node].y;
    const auto row = static_cast<Eigen::Index>(mesh.unknown[node] + 1);
    const double k = (height - 44.0) / 16.0 * n;  // in elements from the lower corner
    const bool middle = std::abs(k - std::round(k)) > 0.1;
    const bool end = k < 0.1 || k > n - 0.1;
    const double share = nodes_of(kind) <= 4 ? 1.0 : middle ? 2.0 / 3.0 : 1.0 / 3.0;
    force[row] = share * (end ? 0.5 : 1.0) / n;
    if (std::abs(height - 52.0) < 1e-9) middle_row = row;
  }
  EXPECT_NEAR(force.sum(), 1.0, 1e-12);
  return stiffness.ldlt().solve(force)[middle_row];
}

TEST(CooksMembrane, MovesAsPublished) {
  EXPECT_NEAR(cook_panel(ElementKind::quad9, 8), 23.96, 0.04);
  EXPECT_NEAR(cook_panel(ElementKind::quad8, 16), 23.96, 0.05);
  EXPECT_NEAR(cook_panel(ElementKind::triangle6, 16), 23.96, 0.05);
  EXPECT_NEAR(cook_panel(ElementKind::quad4, 16), 23.9, 0.1);
  EXPECT_LT(cook_panel(ElementKind::triangle3, 16), 23.5);  // they lock
}

}  // namespace
}  // namespace flexura::testing

// Continua against exact solutions of elasticity and against beams where these are exact in the
// limit. Tolerances are those of the discretization named beside each.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

constexpr double modulus = 2100.0;
constexpr double poisson = 0.35;

Mechanism strip(const AxisShape& axis, double thickness, double width = 1.0) {
  Mechanism mechanism;
  mechanism.material(modulus, poisson).section(RectangleSection{thickness, width});
  mechanism.fixed("ground").body("tip");
  mechanism.flexure("ground", "tip", axis);
  return mechanism;
}

ContinuumSettings mesh(int elements, int across, int order, bool contracting) {
  ContinuumSettings settings;
  settings.elements = elements;
  settings.across = across;
  settings.order = order;
  settings.contracting = contracting;
  return settings;
}

/// The further a strip is from a beam, the more they differ: by (h/L)^2 where its faces may
/// contract, as beam theory has it.
TEST(ContinuumStrip, TendsToTheBeamAsItGetsSlender) {
  double before = 0.0;
  double error = 0.0;
  for (const double thickness : {0.1, 0.02, 0.004, 0.001}) {
    const Mechanism leaf = strip(LineAxis{{0.0, 0.0}, {1.0, 0.0}}, thickness);
    const double bending = modulus * std::pow(thickness, 3) / 12.0;
    const auto loads = {leaf.load("tip", {-0.3 * bending, 1.2 * bending}, 0.4 * bending)};
    const Pose beam = final_pose(leaf, loads, exact(1e-11), 1, 4);
    const Pose whole = final_pose(leaf, loads, continuum(mesh(12, 1, 6, true)), 1, 4);
    const double moved = norm(beam.position - Vec2{1.0, 0.0});
    error = norm(whole.position - beam.position) / moved;
    if (before > 0.0) {
      EXPECT_LT(error, 0.5 * before) << "thickness " << thickness;
    }
    before = error;
  }
  note_measured("difference_at_1_to_1000", error);
  EXPECT_LT(error, 1e-6);
}

/// Golovin's curved bar: a moment bends a quarter ring of radii a and b by 8 M (b^2 - a^2)/(E w N)
/// radians a radian, N = (b^2 - a^2)^2 - 4 a^2 b^2 ln^2(b/a); sections stay plane (Timoshenko and
/// Goodier, Theory of Elasticity, art. 29).
double golovin_turn(double a, double b, double moment) {
  const double squares = b * b - a * a;
  const double n = squares * squares - 4.0 * a * a * b * b * std::pow(std::log(b / a), 2);
  return 8.0 * moment * squares / (modulus * n) * 0.5 * std::numbers::pi;
}

constexpr double ring_moment = 1e-5;  // small displacements: the rest is relative to the turn, 1e-8

double ring_turn(const ContinuumSettings& settings, double moment = ring_moment) {
  const ArcAxis quarter{{0.0, 0.0}, 3.0, 0.0, 0.5 * std::numbers::pi};
  const Mechanism ring = strip(quarter, 2.0);
  return final_pose(ring, {ring.load("tip", {}, moment)}, continuum(settings), 1, 1).rotation;
}

TEST(ContinuumRing, ThickCurvedBarIsGolovins) {
  const double truth = golovin_turn(2.0, 4.0, ring_moment);
  const double error = std::abs(ring_turn(mesh(8, 2, 8, true)) - truth) / truth;
  note_measured("order_8", error);
  EXPECT_LT(error, 1e-7);
}

/// Energies converge by twice the order of the elements, on geometry interpolated likewise.
TEST(ContinuumRing, ConvergesByTwiceTheOrder) {
  const struct { int order, coarse; } cases[] = {{1, 8}, {2, 4}, {3, 4}};
  constexpr double moment = 10.0;  // far above rounding
  const double truth = ring_turn(mesh(8, 2, 8, true), moment);
  const auto error = [&](int fineness, int order) {
    return std::abs(ring_turn(mesh(2 * fineness, fineness, order, true), moment) - truth);
  };
  for (const auto& [order, coarse] : cases) {
    const double observed = std::log2(error(coarse, order) / error(2 * coarse, order));
    note_measured("order_" + std::to_string(order), observed);
    EXPECT_NEAR(observed, 2.0 * order, 0.25) << "order " << order;
  }
}

/// Right circular hinges: a fit to finite elements, turn per moment 24 K R/(E b t^3) with
/// K = 0.565 t/R + 0.166 (Smith, Foundations of Ultraprecision Mechanism Design, 1992), which is
/// good to a per cent or two between t/R = 0.2 and 0.6. Beams are stiffer: stress cannot follow the
/// section.
TEST(ContinuumNotch, IsAsSoftAsAFitToFiniteElementsSays) {
  constexpr double radius = 4.0, width = 10.0;
  for (const double thickness : {1.0, 2.0}) {
    RectangleSection section{thickness, width};
    section.profile = NotchProfile{radius, radius, true};
    Mechanism hinge;
    hinge.material(210e3, 0.3).section(section).fixed("ground").body("tip");
    hinge.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {2.0 * radius, 0.0}});
    const double fit = 24.0 * (0.565 * thickness / radius + 0.166) * radius /
                       (210e3 * width * thickness * thickness * thickness);
    ContinuumSettings free_faces;
    free_faces.contracting = true;
    const ModelingSettings whole = continuum(free_faces, 1e-8);
    const auto turn = [&](const ModelingSettings& settings) {
      return final_pose(hinge, {hinge.load("tip", {}, 1.0)}, settings, 1).rotation / fit;
    };
    note_measured("continuum_" + std::to_string(thickness), turn(whole) - 1.0);
    note_measured("beam_" + std::to_string(thickness), turn(exact(1e-10)) - 1.0);
    EXPECT_NEAR(turn(whole), 1.0, 0.02);
    EXPECT_LT(turn(exact(1e-10)), 0.94);
  }
}

/// Plane strain of (E, nu) is plane stress of (E/(1 - nu^2), nu/(1 - nu)).
TEST(ContinuumStrip, PlaneStrainIsPlaneStressOfAnotherMaterial) {
  const ArcAxis arc{{0.0, 1.0}, 1.0, -1.5, 2.0};
  ContinuumSettings settings = mesh(6, 1, 4, false);
  settings.plane = PlaneKind::strain;
  const Mechanism walled = strip(arc, 0.1);
  const auto load = [](const Mechanism& m) { return m.load("tip", {0.05, 0.03}, 0.02); };
  const Pose a = final_pose(walled, {load(walled)}, continuum(settings), 1, 4);
  settings.plane = PlaneKind::stress;
  Mechanism plate;
  plate.material(modulus / (1.0 - poisson * poisson), poisson / (1.0 - poisson));
  plate.section(RectangleSection{0.1, 1.0}).fixed("ground").body("tip");
  plate.flexure("ground", "tip", arc);
  const Pose b = final_pose(plate, {load(plate)}, continuum(settings), 1, 4);
  EXPECT_LT(norm(a.position - b.position), 1e-10);
  EXPECT_NEAR(a.rotation, b.rotation, 1e-10);
}

/// A neo-Hookean strip pulled to stretch s: with c the square of both stretches across,
/// mu (c - 1) + lambda/2 ln(s^2 c^2) = 0 and P = mu (s - 1/s) + lambda ln(s c)/s.
TEST(ContinuumStrip, NeoHookeanIsStretchedAsInClosedForm) {
  ContinuumSettings settings = mesh(4, 1, 2, true);
  settings.law = ContinuumSettings::Law::neo_hookean;
  const Mechanism bar = strip(LineAxis{{0.0, 0.0}, {2.0, 0.0}}, 0.5);
  const LameConstants lame = lame_constants(modulus, poisson);
  constexpr double stretch = 1.6;
  double c = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double rest = lame.mu * (c - 1.0) + lame.lambda * std::log(stretch * c);
    c -= rest / (lame.mu + lame.lambda / c);
  }
  const double stress =
      lame.mu * (stretch - 1.0 / stretch) + lame.lambda * std::log(stretch * c) / stretch;
  const Pose tip =
      final_pose(bar, {bar.load("tip", {0.5 * stress, 0.0})}, continuum(settings), 1, 10);
  EXPECT_NEAR(tip.position.x, 2.0 * stretch, 1e-9);
}

/// Elements of any order tend to one solution on the arc chain, off the beam's by the few 1e-5 of
/// a curved strip with rigid faces; plain four-node elements lock.
TEST(ContinuumChain, MeshesAgreeAndBeamsAreNear) {
  const Mechanism chain = arc_chain();
  const std::vector<Load> loads{chain.load("link4.E", {1e-3, 0.0})};
  const auto place = [&](const ModelingSettings& settings) {
    const TracedPath path = trace(chain, loads, settings, 5, false);
    EXPECT_TRUE(path.termination.converged()) << path.termination.reason;
    return point_in(path, 5, 3, {19.093, 15.750});
  };
  const auto by_tolerance = [](double tolerance) {
    ModelingSettings settings = continuum(ContinuumSettings{});
    settings.tolerance = tolerance;
    return settings;
  };
  const Vec2 truth = place(by_tolerance(1e-8));
  const double moved = norm(truth - Vec2{19.093, 15.750});
  const auto error = [&](const ModelingSettings& settings) {
    return norm(place(settings) - truth) / moved;
  };
  ContinuumSettings even = mesh(60, 1, 8, false);
  even.order_across = 6;
  ContinuumSettings plain = mesh(600, 6, 1, false);
  const double enhanced_error = error(continuum(plain));
  plain.enhanced = false;
  const double plain_error = error(continuum(plain));
  note_measured("even_mesh", error(continuum(even)));
  note_measured("tolerance_1e-4", error(by_tolerance(1e-4)));
  note_measured("four_node", enhanced_error);
  note_measured("four_node_plain", plain_error);
  note_measured("beam", error(exact(1e-10)));
  EXPECT_LT(error(continuum(even)), 1e-6);
  EXPECT_LT(error(by_tolerance(1e-4)), 2e-5);
  EXPECT_LT(enhanced_error, 5e-5);
  EXPECT_GT(plain_error, 50.0 * enhanced_error);
  EXPECT_LT(error(exact(1e-10)), 2e-4);
}

}  // namespace
}  // namespace flexura::testing

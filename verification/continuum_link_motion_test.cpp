// Links of any shape in motion: frequencies against closed forms and strips, momenta and energy of
// a plate that flies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/frequencies.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/plane_mesh.hpp"

namespace flexura::testing {
namespace {

constexpr double modulus = 1000.0;
constexpr double length = 10.0;

Mechanism of_material(double poissons_ratio) {
  Mechanism beam;
  beam.material(modulus, poissons_ratio).section(RectangleSection{1.0, 1.0});
  beam.fixed("ground").body("tip");
  return beam;
}

Mechanism meshed_bar(ElementKind kind, int nx, int ny, double height, double poissons_ratio) {
  Mechanism beam = of_material(poissons_ratio);
  beam.link("ground", "tip", bar_link(kind, nx, ny, length, height)).density(2.0);
  return beam;
}

Mechanism strip(double height, double poissons_ratio) {
  Mechanism beam = of_material(poissons_ratio);
  beam.section(RectangleSection{height, 1.0});
  beam.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}}).density(2.0);
  return beam;
}

class LinkFrequencies : public ::testing::TestWithParam<ElementKind> {};

/// Six modes of a bar ten times as long as high, one of them along it, as strips of high order have
/// them. Errors of frequencies fall with the square of the element size, and of quadratic elements
/// with its fourth power: nothing is singular without lateral contraction.
TEST_P(LinkFrequencies, TendToThoseOfTheStrip) {
  const auto truth = frequencies(strip(1.0, 0.0), continuum(12, 1, 6), 6);
  const auto error = [&](int nx, int ny) {
    return largest_difference(
        frequencies(meshed_bar(GetParam(), nx, ny, 1.0, 0.0), continuum(12, 1, 6), 6), truth);
  };
  const double coarse = error(40, 4), fine = error(80, 8);
  note_measured("coarse", coarse);
  note_measured("fine", fine);
  const bool linear = nodes_of(GetParam()) <= 4;
  EXPECT_GT(std::log2(coarse / fine), linear ? 1.6 : 3.2);
  EXPECT_LT(fine, GetParam() == ElementKind::triangle3 ? 0.2 : linear ? 2e-2 : 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Continuum, LinkFrequencies,
                         ::testing::Values(ElementKind::triangle3, ElementKind::triangle6,
                                           ElementKind::quad4, ElementKind::quad8,
                                           ElementKind::quad9),
                         [](const auto& kind) {
                           return "nodes_" + std::to_string(nodes_of(kind.param));
                         });

/// With a lateral contraction the corners of the ends are singular.
TEST(ContinuumLinkMotion, FrequenciesAreThoseOfTheStripWithLateralContraction) {
  const auto truth = frequencies(strip(1.0, 0.3), continuum(16, 2, 8), 6);
  const auto found =
      frequencies(meshed_bar(ElementKind::quad8, 60, 6, 1.0, 0.3), continuum(12, 1, 6), 6);
  const double off = largest_difference(found, truth);
  note_measured("difference", off);
  EXPECT_LT(off, 4e-4);
}

/// A slender bar is a beam.
TEST(ContinuumLinkMotion, FrequenciesOfASlenderBarAreThoseOfABeam) {
  const auto truth = frequencies(strip(0.2, 0.0), exact(), 6);
  const auto found =
      frequencies(meshed_bar(ElementKind::quad8, 80, 2, 0.2, 0.0), continuum(12, 1, 6), 6);
  const double off = largest_difference(found, truth);
  note_measured("difference", off);
  EXPECT_LT(off, 3e-4);
}

/// A plate with a hole, free in the plane, that turns half a turn while it bends.
Mechanism flying_plate() {
  Mechanism plate;
  plate.material(2000.0, 0.3).section(RectangleSection{1.0, 1.0});
  plate.body("lower").free().body("upper").mass(1.0, 0.5);
  MeshLink link = mapped_link(ElementKind::quad8, 8, 2, [](Vec2 p) {
    return Vec2{10.0 * p.x, (p.y - 0.5) * (1.0 + p.x)};
  });
  plate.link("lower", "upper", std::move(link)).density(0.1);
  return plate;
}

TEST(ContinuumLinkMotion, FlyingKeepsMomentaAndEnergy) {
  constexpr double let_go = 2.0;
  const Mechanism plate = flying_plate();
  TransientStudy study =
      in_steps(transient(8.0, 80, 1e-6), TransientStudy::Method::energy_momentum, 0.1);
  study.loads = {plate.load("lower", {0.3, 0.0}, 2.0), plate.load("lower", {-0.3, 0.0}, -2.0)};
  study.loads[1].history = StepHistory{let_go};
  const ModelingMotion motion = move(plate, study, continuum(8, 1, 4));
  ASSERT_EQ(motion.states.size(), 81u);
  const EnergyBalance& free = motion.states[20].energy;
  double linear = 0.0, angular = 0.0, energy = 0.0;
  for (std::size_t k = 21; k < motion.states.size(); ++k) {
    const EnergyBalance& now = motion.states[k].energy;
    linear = std::max(linear, norm(now.momentum - Vec2{0.3 * let_go, 0.0}));
    angular = std::max(angular, std::abs(now.angular_momentum - free.angular_momentum));
    energy = std::max(energy, std::abs(now.kinetic + now.strain - free.kinetic - free.strain));
  }
  note_measured("linear", linear / (0.3 * let_go));
  note_measured("angular", angular / std::abs(free.angular_momentum));
  note_measured("energy", energy / (free.kinetic + free.strain));
  note_measured("turn", pose_at(plate, motion.states.back(), "upper").rotation);
  EXPECT_GT(std::abs(pose_at(plate, motion.states.back(), "upper").rotation), 1.0);
  EXPECT_GT(free.strain, 1e-3 * free.kinetic);
  EXPECT_LT(linear, 1e-9 * 0.3 * let_go);
  EXPECT_LT(angular, 1e-9 * std::abs(free.angular_momentum));
  EXPECT_LT(energy, 1e-8 * (free.kinetic + free.strain));
}

/// A large swing under its weight by Radau's method: mesh and strip go the same way.
TEST(ContinuumLinkMotion, SwingsAsTheStrip) {
  TransientStudy study = transient(6.0, 24, 1e-7);
  study.fields.gravity = {0.0, -0.3};
  const Mechanism link = meshed_bar(ElementKind::quad8, 20, 2, 1.0, 0.0);
  const Mechanism truth = strip(1.0, 0.0);
  const ModelingMotion a = move(link, study, continuum(8, 1, 4));
  const ModelingMotion b = move(truth, study, continuum(8, 1, 4));
  double apart = 0.0, swing = 0.0;
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    const Pose p = pose_at(link, a.states[k], "tip"), q = pose_at(truth, b.states[k], "tip");
    apart = std::max(apart, norm(p.position - q.position));
    swing = std::max(swing, std::abs(q.rotation));
  }
  note_measured("apart", apart / length);
  note_measured("swing", swing);
  EXPECT_GT(swing, 0.3);
  EXPECT_LT(apart, 1e-4 * length);
}

}  // namespace
}  // namespace flexura::testing

// Joints at rest: equilibria of mechanisms with pins and slides along a path.
#include <cmath>
#include <numbers>

#include "flexura/studies/path_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

const auto go_on = [](double) { return true; };

ModelingPath path_of(const Model& model, const PathStudy& study, const ModelingSettings& settings) {
  ModelingPath path = run_path(model, study, settings, go_on);
  EXPECT_TRUE(path.termination.converged()) << settings.label << ": " << path.termination.reason;
  return path;
}

Mechanism leaf() { return single_flexure(LineAxis{{0.0, 0.0}, {10.0, 0.0}}); }

class JointPath : public ::testing::TestWithParam<ModelingSettings> {};

/// A slide across the leaf holds what may be prescribed to stay: place along the leaf, and
/// rotation.
TEST_P(JointPath, ASlideGuides) {
  Mechanism free = leaf();
  Mechanism guided = leaf();
  guided.slide("ground", "stage", {0.0, 1.0});
  PathStudy study;
  study.steps = 4;
  study.loads = {free.load("stage", {0.0, 0.02})};
  const ModelingPath slid = path_of(guided, study, GetParam());
  study.prescribe = {{free.index("stage"), {}, 0.0, {}, 0.0}};
  const ModelingPath held = path_of(free, study, GetParam());
  ASSERT_EQ(slid.states.size(), held.states.size());
  for (std::size_t k = 0; k < held.states.size(); ++k) {
    EXPECT_LT(distance(slid.states[k].bodies[0], held.states[k].bodies[0], 10.0), 1e-11) << k;
    EXPECT_NEAR(slid.states[k].strain_energy, held.states[k].strain_energy,
                1e-9 * held.states.back().strain_energy);
    EXPECT_EQ(slid.states[k].unstable_directions, 0);
  }
  EXPECT_GT(slid.states.back().bodies[0].position.y, 0.5);
}

/// A pin at the leaf's end holds its place, not its rotation.
TEST_P(JointPath, APinHolds) {
  Mechanism free = leaf();
  Mechanism pinned = leaf();
  pinned.pin("ground", "stage", {10.0, 0.0});
  PathStudy study;
  study.steps = 4;
  study.loads = {free.load("stage", {0.0, 0.0}, 0.2)};
  const ModelingPath on_pin = path_of(pinned, study, GetParam());
  study.prescribe = {{free.index("stage"), {}, 0.0, 0.0, {}}};
  const ModelingPath held = path_of(free, study, GetParam());
  ASSERT_EQ(on_pin.states.size(), held.states.size());
  for (std::size_t k = 0; k < held.states.size(); ++k)
    EXPECT_LT(distance(on_pin.states[k].bodies[0], held.states[k].bodies[0], 10.0), 1e-11) << k;
  EXPECT_GT(on_pin.states.back().bodies[0].rotation, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Modelings, JointPath,
                         ::testing::Values(linear(), scmbm_centre(), exact_modes(8), beam(4, 3),
                                           bcm(4)),
                         [](const auto& tested) { return tested.param.label; });

/// A crank against a torsion of the leaf it carries: a rod of length r on a pin, held by a spring
/// of no mass between the ends of a triangle. With a dead force F across, moments balance:
///     F r cos a = k (l - l0) dl/da, l the spring's length at the angle a.
TEST(JointEquilibrium, ACrankOnASpring) {
  constexpr double r = 2.0, k = 0.7, force = 0.4;
  constexpr Vec2 anchor{0.0, 3.0};
  Mechanism crank;
  crank.fixed("ground").centre(anchor).body("crank").centre({r, 0.0}).mass(0.0, 1.0);
  crank.pin("ground", "crank", {0.0, 0.0}).spring("ground", "crank", k);
  PathStudy study;
  study.steps = 5;
  study.loads = {crank.load("crank", {0.0, -force})};
  const ModelingPath path = path_of(crank, study, exact());
  ASSERT_EQ(path.states.size(), 6u);
  const double drawn = norm(anchor - Vec2{r, 0.0});
  for (const PathState& state : path.states) {
    const double a = state.bodies[0].rotation;
    const Vec2 end = r * Vec2{std::cos(a), std::sin(a)};
    EXPECT_LT(norm(end - state.bodies[0].position), 1e-11);
    const double length = norm(anchor - end);
    const double slope = dot(end - anchor, perp(end)) / length;
    EXPECT_NEAR(-state.load_factor * force * end.x, k * (length - drawn) * slope, 1e-10);
  }
  EXPECT_LT(path.states.back().bodies[0].rotation, -0.2);
}

/// A leaf whose end is tied to the ground by a rod on two pins: the end stays on the rod's circle,
/// and the rod takes the force that a prescribed place there would, along itself.
TEST(JointEquilibrium, ARodTiesALeaf) {
  constexpr double rod = 4.0;
  Mechanism tied = leaf();
  tied.body("rod").centre({10.0, -rod}).mass(0.0, 1.0);
  tied.pin("ground", "rod", {10.0, -rod}).pin("rod", "stage", {10.0, 0.0});
  PathStudy study;
  study.steps = 4;
  study.loads = {tied.load("stage", {-0.05, 0.02}, 0.05)};
  const ModelingPath path = path_of(tied, study, exact());
  ASSERT_EQ(path.states.size(), 5u);
  const Pose end = path.states.back().bodies[0];
  const double turn = path.states.back().bodies[1].rotation;
  for (const PathState& state : path.states)
    EXPECT_NEAR(norm(state.bodies[0].position - Vec2{10.0, -rod}), rod, 1e-10);
  EXPECT_GT(std::abs(turn), 0.01);
  Mechanism free = leaf();
  study.prescribe = {{free.index("stage"), {}, end.position.x - 10.0, end.position.y, {}}};
  const ModelingPath held = path_of(free, study, exact());
  const Vec2 force = held.states.back().reactions.at(0).force;
  const Vec2 along = (1.0 / rod) * (Vec2{10.0, -rod} - end.position);
  note_measured("across", cross(along, force) / norm(force));
  EXPECT_LT(distance(held.states.back().bodies[0], end, 10.0), 1e-9);
  EXPECT_LT(std::abs(cross(along, force)), 1e-8 * norm(force));
}

}  // namespace
}  // namespace flexura::testing

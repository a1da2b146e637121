// Loads along flexures and temperature. Closed forms: a cantilever under a uniform load (linear:
// q L^4/8EI + q L^2/2GA, rounding), its moment q (L - s)^2/2; the column that buckles under its own
// weight, q L^3/EI = 7.8373 (first zero of J_-1/3(2/3 q^(1/2)), without axial and shear strain;
// the stability is located to 1e-4 of the path); free thermal growth. Beyond, two modelings that
// share nothing but the port: `exact` and high-order displacement elements, on a chain whose second
// flexure has a base section that turns: 1e-8 of the chain's size, the modelings' tolerance.
#include <gtest/gtest.h>

#include <cmath>

#include "flexura/studies/path_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

TracedPath trace_fields(const Model& model, const FieldLoads& fields,
                        const ModelingSettings& settings, int steps) {
  TraceOptions options;
  options.steps = steps;
  options.fields = fields;
  return trace_path(model, {}, settings, options);
}

ModelingPath run_fields(const Model& model, const FieldLoads& fields,
                        const ModelingSettings& settings, int steps = 4) {
  PathStudy study;
  study.fields = fields;
  study.steps = steps;
  study.modelings = {settings};
  return run_path(model, study, settings, {});
}

class FieldLoad : public ::testing::TestWithParam<ModelingSettings> {};
INSTANTIATE_TEST_SUITE_P(Modelings, FieldLoad,
                         ::testing::Values(linear(), scmbm_end(), exact(), beam(4, 6),
                                           von_karman(8), linear_beam(4)),
                         [](const auto& each) { return each.param.label; });

TEST_P(FieldLoad, UniformLoadOnACantilever) {
  const Mechanism model = cantilever({1e5, 2.0, 30.0});
  const double q = 1e-7;
  const ModelingPath path = run_fields(model, {{{0, {0.0, q}}}, {}, 0.0}, GetParam());
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const double tip = path.states.back().bodies[0].position.y;
  const double expected = q / (8.0 * 2.0) + q / (2.0 * 30.0);
  // of small loads the difference to the linear answer is the square of the rotation, 1e-16
  EXPECT_NEAR(tip / expected, 1.0, 1e-9);
  EXPECT_NEAR(path.states.back().bodies[0].rotation / (q / 12.0), 1.0, 1e-9);
  for (const MemberStation& station : path.members[0]) {
    EXPECT_NEAR(station.bending_moment, 0.5 * q * std::pow(1.0 - station.s, 2), 1e-8 * q);
    EXPECT_NEAR(station.shear_force, q * (1.0 - station.s), 1e-8 * q);
  }
}

TEST_P(FieldLoad, TemperatureLengthensAFreeFlexure) {
  Mechanism model = cantilever({1e3, 1.0, 1e3});
  Model heated = model;
  heated.materials.front().thermal_expansion = 2e-5;
  const ModelingPath path = run_fields(heated, {{}, {}, 50.0}, GetParam());
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  EXPECT_NEAR(path.states.back().bodies[0].position.x, 1.001, 1e-13);
  EXPECT_NEAR(path.states.back().bodies[0].position.y, 0.0, 1e-13);
  for (const MemberStation& station : path.members[0]) EXPECT_NEAR(station.axial_force, 0.0, 1e-9);
}

Mechanism chain_of_two() {
  Mechanism chain;
  with_stiffness(chain, {500.0, 1.0, 200.0});
  chain.fixed("ground").body("elbow").body("hand");
  chain.flexure("ground", "elbow", LineAxis{{0, 0}, {1, 0}});
  chain.flexure("elbow", "hand", ArcAxis{{1.0, 0.5}, 0.5, -M_PI / 2.0, 2.0});
  return chain;
}

TEST(FieldLoads, ExactMatchesElementsWhereBasesTurn) {
  Model chain = chain_of_two();
  chain.materials.front().thermal_expansion = 1e-3;
  const FieldLoads fields{{{0, {0.3, -1.0}}, {1, {-0.5, -1.5}}}, {}, 20.0};
  const TracedPath a = trace_fields(chain, fields, exact(1e-11), 10);
  const TracedPath b = trace_fields(chain, fields, beam(8, 6), 10);
  ASSERT_TRUE(a.termination.converged()) << a.termination.reason;
  ASSERT_TRUE(b.termination.converged()) << b.termination.reason;
  double worst = 0.0;
  for (std::size_t state = 0; state < a.states.size(); ++state)
    for (const std::size_t body : {1U, 2U})
      worst = std::max(worst, distance(pose_in(a, state, body), pose_in(b, state, body), 1.0));
  note_measured("exact_against_elements", worst);
  EXPECT_LT(worst, 1e-8);
  // and it does bend: the hand turns by more than half a radian
  EXPECT_GT(std::abs(pose_in(a, 10, 2).rotation), 0.5);
}

TEST(FieldLoads, SectionForcesAgreeWhereBasesTurn) {
  const Model chain = chain_of_two();
  const FieldLoads fields{{{0, {0.3, -1.0}}, {1, {-0.5, -1.5}}}, {}, 0.0};
  const ModelingPath a = run_fields(chain, fields, exact(1e-11));
  const ModelingPath b = run_fields(chain, fields, beam(8, 6));
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < a.members[f].size(); ++k) {
      EXPECT_NEAR(a.members[f][k].bending_moment, b.members[f][k].bending_moment, 1e-7);
      EXPECT_NEAR(a.members[f][k].axial_force, b.members[f][k].axial_force, 1e-7);
      EXPECT_NEAR(a.members[f][k].shear_force, b.members[f][k].shear_force, 1e-7);
    }
  // the hand is free
  EXPECT_NEAR(a.members[1].back().bending_moment, 0.0, 1e-9);
  EXPECT_NEAR(a.members[1].back().axial_force, 0.0, 1e-9);
}

/// Elements by von Karman's strains converge to the exact beam by order 2 in their number; weight,
/// turning bases and heat are what is new here. The elongation energy of both differs by terms of
/// third order in the strain, hence the stiff axis.
TEST(FieldLoads, VonKarmanConvergesToExactWhereBasesTurn) {
  Mechanism stiff;
  with_stiffness(stiff, {1e5, 1.0, 1e5});
  stiff.fixed("ground").body("elbow").body("hand");
  stiff.flexure("ground", "elbow", LineAxis{{0, 0}, {1, 0}});
  stiff.flexure("elbow", "hand", ArcAxis{{1.0, 0.5}, 0.5, -M_PI / 2.0, 2.0});
  Model chain = stiff;
  chain.materials.front().thermal_expansion = 1e-4;
  const FieldLoads fields{{{0, {0.3, -1.0}}, {1, {-0.5, -1.5}}}, {}, 20.0};
  const TracedPath truth = trace_fields(chain, fields, exact(1e-11), 4);
  std::vector<Pose> poses;
  std::vector<double> errors;
  for (const int elements : {8, 16, 32}) {
    const TracedPath path = trace_fields(chain, fields, von_karman(elements), 4);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    poses.push_back(pose_in(path, 4, 2));
    errors.push_back(distance(pose_in(truth, 4, 2), poses.back(), 1.0));
  }
  note_measured("von_karman_32_elements", errors.back());
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9);
  const auto limit = [](double coarse, double fine) { return fine + (fine - coarse) / 3.0; };
  const Pose extrapolated{{limit(poses[1].position.x, poses[2].position.x),
                           limit(poses[1].position.y, poses[2].position.y)},
                          limit(poses[1].rotation, poses[2].rotation)};
  const double error = distance(pose_in(truth, 4, 2), extrapolated, 1.0);
  note_measured("von_karman_extrapolated", error);
  EXPECT_LT(error, 1e-5);
}

/// To first order: the linear elements give what the compliance matrix of the whole flexure does.
TEST(FieldLoads, LinearElementsMatchTheLinearFlexure) {
  Model chain = chain_of_two();
  chain.materials.front().thermal_expansion = 1e-3;
  const FieldLoads fields{{{0, {0.3, -1.0}}, {1, {-0.5, -1.5}}}, {}, 20.0};
  const ModelingPath a = run_fields(chain, fields, linear());
  const ModelingPath b = run_fields(chain, fields, linear_beam(64));
  const PathState& here = a.states.back();
  const PathState& there = b.states.back();
  for (std::size_t body = 0; body < here.bodies.size(); ++body)
    EXPECT_LT(distance(here.bodies[body], there.bodies[body], 1.0), 2e-5);
  for (std::size_t k = 0; k < a.members[1].size(); ++k)
    EXPECT_NEAR(a.members[1][k].bending_moment, b.members[1][k].bending_moment, 1e-9);
  EXPECT_NEAR(here.strain_energy, there.strain_energy, 1e-4 * here.strain_energy);
}

/// The potential's own rate: strain energy gained is the work of the loads on the way.
class FieldWork : public ::testing::TestWithParam<ModelingSettings> {};
INSTANTIATE_TEST_SUITE_P(Modelings, FieldWork,
                         ::testing::Values(exact(1e-12), beam(8, 6), von_karman(8), linear()),
                         [](const auto& each) { return each.param.label; });

TEST_P(FieldWork, EnergyGainedIsWorkDone) {
  Model chain = chain_of_two();
  chain.materials.front().thermal_expansion = 1e-3;
  const FieldLoads fields{{{0, {0.3, -1.0}}, {1, {-0.5, -1.5}}}, {}, 20.0};
  const TracedPath path = trace_fields(chain, fields, GetParam(), 20);
  ASSERT_TRUE(path.termination.converged());
  // E(1) = D(1) - integral of D d(load factor), by Simpson's rule
  double integral = 0.0;
  double last_displacement = 0.0, energy = 0.0;
  for (std::size_t k = 0; k < path.states.size(); ++k) {
    const TracedState& state = path.states[k];
    System& system = *path.systems[state.system];
    system.set_load_factor(state.load_factor);
    ASSERT_TRUE(system.linearize(state.z));
    last_displacement = system.load_displacement(state.z);
    energy = system.strain_energy();
    const double weight = k == 0 || k == 20 ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    integral += weight / 60.0 * last_displacement;
  }
  EXPECT_NEAR(energy / (last_displacement - integral), 1.0, 1e-5);
}

TEST(FieldLoads, ColumnBucklesUnderItsOwnWeight) {
  Mechanism column = cantilever({1.0, 1.0, 1.0});
  Model model = column;
  model.materials.front().density = 1.0;
  const double area = section_properties(model.sections.front().shape).area;
  const ModelingPath path =
      run_fields(model, {{}, {-8.0 / area, 0.0}, 0.0}, in_theory(exact(), "i"), 40);
  ASSERT_FALSE(path.events.empty()) << path.termination.reason;
  EXPECT_EQ(path.events.front().kind, "stability lost");
  const double critical = 8.0 * path.events.front().load_factor;
  note_measured("self_buckling", std::abs(critical / 7.8373474 - 1.0));
  EXPECT_NEAR(critical / 7.8373474, 1.0, 1e-4);
}

TEST(FieldLoads, TaperedWeightIsItsVolume) {
  Mechanism model = cantilever({1.0, 1.0, 1.0});
  Model tapered = model;
  tapered.materials.front().youngs_modulus = 1e6;
  tapered.materials.front().density = 1.0;
  tapered.sections.front().shape = RectangleSection{0.2, 1.0, TaperProfile{0.1}};
  for (const ModelingSettings& settings : {linear(), exact(), beam(8, 4)}) {
    const ModelingPath path = run_fields(tapered, {{}, {0.0, -1e-3}, 0.0}, settings);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    // thickness 0.2 - 0.1 s: shear 0.15, moment 0.2/2 - 0.1/3 at the clamp
    EXPECT_NEAR(std::abs(path.members[0].front().shear_force), 0.15e-3, 1e-10) << settings.label;
    EXPECT_NEAR(std::abs(path.members[0].front().bending_moment), 1e-3 * (0.1 - 0.1 / 3.0), 1e-10)
        << settings.label;
  }
}

}  // namespace
}  // namespace flexura::testing

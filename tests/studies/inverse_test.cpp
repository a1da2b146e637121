// Study `inverse` gives back the loads of a path: displacements of each flexure's action body in
// the final state of a path, prescribed, need the path's load at the loaded body and none on the
// others.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/modelings/compliance.hpp"
#include "flexura/studies/inverse_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

using At = RelativeDisplacement::At;

ModelingPath inverse(const Model& model, const std::vector<RelativeDisplacement>& relative,
                     const ModelingSettings& settings, int steps) {
  InverseStudy study;
  study.relative = relative;
  study.steps = steps;
  const ModelingPath path = run_inverse(model, study, settings, [](double) { return true; });
  EXPECT_TRUE(path.termination.converged()) << settings.label << ": " << path.termination.reason;
  return path;
}

/// The place that a relative displacement is about, as drawn.
Vec2 place_of(const Model& model, std::size_t flexure, const ModelingSettings& settings, At at) {
  const FlexureProperties p =
      flexure_properties(model, model.flexures[flexure], settings.axial, settings.shear);
  const Vec2 end = p.axis.position(p.axis.length());
  return at == At::end ? end : elastic_centre(compliance_matrix(p, end), end);
}

/// How the flexure's action body lies to its base body in a state, by the definition.
RelativeDisplacement relative_in(const Model& model, const System& system,
                                 const std::vector<double>& z, std::size_t index, Vec2 at) {
  const Flexure& flexure = model.flexures[index];
  const Vec2 start = axis_ends(flexure.axis).base;
  const Pose base = system.pose(flexure.base, z);
  const Pose action = system.pose(flexure.action, z);
  const Vec2 moved =
      system.moved_point(flexure.action, at, z) - system.moved_point(flexure.base, start, z);
  RelativeDisplacement relative;
  relative.flexure = index;
  relative.rotation = action.rotation - base.rotation;
  relative.displacement = system.linearised()
                              ? moved - (at - start) - base.rotation * perp(at - start)
                              : rotate(-base.rotation, moved) - (at - start);
  return relative;
}

struct RoundTrip {
  std::string name;
  ModelingSettings settings;
  At at = At::end;
  friend void PrintTo(const RoundTrip& trip, std::ostream* out) { *out << trip.name; }
};

class InverseRoundTrip : public ::testing::TestWithParam<RoundTrip> {};

TEST_P(InverseRoundTrip, GivesBackTheLoadsOfAPath) {
  const auto& [name, settings, at] = GetParam();
  const Mechanism chain = arc_chain();
  const Load load = chain.load("link4.E", {4e-4, 3e-4}, 2e-3);
  const TracedPath path = trace(chain, {load}, settings, 10, false);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  const TracedState& last = path.states.back();
  const System& system = *path.systems[last.system];
  std::vector<RelativeDisplacement> relative;
  for (std::size_t k = 0; k < 3; ++k) {
    relative.push_back(relative_in(chain, system, last.z, k, place_of(chain, k, settings, at)));
    relative.back().at = at;
  }
  const ModelingPath found = inverse(chain, relative, settings, 8);
  ASSERT_EQ(found.states.size(), 9U);
  const PathState& state = found.states.back();
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_LT(distance(state.bodies[b], system.pose(b + 1, last.z), 20.0), 1e-10) << b;

  // a dead force at the point: about the body's centre, its lever is the point's present one
  const Vec2 arm =
      system.moved_point(3, {19.093, 15.750}, last.z) - system.pose(3, last.z).position;
  const Vec2 drawn_arm = Vec2{19.093, 15.750} - body_centre(chain, 3);
  const double moment = load.moment + cross(system.linearised() ? drawn_arm : arm, load.force);
  ASSERT_EQ(state.reactions.size(), 3U);
  const double size = norm(load.force);
  note_measured("force", norm(state.reactions[2].force - load.force) / size);
  EXPECT_LT(norm(state.reactions[2].force - load.force), 1e-8 * size);
  EXPECT_NEAR(state.reactions[2].moment, moment, 1e-8 * size * 10.0);
  for (const std::size_t b : {0U, 1U}) {
    EXPECT_LT(norm(state.reactions[b].force), 1e-8 * size) << b;
    EXPECT_NEAR(state.reactions[b].moment, 0.0, 1e-8 * size * 10.0) << b;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Modelings, InverseRoundTrip,
    ::testing::Values(
        RoundTrip{"linear", linear()}, RoundTrip{"linear_centre", linear(), At::centre},
        RoundTrip{"scmbm_centre", scmbm_centre(), At::centre},
        RoundTrip{"scmbm_centre_by_ends", scmbm_centre()}, RoundTrip{"scmbm_end", scmbm_end()},
        RoundTrip{"prbm", in_theory(prbm(), "i")}, RoundTrip{"exact", exact_modes(14)},
        RoundTrip{"exact_inextensible", in_theory(exact_modes(14), "i")},
        RoundTrip{"exact_centre", exact_modes(14), At::centre},
        RoundTrip{"beam_order_1", beam(32, 1)}, RoundTrip{"beam_order_4", beam(6, 4)}),
    [](const auto& test) { return test.param.name; });

/// One flexure, its displacement given at the point its matrix is about: by SCMBM the load is
/// C^-1 (d, phi) times the factor, about the displaced point; straight lines over the path.
TEST(InverseScmbm, LoadsAreLinearInTheDisplacement) {
  const Mechanism single = single_flexure(ArcAxis{{0.0, 3.0}, 3.0, -0.5 * std::numbers::pi, 2.4});
  for (const At at : {At::centre, At::end}) {
    const ModelingSettings settings = at == At::centre ? scmbm_centre() : scmbm_end();
    const Vec2 place = place_of(single, 0, settings, at);
    RelativeDisplacement relative{0, {0.8, -1.1}, 0.9, at};
    const ModelingPath path = inverse(single, {relative}, settings, 5);
    const Eigen::Matrix3d stiffness =
        compliance_matrix(flexure_properties(single, single.model().flexures[0], true, true), place)
            .inverse();
    const Eigen::Vector3d load = stiffness * Eigen::Vector3d(0.8, -1.1, 0.9);
    const Vec2 force{load[0], load[1]};
    const Vec2 arm = place - body_centre(single, 1);
    for (std::size_t k = 0; k <= 5; ++k) {
      const double factor = 0.2 * static_cast<double>(k);
      const Reaction& found = path.states[k].reactions[0];
      EXPECT_LT(norm(found.force - factor * force), 1e-12 * norm(force)) << k;
      // about the body's centre rather than about the displaced point
      const double moment = factor * load[2] + cross(rotate(factor * 0.9, arm), factor * force);
      EXPECT_NEAR(found.moment, moment, 1e-12 * (std::abs(load[2]) + norm(force))) << k;
    }
  }
}

/// Straight, inextensible, and asked to lengthen: no load does that.
TEST(InverseImpossible, SaysThatAFlexureCannotFollow) {
  const Mechanism straight = single_flexure(LineAxis{{0.0, 0.0}, {10.0, 0.0}});
  InverseStudy study;
  study.relative = {{0, {0.1, 0.0}, 0.0, At::end}};
  const ModelingPath path =
      run_inverse(straight, study, in_theory(exact_modes(8), "i"), [](double) { return true; });
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_FALSE(path.termination.reason.empty());
}

/// A cancelled study keeps what it has.
TEST(InverseCancelled, KeepsTheStatesSoFar) {
  const Mechanism single = single_flexure(ArcAxis{{0.0, 3.0}, 3.0, -0.5 * std::numbers::pi, 2.4});
  InverseStudy study;
  study.relative = {{0, {-0.5, 0.4}, 0.4, At::end}};
  study.steps = 10;
  const ModelingPath path =
      run_inverse(single, study, exact_modes(10), [](double factor) { return factor < 0.45; });
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_EQ(path.states.size(), 6U);
}

}  // namespace
}  // namespace flexura::testing

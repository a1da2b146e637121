// Networks of flexures: what is in series adds compliance, what is in parallel adds stiffness, and
// loops close, by the assembly and by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/ellipse.hpp"
#include "flexura/modelings/make_system.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

/// Of a body at its centre, by the assembled mechanism at rest.
Eigen::Matrix3d assembled(const Model& model, std::size_t body, const ModelingSettings& settings) {
  System system(make_layout(model, {}, settings));
  EXPECT_TRUE(system.linearize(system.initial_state()));
  return system.body_compliance(body);
}

Eigen::Matrix3d flexure_compliance(const Model& model, std::size_t index, Vec2 at) {
  return compliance_matrix(flexure_properties(model, model.flexures[index], true, true), at);
}

TEST(Networks, FlexuresInSeriesAddTheirCompliances) {
  const Mechanism chain = arc_chain();
  const Vec2 at = body_centre(chain, 3);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += flexure_compliance(chain, k, at);
  for (const ModelingSettings& modeling : {linear(), scmbm_centre(), scmbm_end(), exact_modes(16)})
    EXPECT_LT((assembled(chain, 3, modeling) - sum).norm(), 1e-11 * sum.norm()) << modeling.label;
}

TEST(Networks, FlexuresInParallelAddTheirStiffnesses) {
  const Mechanism stage = parallelogram();
  const Vec2 at = body_centre(stage, 1);
  const Eigen::Matrix3d expected =
      (flexure_compliance(stage, 0, at).inverse() + flexure_compliance(stage, 1, at).inverse())
          .inverse();
  const Eigen::Vector3d size = expected.diagonal().cwiseSqrt();
  for (const ModelingSettings& modeling : {linear(), scmbm_centre(), scmbm_end(), exact_modes(8)}) {
    const Eigen::Matrix3d found = assembled(stage, 1, modeling);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(found(i, j), expected(i, j), 1e-11 * size[i] * size[j]) << modeling.label;
  }
}

/// A leaf from ground to the stage counts alike whichever end is its base.
TEST(Networks, ParallelLeavesMayPointEitherWay) {
  Mechanism stage = parallelogram();
  Model turned = stage.model();
  turned.flexures[1].base = 1;
  turned.flexures[1].action = 0;
  turned.flexures[1].axis = LineAxis{{50.0, 30.0}, {0.0, 30.0}};
  const Load load = stage.load("stage.P", {0.5, -3.0}, 4.0);
  EXPECT_LT(distance(final_pose(stage, {load}, exact(1e-11), 1, 3),
                     final_pose(turned, {load}, exact(1e-11), 1, 3), 50.0),
            1e-10);
}

/// Leaves of a parallelogram sway like two pairs of half-length cantilevers: without axial strain
/// the stage moves on a nearly circular path without turning, u_x = -(3/5) u_y^2/L to second order.
TEST(Networks, InextensibleParallelogramTranslates) {
  const Mechanism stage = parallelogram();
  for (const ModelingSettings& modeling : {exact(1e-11), beam(8, 4)}) {
    const TracedPath path =
        trace(stage, {stage.load("stage", {0.0, -1.0})}, in_theory(modeling, "i"), 4);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const Pose pose = pose_in(path, 4, 1);
    const Vec2 u = pose.position - Vec2{50.0, 15.0};
    EXPECT_LT(std::abs(u.y), 5.0);
    EXPECT_GT(std::abs(u.y), 0.05);
    EXPECT_NEAR(u.x, -0.6 * u.y * u.y / 50.0, 0.02 * std::abs(u.x));
    // 12 EI/L^3 each, and the leaves' length is kept
    const double ei = 210e3 * 10.0 * 0.125 / 12.0;
    EXPECT_NEAR(u.y, -1.0 / (24.0 * ei / std::pow(50.0, 3)), 0.01 * std::abs(u.y));
    EXPECT_LT(std::abs(pose.rotation), 0.1 * std::abs(u.y) / 30.0);
  }
}

/// A straight pseudo-rigid chain has collinear joints and no way to shorten: singular flexibility.
TEST(Networks, ParallelogramOfStraightPseudoRigidChains) {
  const Mechanism stage = parallelogram();
  const Load load = stage.load("stage", {0.0, -20.0});
  const Pose discrete = final_pose(stage, {load}, in_theory(prbm(), "i"), 1, 5);
  const Pose truth = final_pose(stage, {load}, in_theory(exact(), "i"), 1, 5);
  const double sway = norm(truth.position - Vec2{50.0, 15.0});
  EXPECT_GT(sway, 4.0);
  EXPECT_LT(norm(discrete.position - truth.position), 0.02 * sway);
}

/// The four-bar frame swayed by 5.6 N: reaction forces of both legs balance the load.
TEST(Networks, FourBarIsInEquilibrium) {
  const Mechanism frame = portal_frame();
  for (const ModelingSettings& modeling :
       {exact(), beam(4, 4), scmbm_centre(), in_theory(prbm(), "i")}) {
    const TracedPath path = trace(frame, {frame.load("left", {2.0, 0.0})}, modeling, 10);
    ASSERT_TRUE(path.termination.converged()) << modeling.label << path.termination.reason;
    const TracedState& last = path.states.back();
    const System& system = *path.systems[last.system];
    const Eigen::Vector3d ground = system.reaction(0, last.z);
    EXPECT_NEAR(ground[0], -2.0, 1e-7) << modeling.label;
    EXPECT_NEAR(ground[1], 0.0, 1e-7) << modeling.label;
    EXPECT_LT((system.reaction(1, last.z) - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-7);
    EXPECT_LT(system.reaction(2, last.z).norm(), 1e-7);
  }
}

/// A spline through points of an arc answers as the arc, to the order of the spline.
TEST(Networks, SplineThroughPointsOfAnArcAnswersAsTheArc) {
  const ArcAxis arc{{0.0, 5.0}, 5.0, -0.5 * std::numbers::pi, 2.0};
  const auto spline = [&](int pieces) {
    SplineAxis axis;
    for (int k = 0; k <= pieces; ++k)
      axis.points.push_back(arc.centre + arc.radius * unit(arc.start + arc.sweep * k / pieces));
    return axis;
  };
  const Mechanism truth = single_flexure(arc);
  const Load load = truth.load("stage", {3e-3, -2e-3}, 5e-3);
  for (const ModelingSettings& modeling : {linear(), scmbm_centre(), exact(1e-9), beam(64, 2)}) {
    const Pose expected = final_pose(truth, {load}, modeling, 1, 3);
    const double coarse =
        distance(final_pose(single_flexure(spline(6)), {load}, modeling, 1, 3), expected, 5.0);
    const double fine =
        distance(final_pose(single_flexure(spline(12)), {load}, modeling, 1, 3), expected, 5.0);
    EXPECT_LT(fine, 2e-4) << modeling.label;
    EXPECT_LT(fine, 0.2 * coarse) << modeling.label;
  }
}

}  // namespace
}  // namespace flexura::testing

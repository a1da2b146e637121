// Paths through limit points and past bifurcations, by arc length.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "flexura/studies/arc_tracer.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

TracedPath follow(const Model& model, std::vector<Load> loads, const ModelingSettings& settings,
                  PathEnd until = {}, std::optional<BranchSwitch> branch = {}, int steps = 20) {
  PathStudy study;
  study.loads = std::move(loads);
  study.arc_length = true;
  study.until = until;
  study.branch = branch;
  study.steps = steps;
  return trace_by_arc_length(model, study, settings, {});
}

std::vector<TracedEvent> events_of(const TracedPath& path, const std::string& kind) {
  std::vector<TracedEvent> events;
  for (const TracedEvent& event : path.events)
    if (event.kind == kind) events.push_back(event);
  return events;
}

/// Lee's frame, data as in lee_frame_test.cpp: the load that it carries at both limit points (15
/// digits in the reference), and where its loaded point is there (about 12). The load factor is
/// stationary, so loads come out to twice the digits of places.
TEST(LeeFrameByArcLength, PassesBothLimitPoints) {
  const Mechanism frame = lee_frame();
  for (const std::string theory : {"i", "ii", "iii"}) {
    const auto truth = read_reference_json("C_lee_frame_limits.json")[theory]["extrema"];
    const TracedPath path =
        follow(frame, {frame.load("loaded", {0.0, -2.5})}, in_theory(exact(1e-10), theory));
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    EXPECT_EQ(path.states.back().load_factor, 1.0);
    EXPECT_EQ(path.states.back().unstable_directions, 0);
    const auto limits = events_of(path, "limit point");
    ASSERT_EQ(limits.size(), 2U) << theory;
    for (std::size_t k = 0; k < 2; ++k) {
      const double p = number_of(truth[k]["P"]);
      const Vec2 place = path.systems[limits[k].system]->pose(2, limits[k].z).position;
      const Vec2 u{number_of(truth[k]["u"]), -number_of(truth[k]["v"])};
      note_measured(theory + std::to_string(k) + "_load",
                    std::abs(2.5 * limits[k].load_factor / p - 1.0));
      EXPECT_NEAR(2.5 * limits[k].load_factor, p, 1e-11 * std::abs(p)) << theory;
      EXPECT_LT(norm(place - Vec2{24.0, 120.0} - u), 1e-5 * 120.0) << theory;
    }
    ASSERT_EQ(events_of(path, "stability lost").size(), 1U);
    ASSERT_EQ(events_of(path, "stability gained").size(), 1U);
    EXPECT_EQ(events_of(path, "zero load").size(), 2U);
  }
}

/// A clamped-free inextensible column leaves its straight path at Euler's load and follows the
/// elastica: P L^2/EI = K(k)^2 with k = sin(alpha/2), alpha the rotation of the tip, whose
/// deflection is 2 k L/K. To either side.
TEST(EulerColumn, FollowsTheElasticaPastTheBifurcation) {
  const double euler = std::numbers::pi * std::numbers::pi / 4.0;
  const Mechanism column = cantilever({1.0, 1.0, 1.0});
  const double load = 1.3 * euler;
  double low = 0.0, high = 0.99;
  for (int i = 0; i < 80; ++i) {
    const double k = 0.5 * (low + high);
    (std::pow(std::comp_ellint_1(k), 2) < load ? low : high) = k;
  }
  const double k = low;
  for (const int side : {1, -1}) {
    const TracedPath path = follow(column, {column.load("tip", {-load, 0.0})},
                                   in_theory(exact(1e-10), "i"), {}, BranchSwitch{1, side});
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const auto bifurcations = events_of(path, "bifurcation");
    ASSERT_EQ(bifurcations.size(), 1U);
    note_measured("bifurcation", std::abs(bifurcations[0].load_factor * 1.3 - 1.0));
    EXPECT_NEAR(bifurcations[0].load_factor * 1.3, 1.0, 1e-8);
    const Pose tip = pose_in(path, path.states.size() - 1, 1);
    EXPECT_NEAR(side * tip.rotation * (tip.position.y > 0.0 ? 1.0 : -1.0) * side,
                2.0 * std::asin(k), 1e-8);
    EXPECT_NEAR(std::abs(tip.position.y), 2.0 * k / std::sqrt(load), 1e-8);
    EXPECT_EQ(path.states.back().unstable_directions, 0);
    EXPECT_EQ(events_of(path, "stability lost").size(), 1U);
  }
}

/// The two sides of a bifurcation mirror each other.
TEST(EulerColumn, SidesDiffer) {
  const Mechanism column = cantilever({1.0, 1.0, 1.0});
  const Load load = column.load("tip", {-3.0, 0.0});
  const auto tip_of = [&](int side) {
    const TracedPath path =
        follow(column, {load}, in_theory(exact(1e-9), "i"), {}, BranchSwitch{1, side});
    return pose_in(path, path.states.size() - 1, 1).position.y;
  };
  EXPECT_LT(tip_of(1) * tip_of(-1), 0.0);
}

/// A column pushed aside has no bifurcation to leave its path at, and that is said.
TEST(EulerColumn, WithAnImperfectionHasNoBranch) {
  const Mechanism column = cantilever({1.0, 1.0, 1.0});
  const TracedPath path = follow(column, {column.load("tip", {-3.0, 1e-3})},
                                 in_theory(exact(1e-9), "i"), {}, BranchSwitch{1, 1});
  EXPECT_EQ(path.termination.status, Status::stopped);
  EXPECT_NE(path.termination.reason.find("0 bifurcations"), std::string::npos);
  EXPECT_EQ(path.states.back().load_factor, 1.0);
}

/// DaDeppo and Schmidt's deep arch (R = 100, 215 degrees, one end clamped, the other hinged, EI =
/// 1e6, EA = GA = 100 EI, dead load at the crown) snaps at P = 897 (J. Appl. Mech. 42, 1975). Two
/// discretizations that share nothing but the beam theory agree to eight digits on 897.3.
TEST(DeepArch, SnapsAtThePublishedLoad) {
  const double half = 107.5 / 180.0 * std::numbers::pi;
  Mechanism arch;
  with_stiffness(arch, {1e8, 1e6, 1e8});
  arch.fixed("ground").body("crown").centre({0.0, 100.0});
  const double right = 0.5 * std::numbers::pi;
  arch.flexure("ground", "crown", ArcAxis{{0.0, 0.0}, 100.0, right + half, -half});
  arch.flexure("crown", "ground", ArcAxis{{0.0, 0.0}, 100.0, right, -half}).pin_action();
  PathEnd until;
  until.limit_points = 1;
  std::vector<double> limits;
  for (const ModelingSettings& modeling : {exact(1e-9), beam(16, 5)}) {
    const TracedPath path =
        follow(arch, {arch.load("crown", {0.0, -1000.0})}, modeling, until, {}, 40);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const auto found = events_of(path, "limit point");
    ASSERT_EQ(found.size(), 1U);
    limits.push_back(1000.0 * found[0].load_factor);
    note_measured(modeling.label, limits.back());
  }
  EXPECT_NEAR(limits[0], 897.3, 0.05);
  EXPECT_NEAR(limits[0], limits[1], 1e-8 * limits[0]);
}

/// Williams' toggle (half span 12.943 in, rise 0.386 in, bars 0.753 by 0.243 in, E = 10.3e6 psi,
/// clamped ends, dead load at the apex). No digits are published: the limit points by the exact
/// flexure are held against high-order displacement elements.
TEST(WilliamsToggle, TwoDiscretizationsAgreeOnItsLimitPoints) {
  Mechanism toggle;
  toggle.material(10.3e6, 0.0).section(RectangleSection{0.243, 0.753});
  toggle.fixed("ground").body("apex").centre({0.0, 0.386});
  toggle.flexure("ground", "apex", LineAxis{{-12.943, 0.0}, {0.0, 0.386}});
  toggle.flexure("apex", "ground", LineAxis{{0.0, 0.386}, {12.943, 0.0}});
  std::vector<std::vector<double>> found;
  for (const ModelingSettings& modeling : {exact(1e-10), beam(8, 5)}) {
    const TracedPath path =
        follow(toggle, {toggle.load("apex", {0.0, -80.0})}, modeling, {}, {}, 100);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    found.emplace_back();
    for (const TracedEvent& event : path.events)
      if (event.kind == "limit point") found.back().push_back(80.0 * event.load_factor);
    const Vec2 apex = pose_in(path, path.states.size() - 1, 1).position;
    found.back().push_back(apex.y);
  }
  ASSERT_EQ(found[0].size(), found[1].size());
  ASSERT_GT(found[0].size(), 1U);
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    note_measured("value_" + std::to_string(i), found[0][i]);
    EXPECT_NEAR(found[0][i], found[1][i], 1e-8 * std::abs(found[0][i]));
  }
}

}  // namespace
}  // namespace flexura::testing

// Study `linkage`: what it refuses, what does not depend on how a linkage is put together, what its
// parts say of one another. Comparisons with truths from outside are in verification.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/studies/linkage_study.hpp"
#include "tests/support/linkage.hpp"
#include "tests/support/plane_mesh.hpp"

namespace flexura::testing {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;

LinkageStudy beams(int elements) {
  LinkageStudy study;
  study.modeling.kind = BeamSettings{elements, 1, BeamSettings::Theory::linear};
  study.modeling.label = "beam";
  study.modeling.shear = false;
  study.elements = elements;
  study.positions = 60;
  study.damping.modal = 0.05;
  study.methods = {LinkageStudy::Method::periodic};
  return study;
}

LinkageResult run(const Model& model, const LinkageStudy& study) {
  Termination termination;
  LinkageResult result = run_linkage(model, study, termination, {});
  EXPECT_TRUE(termination.converged()) << termination.reason;
  return result;
}

std::string refusal(const Model& model, const LinkageStudy& study) {
  Termination termination;
  run_linkage(model, study, termination, {});
  EXPECT_EQ(termination.status, Status::stopped);
  return termination.reason;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    apart = std::max(apart, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return apart / size;
}

/// Crank 60, rod 300; the rod hinged to the crank by its pinned end, or by a joint with a body to
/// which it is clamped.
Mechanism slider_crank(bool by_joint) {
  Mechanism machine;
  machine.material(210e3, 0.3).density(7.85e-9);
  machine.section(RectangleSection{3.0, 20.0});
  machine.fixed("frame").body("crank").centre({0.0, 0.0});
  machine.body("slider").mass(2e-4).centre({360.0, 0.0});
  if (by_joint) machine.body("knuckle").centre({80.0, 30.0});
  const LineAxis axis{{60.0, 0.0}, {360.0, 0.0}};
  if (by_joint) {
    machine.flexure("knuckle", "slider", axis).pin_action();
    machine.pin("crank", "knuckle", {60.0, 0.0});
  } else {
    machine.flexure("crank", "slider", axis).pin_base().pin_action();
  }
  machine.slide("frame", "slider", {1.0, 0.0});
  machine.turn("crank", 1500.0 * rpm, LinearHistory{});
  return machine;
}

TEST(LinkageStudies, JointsAreAsGoodAsPinnedEnds) {
  const LinkageResult pinned = run(slider_crank(false).model(), beams(3));
  const LinkageResult jointed = run(slider_crank(true).model(), beams(3));
  for (std::size_t i = 0; i < pinned.frequencies.size(); ++i)
    EXPECT_NEAR(jointed.frequencies[i][0] / pinned.frequencies[i][0], 1.0, 1e-9);
  EXPECT_LT(
      distance(jointed.modelings[0].flexures[0].strain, pinned.modelings[0].flexures[0].strain),
      1e-7);
}

std::vector<double> lowest(const LinkageResult& result, std::size_t count) {
  const std::vector<double>& all = result.frequencies.front();
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// A thick rod, in which shear matters: Timoshenko's elements, and a plane mesh, against `exact`.
TEST(LinkageStudies, ThickRodsShear) {
  const auto machine = [](bool meshed) {
    Mechanism m;
    m.material(210e3, 0.3).density(7.85e-9).section(RectangleSection{40.0, 1.0});
    m.fixed("frame").body("crank").centre({0.0, 0.0});
    m.body("slider").mass(2e-4).centre({360.0, 0.0});
    if (meshed) {
      const auto along = [](Vec2 p) { return Vec2{60.0 + 300.0 * p.x, 40.0 * (p.y - 0.5)}; };
      m.link("crank", "slider", mapped_link(ElementKind::quad8, 30, 4, along));
    } else {
      m.flexure("crank", "slider", LineAxis{{60.0, 0.0}, {360.0, 0.0}});
    }
    m.pin_base().pin_action().slide("frame", "slider", {1.0, 0.0});
    m.turn("crank", 100.0 * rpm, LinearHistory{});
    return m.model();
  };
  LinkageStudy study = beams(12);
  study.methods = {LinkageStudy::Method::quasi_static};
  study.rotary_inertia = true;
  const std::vector<double> stiff = lowest(run(machine(false), study), 2);
  study.modeling.shear = true;
  const std::vector<double> elements = lowest(run(machine(false), study), 2);
  study.modeling.kind = ExactSettings{};
  const std::vector<double> exact = lowest(run(machine(false), study), 2);
  const std::vector<double> mesh = lowest(run(machine(true), study), 2);
  EXPECT_GT(stiff[0] / exact[0], 1.01);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(elements[k] / exact[k], 1.0, 2e-3);
    EXPECT_NEAR(mesh[k] / exact[k], 1.0, 1e-2);
  }
}

TEST(LinkageStudies, ForcesAreThoseOfTheRotatingMasses) {
  // a mass at the end of an arm, turned steadily: it pulls at its pin and takes no torque
  Mechanism arm;
  arm.material(210e3, 0.3).density(0.0).section(RectangleSection{3.0, 20.0});
  arm.fixed("frame").body("hub").centre({0.0, 0.0}).body("end").mass(2e-3);
  arm.flexure("hub", "end", LineAxis{{0.0, 0.0}, {100.0, 0.0}});
  arm.turn("hub", 10.0, LinearHistory{});
  LinkageStudy study = beams(1);
  study.methods = {LinkageStudy::Method::quasi_static};
  const LinkageResult result = run(arm.model(), study);
  for (const RigidPosition& position : result.positions) {
    EXPECT_NEAR(norm(position.shaking_force), 2e-3 * 100.0 * 100.0, 1e-9);
    EXPECT_NEAR(position.torque, 0.0, 1e-9);
  }
  // steady pull: m w^2 r/(EA) in the arm
  for (const double strain : result.modelings[0].flexures[0].axial_strain)
    EXPECT_NEAR(strain, 20.0 / (210e3 * 60.0), 1e-12);
}

/// The torque does what the kinetic energy gains: all of it over a quarter turn from where the
/// slider stands still.
TEST(LinkageStudies, RigidLinksNeedNoFlexures) {
  using Method = LinkageStudy::Method;
  const double speed = 30.0, slider = 0.2;
  Mechanism machine;
  machine.fixed("frame").body("crank").centre({0.0, 0.0}).body("rod").centre({60.0, 0.0});
  machine.body("slider").mass(slider).centre({120.0, 0.0});
  machine.pin("crank", "rod", {20.0, 0.0}).pin("rod", "slider", {120.0, 0.0});
  machine.slide("frame", "slider", {1.0, 0.0}).turn("crank", speed, LinearHistory{});
  LinkageStudy study = beams(2);
  study.positions = 360;
  study.methods = {Method::quasi_static, Method::periodic, Method::midha, Method::transient};
  const LinkageResult result = run(machine.model(), study);
  for (const LinkageMotion& motion : result.modelings) {
    EXPECT_TRUE(motion.termination.converged()) << motion.label << motion.termination.reason;
    EXPECT_EQ(motion.unknowns, 0);
  }
  double work = 0.0;  // by the trapezoidal rule
  for (std::size_t k = 0; k <= 90; ++k)
    work += (k % 90 == 0 ? 0.5 : 1.0) * result.positions.at(k).torque * std::numbers::pi / 180.0;
  const double velocity = 20.0 * speed;  // of the slider with the crank upright
  EXPECT_NEAR(work / (0.5 * slider * velocity * velocity), 1.0, 1e-3);
}

TEST(LinkageStudies, SayWhereACrankCannotTurn) {
  Mechanism bar;
  bar.material(210e3, 0.3).density(7.85e-9).section(RectangleSection{3.0, 20.0});
  bar.fixed("ground").body("shaft").centre({0.0, 0.0}).body("A").body("B");
  bar.flexure("shaft", "A", LineAxis{{0.0, 0.0}, {80.0, 0.0}}).pin_action();
  bar.flexure("A", "B", LineAxis{{80.0, 0.0}, {110.0, 40.0}}).pin_base().pin_action();
  bar.flexure("ground", "B", LineAxis{{100.0, 0.0}, {110.0, 40.0}}).pin_base().pin_action();
  bar.turn("shaft", 10.0, LinearHistory{});
  const std::string reason = refusal(bar.model(), beams(1));
  EXPECT_NE(reason.find("cannot go round"), std::string::npos) << reason;
  EXPECT_NE(reason.find("degrees"), std::string::npos) << reason;
}

/// A parallelogram comes into one line half a turn on.
TEST(LinkageStudies, SayWhereAChangePointIs) {
  Mechanism bar;
  bar.material(210e3, 0.3).density(7.85e-9).section(RectangleSection{3.0, 20.0});
  bar.fixed("ground").body("shaft").centre({0.0, 0.0}).body("A").body("B");
  bar.flexure("shaft", "A", LineAxis{{0.0, 0.0}, {0.0, 40.0}}).pin_action();
  bar.flexure("A", "B", LineAxis{{0.0, 40.0}, {100.0, 40.0}}).pin_base().pin_action();
  bar.flexure("ground", "B", LineAxis{{100.0, 0.0}, {100.0, 40.0}}).pin_base().pin_action();
  bar.turn("shaft", 10.0, LinearHistory{});
  const std::string reason = refusal(bar.model(), beams(1));
  EXPECT_NE(reason.find("at 90 degrees"), std::string::npos) << reason;
  EXPECT_NE(reason.find("change point"), std::string::npos) << reason;
}

TEST(LinkageStudies, SayThatADriveDoesNotGovernAllLinks) {
  Mechanism chain;
  chain.material(210e3, 0.3).density(7.85e-9).section(RectangleSection{3.0, 20.0});
  chain.fixed("ground").body("shaft").centre({0.0, 0.0}).body("A").body("B").body("C");
  chain.flexure("shaft", "A", LineAxis{{0.0, 0.0}, {20.0, 0.0}}).pin_action();
  chain.flexure("A", "B", LineAxis{{20.0, 0.0}, {60.0, 40.0}}).pin_base().pin_action();
  chain.flexure("B", "C", LineAxis{{60.0, 40.0}, {100.0, 40.0}}).pin_base().pin_action();
  chain.flexure("ground", "C", LineAxis{{110.0, 0.0}, {100.0, 40.0}}).pin_base().pin_action();
  chain.turn("shaft", 10.0, LinearHistory{});
  const std::string reason = refusal(chain.model(), beams(1));
  EXPECT_NE(reason.find("does not govern"), std::string::npos) << reason;
}

TEST(LinkageStudies, VaryingSpeedsAreStillPeriodic) {
  Model model = turcic_midha_four_bar().model();
  model.drivers[0].amount = 200.0 * rpm;
  LinkageStudy study = beams(1);
  study.positions = 180;
  study.fluctuation = {{1, 0.05, 0.3}};
  study.methods = {LinkageStudy::Method::periodic, LinkageStudy::Method::transient};
  const LinkageResult varied = run(model, study);
  EXPECT_LT(*varied.modelings[1].difference, 1e-5);
  study.fluctuation.clear();
  const LinkageResult steady = run(model, study);
  EXPECT_GT(
      distance(varied.modelings[0].flexures[1].strain, steady.modelings[0].flexures[1].strain),
      0.01);
}

/// Slow turning with a load: what bends is the load, and quasi-static is all there is.
TEST(LinkageStudies, SlowTurningIsQuasiStatic) {
  Model model = turcic_midha_four_bar().model();
  model.drivers[0].amount = 2.0 * rpm;
  LinkageStudy study = beams(2);
  Load load;
  load.body = 3;  // B
  load.force = {0.5, 0.2};
  load.history = FunctionHistory{[](double angle) { return 1.0 - std::cos(angle); }};
  study.loads = {load};
  study.methods = {LinkageStudy::Method::quasi_static, LinkageStudy::Method::periodic};
  const LinkageResult result = run(model, study);
  // the crank; the others, held at pins, are bent by their inertia alone
  EXPECT_LT(
      distance(result.modelings[0].flexures[0].strain, result.modelings[1].flexures[0].strain),
      1e-3);
}

/// Axial forces of the vibration itself: passes until they agree, and another answer than that of
/// the quasi-static ones.
TEST(LinkageStudies, DynamicAxialForcesSettle) {
  const Model model = [] {
    Model four_bar = turcic_midha_four_bar().model();
    four_bar.drivers[0].amount = 200.0 * rpm;
    return four_bar;
  }();
  LinkageStudy study = beams(2);
  study.geometric_stiffness = LinkageStudy::GeometricStiffness::quasi_static;
  const LinkageResult still = run(model, study);
  study.geometric_stiffness = LinkageStudy::GeometricStiffness::dynamic;
  const LinkageResult moving = run(model, study);
  const double apart =
      distance(moving.modelings[0].flexures[1].strain, still.modelings[0].flexures[1].strain);
  EXPECT_GT(apart, 1e-6);
  EXPECT_LT(apart, 0.1);
}

}  // namespace
}  // namespace flexura::testing

// The motion that a flexible linkage repeats with every turn: against long transients, rigid motion
// with quasi-static deflection, and what has to be refused.
#include "flexura/studies/periodic_motion.hpp"

#include <cmath>
#include <numbers>

#include "flexura/studies/mechanism_state.hpp"
#include "flexura/studies/motion_start.hpp"
#include "flexura/studies/path_record.hpp"
#include "tests/support/linkage.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mean_length = (4.25 + 11.0 + 10.65) / 3.0;

PeriodicMotionStudy turning(double rpm, double stiffness_damping) {
  PeriodicMotionStudy study;
  study.speed = rpm * 2.0 * pi / 60.0;
  study.damping.stiffness = stiffness_damping;
  study.outputs = 12;
  study.multipliers = 2;
  return study;
}

PeriodicMotion find(const Model& model, const PeriodicMotionStudy& study, int modes = 2) {
  PeriodicMotion motion = find_periodic_motion(model, study, exact_modes(modes));
  EXPECT_TRUE(motion.termination.converged()) << motion.termination.reason;
  return motion;
}

PathState places(const Model& model, const PeriodicMotion& motion, std::size_t k) {
  return make_path_state(model, MovingState(*motion.system, motion.moments.at(k)), 0.0);
}

/// The largest distance of bodies and of flexures' middles, in mean flexure lengths.
double apart(const PathState& a, const PathState& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i)
    worst = std::max(worst, norm(a.bodies[i].position - b.bodies[i].position));
  for (std::size_t i = 0; i < a.mids.size(); ++i)
    worst = std::max(worst, norm(a.mids[i].position - b.mids[i].position));
  return worst / mean_length;
}

constexpr int turns_waited = 9;

/// From one to minus one and back in every turn, with kinks.
TableHistory zigzag(double period) {
  std::vector<double> times, values;
  for (int k = 0; k <= 2 * turns_waited; ++k) {
    times.push_back(0.5 * period * k);
    values.push_back(k % 2 == 0 ? 1.0 : -1.0);
  }
  return {times, values, false};
}

TEST(PeriodicMotion, IsWhereALongTransientComes) {
  const Mechanism bar = turcic_midha_four_bar();
  PeriodicMotionStudy study = turning(300.0, 3e-4);
  study.tolerance = 1e-7;
  const double period = 2.0 * pi / study.speed;
  TransientStudy waiting = transient(turns_waited * period, turns_waited * 12, study.tolerance);
  waiting.damping = study.damping;
  Model turned = bar;
  turned.drivers[0].amount = study.speed;
  for (const bool loaded : {false, true}) {
    if (loaded) {
      study.loads = {bar.load("B", {0.5, 0.2})};
      study.loads[0].history = zigzag(period);
    }
    waiting.loads = study.loads;
    const PeriodicMotion orbit = find(bar, study);
    ASSERT_EQ(orbit.moments.size(), 13u);
    ASSERT_FALSE(orbit.multipliers.empty());
    EXPECT_LT(std::abs(orbit.multipliers.front()), 0.2);
    const ModelingMotion motion = move(turned, waiting, exact_modes(2));
    double worst = 0.0;
    for (std::size_t k = 0; k <= 12; ++k)
      worst = std::max(
          worst, apart(places(bar, orbit, k), motion.states.at(12 * (turns_waited - 1) + k).state));
    note_measured(loaded ? "difference_loaded" : "difference", worst);
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(PeriodicMotion, ComesRound) {
  const Mechanism bar = turcic_midha_four_bar();
  for (const double rpm : {150.0, -150.0}) {
    const PeriodicMotion orbit = find(bar, turning(rpm, 3e-4));
    const Moment& first = orbit.moments.front();
    const Moment& last = orbit.moments.back();
    EXPECT_NEAR(last.time, 0.4, 1e-12);
    const std::size_t shaft = bar.index("shaft");
    EXPECT_NEAR(orbit.system->pose(shaft, last.q).rotation, std::copysign(2.0 * pi, rpm), 1e-9);
    EXPECT_LT(apart(places(bar, orbit, 0), places(bar, orbit, 12)), 1e-8);
    EXPECT_LT(orbit.system->size_of(last.v - first.v) * 0.4, 1e-7);
  }
}

/// Where the pin B of rigid links is, with the crank turned.
Vec2 rigid_pin(double angle) {
  const Vec2 a{4.25 * std::cos(angle), 4.25 * std::sin(angle)}, d{10.0, 0.0};
  const double coupler = std::hypot(7.783913 - 4.25, 10.416883);
  const double follower = std::hypot(10.0 - 7.783913, 10.416883);
  const Vec2 apart = d - a;
  const double distance = norm(apart);
  const double along =
      (distance * distance + coupler * coupler - follower * follower) / (2.0 * distance);
  const double across = std::sqrt(coupler * coupler - along * along);
  return a + (1.0 / distance) * (along * apart + across * perp(apart));
}

/// Slow motion is that of rigid links; what they bend falls with the square of the speed.
TEST(PeriodicMotion, SlowOnesAreRigid) {
  const Mechanism bar = turcic_midha_four_bar();
  double bent[2] = {};
  for (const int halved : {0, 1}) {
    const PeriodicMotion orbit = find(bar, turning(10.0 / (1 + halved), 3e-4));
    for (std::size_t k = 0; k <= 12; ++k) {
      const PathState at = places(bar, orbit, k);
      const double angle = 2.0 * pi * static_cast<double>(k) / 12.0;
      EXPECT_LT(norm(at.bodies.at(2).position - rigid_pin(angle)), 2e-4);
      const Vec2 chord = at.bodies[2].position - at.bodies[1].position;
      bent[halved] = std::max(
          bent[halved],
          std::abs(cross(at.mids.at(1).position - at.bodies[1].position, chord)) / norm(chord));
    }
  }
  note_measured("bent", bent[0]);
  EXPECT_GT(bent[0], 1e-5);
  EXPECT_NEAR(bent[0] / bent[1], 4.0, 0.1);
}

/// Under a load, slow motion is a sequence of equilibria.
TEST(PeriodicMotion, SlowOnesAreInEquilibrium) {
  const Mechanism bar = turcic_midha_four_bar();
  double off[2] = {};
  for (const int halved : {0, 1}) {
    PeriodicMotionStudy study = turning(4.0 / (1 + halved), 1e-3);
    study.loads = {bar.load("A", {0.0, 0.0}, 5.0)};
    study.loads[0].history = HarmonicHistory{2.0 * study.speed, 0.3};
    study.fields.gravity = {0.0, -386.4};
    study.tolerance = 1e-8;
    const PeriodicMotion orbit = find(bar, study);
    for (std::size_t k = 0; k <= 12; ++k) {
      Moment still = orbit.moments.at(k);
      ASSERT_TRUE(solve_at_rest(*orbit.system, still));
      const PathState rest = make_path_state(bar, MovingState(*orbit.system, still), 0.0);
      off[halved] = std::max(off[halved], apart(places(bar, orbit, k), rest));
      EXPECT_GT(apart(places(bar, orbit, k), rest) + 1.0, 1.0);
    }
  }
  note_measured("off", off[0]);
  EXPECT_LT(off[0], 1e-4);
  EXPECT_LT(off[1], 0.6 * off[0]);
}

/// By waiting the largest multiplier tells how many turns it takes to come to 1e-6.
TEST(PeriodicMotion, LightDampingCostsFewTurns) {
  const Mechanism bar = turcic_midha_four_bar();
  PeriodicMotionStudy study = turning(200.0, 3e-6);
  study.tolerance = 1e-5;
  study.outputs = 60;
  const PeriodicMotion orbit = find(bar, study);
  const double waiting = std::log(1e-6) / std::log(std::abs(orbit.multipliers.at(0)));
  RecordProperty("turns_by_shooting", orbit.turns + orbit.flows);
  RecordProperty("turns_by_waiting", static_cast<int>(waiting));
  EXPECT_LT(std::abs(orbit.multipliers[0]), 1.0);
  EXPECT_LT(orbit.turns + orbit.flows, 50);
  EXPECT_GT(waiting, 5.0 * (orbit.turns + orbit.flows));
}

/// The crank's driver may have any history of its own, and other modelings do the same. (Damping by
/// the rate of elastic forces is not quite the same law in elements: their forces also turn with
/// them. Hence little of it.)
TEST(PeriodicMotion, ElementsAgree) {
  Model bar = turcic_midha_four_bar();
  bar.drivers[0].history = StepHistory{0.3};
  PeriodicMotionStudy study = turning(200.0, 2e-5);
  const PeriodicMotion modes = find(bar, study, 4);
  const PeriodicMotion elements = find_periodic_motion(bar, study, beam(2, 4));
  ASSERT_TRUE(elements.termination.converged()) << elements.termination.reason;
  double worst = 0.0;
  for (std::size_t k = 0; k <= 12; ++k)
    worst = std::max(worst, apart(places(bar, modes, k), places(bar, elements, k)));
  note_measured("difference", worst);
  EXPECT_LT(worst, 5e-5);
  EXPECT_LT(std::abs(std::abs(modes.multipliers.at(0)) - std::abs(elements.multipliers.at(0))),
            1e-2);
}

/// With so few turns at a speed that 300 rpm cannot be found directly, but from lower speeds; with
/// too small a miss asked for, not quite. The study says how far it came, and keeps that orbit.
TEST(PeriodicMotion, SpeedsAreReachedFromLowerOnes) {
  const Mechanism bar = turcic_midha_four_bar();
  PeriodicMotionStudy study = turning(300.0, 3e-4);
  study.tolerance = 1e-5;
  study.most_turns = 5;
  study.miss = 1e-7;
  const PeriodicMotion orbit = find(bar, study);
  ASSERT_GT(orbit.speeds.size(), 2u);
  EXPECT_FALSE(orbit.speeds.front().found);
  EXPECT_EQ(orbit.speed, study.speed);

  study.slower_first = false;
  const PeriodicMotion direct = find_periodic_motion(bar, study, exact_modes(2));
  EXPECT_EQ(direct.termination.status, Status::stopped);
  EXPECT_EQ(direct.speed, 0.0);
  EXPECT_TRUE(direct.moments.empty());

  study.slower_first = true;
  study.speed *= 2.0;
  const PeriodicMotion part = find_periodic_motion(bar, study, exact_modes(2));
  EXPECT_EQ(part.termination.status, Status::stopped);
  EXPECT_NE(part.termination.reason.find("it was found"), std::string::npos);
  EXPECT_GT(part.speed, 0.2 * study.speed);
  EXPECT_LT(part.speed, study.speed);
  EXPECT_EQ(part.moments.size(), 13u);
}

std::string refusal(const PeriodicMotionStudy& study) {
  const PeriodicMotion motion =
      find_periodic_motion(turcic_midha_four_bar(), study, exact_modes(2));
  EXPECT_EQ(motion.termination.status, Status::stopped);
  EXPECT_EQ(motion.turns, 0);
  return motion.termination.reason;
}

TEST(PeriodicMotion, WhatDoesNotRepeatIsRefused) {
  PeriodicMotionStudy study = turning(300.0, 1e-4);
  study.damping.modal = 0.02;
  EXPECT_NE(refusal(study).find("modal damping"), std::string::npos);
  study = turning(0.0, 1e-4);
  EXPECT_NE(refusal(study).find("speed"), std::string::npos);
  study = turning(300.0, 1e-4);
  study.driver = 1;
  EXPECT_NE(refusal(study).find("driver"), std::string::npos);
  study = turning(300.0, 1e-4);
  study.loads = {turcic_midha_four_bar().load("A", {1.0, 0.0})};
  study.loads[0].history = HarmonicHistory{1.5 * study.speed, 0.0};
  EXPECT_NE(refusal(study).find("1.5 waves"), std::string::npos);
}

TEST(PeriodicMotion, HistoriesHaveToRepeat) {
  const double period = 0.2;
  EXPECT_EQ(break_of_period(StepHistory{0.0}, period), "");
  EXPECT_NE(break_of_period(StepHistory{0.1}, period), "");
  EXPECT_NE(break_of_period(RampHistory{0.05, 0.1, false}, period), "");
  EXPECT_EQ(break_of_period(RampHistory{-0.1, 0.0, false}, period), "");
  EXPECT_EQ(break_of_period(HalfSineHistory{0.05, 0.1}, period), "");
  EXPECT_NE(break_of_period(HalfSineHistory{0.15, 0.1}, period), "");
  EXPECT_EQ(break_of_period(HarmonicHistory{30.0 * pi, 0.4}, period), "");
  EXPECT_NE(break_of_period(HarmonicHistory{35.0 * pi, 0.4}, period), "");
  EXPECT_NE(break_of_period(LinearHistory{}, period), "");
  EXPECT_EQ(break_of_period(TableHistory({0.0, 0.1, 0.2}, {1.0, 3.0, 1.0}, false), period), "");
  EXPECT_NE(break_of_period(TableHistory({0.0, 0.1, 0.2}, {1.0, 3.0, 2.0}, false), period), "");
  EXPECT_NE(break_of_period(TableHistory({0.0, 0.1}, {1.0, 1.0}, false), period), "");
  const auto wave = [](double t) { return std::exp(std::sin(10.0 * pi * t)); };
  EXPECT_EQ(break_of_period(FunctionHistory{wave}, period), "");
  EXPECT_NE(break_of_period(FunctionHistory{[](double t) { return t * t; }}, period), "");
}

}  // namespace
}  // namespace flexura::testing

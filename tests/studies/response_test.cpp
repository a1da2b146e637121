// Steady vibration: against closed forms, against statics, and against motion in time.
#include "flexura/studies/response_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/studies/harmonic_motion.hpp"
#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/motion_start.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/tracing.hpp"

namespace flexura::testing {
namespace {

using Complex = std::complex<double>;

ResponseStudy sweep(const std::vector<Load>& loads, double from, double to, int count) {
  ResponseStudy study;
  study.loads = loads;
  study.from = from;
  study.to = to;
  study.count = count;
  study.logarithmic = false;
  return study;
}

ModelingResponse respond(const Model& model, const ResponseStudy& study,
                         const ModelingSettings& settings) {
  ModelingResponse response = run_response(model, study, settings, {});
  EXPECT_TRUE(response.termination.converged()) << response.termination.reason;
  EXPECT_EQ(response.states.size(), static_cast<std::size_t>(study.count));
  return response;
}

Complex amplitude(const Model& model, const ModelingResponse& response, std::size_t state,
                  const std::string& place) {
  const std::vector<std::string> places = response_places(model);
  const auto at = std::find(places.begin(), places.end(), place);
  EXPECT_NE(at, places.end()) << place;
  if (response.states.size() <= state || at == places.end()) return {};
  return response.states[state].amplitudes[static_cast<std::size_t>(at - places.begin())];
}

/// A mass that slides along x, on a spring.
struct Oscillator {
  static constexpr double mass = 3.0, stiffness = 48.0, damper = 0.7;
  Mechanism model;
  double w0 = std::sqrt(stiffness / mass);

  explicit Oscillator(double damping) {
    model.fixed("wall").centre({-1.0, 0.0}).body("mass").mass(mass, 1.0).free();
    model.slide("wall", "mass", {1.0, 0.0}).spring("wall", "mass", stiffness, damping);
  }
  /// Of x, under a force of 2, with a force `loss` against the velocity.
  static Complex closed_form(double w, double loss) {
    return 2.0 / Complex(stiffness - mass * w * w, loss * w);
  }
};

struct OscillatorDamping {
  std::string name;
  double damper = 0.0;
  DampingSettings damping;
  double loss = 0.0;
};
class OscillatorResponse : public ::testing::TestWithParam<OscillatorDamping> {};

TEST_P(OscillatorResponse, MagnitudeAndPhase) {
  const Oscillator oscillator(GetParam().damper);
  ResponseStudy study = sweep({oscillator.model.load("mass", {2.0, 0.0})}, 0.0, 8.0, 81);
  study.damping = GetParam().damping;
  const ModelingResponse response = respond(oscillator.model, study, exact());
  for (std::size_t k = 0; k < response.states.size(); ++k) {  // among them the resonance at 4
    const double w = 0.1 * static_cast<double>(k);
    const Complex truth = Oscillator::closed_form(w, GetParam().loss);
    const Complex found = amplitude(oscillator.model, response, k, "mass.x");
    EXPECT_NEAR(std::abs(found) / std::abs(truth), 1.0, 1e-11) << w;
    EXPECT_NEAR(std::arg(found), std::arg(truth), 1e-11) << w;
    EXPECT_LE(std::arg(found), 1e-15) << "behind the load, at " << w;
  }
}

constexpr double critical = 2.0 * 4.0 * Oscillator::mass;
INSTANTIATE_TEST_SUITE_P(
    Dampings, OscillatorResponse,
    ::testing::Values(
        OscillatorDamping{"damper", 0.7, {}, 0.7},
        OscillatorDamping{"mass", 0.0, {0.0, 0.2, 0.0}, 0.2 * Oscillator::mass},
        OscillatorDamping{"modal", 0.0, {0.03, 0.0, 0.0}, 0.03 * critical},
        OscillatorDamping{
            "modal_and_mass", 0.0, {0.03, 0.2, 0.0}, 0.03 * critical + 0.2 * Oscillator::mass},
        OscillatorDamping{"modal_and_damper", 0.7, {0.03, 0.0, 0.0}, 0.03 * critical + 0.7}),
    [](const auto& tested) { return tested.param.name; });

TEST(Response, AnUndampedResonanceStopsWithItsFrequency) {
  const Oscillator oscillator(0.0);
  const ResponseStudy study = sweep({oscillator.model.load("mass", {2.0, 0.0})}, 0.0, 8.0, 3);
  const ModelingResponse response = run_response(oscillator.model, study, exact(), {});
  EXPECT_FALSE(response.termination.converged());
  EXPECT_NE(response.termination.reason.find("frequency 4"), std::string::npos)
      << response.termination.reason;
}

/// N, mm, s and t: steel.
Mechanism heavy_stage() {
  Mechanism stage = parallelogram();
  stage.density(7.85e-9).mass(1e-4, 0.02);
  return stage;
}

TEST(Response, SlowlyItIsTheStaticOne) {
  const Mechanism stage = heavy_stage();
  const std::vector<Load> loads = {stage.load("stage.P", {0.3, 1.0}, 2.0)};
  for (const ModelingSettings& settings : {linear(), linear_beam(8)}) {
    Pose still = final_pose(stage, loads, settings, stage.index("stage"));
    still.position = still.position - Vec2{50.0, 15.0};  // from where it is drawn
    for (const double w : {0.0, 1e-3}) {
      const ModelingResponse slow = respond(stage, sweep(loads, w, 1.0 + w, 2), settings);
      EXPECT_NEAR(amplitude(stage, slow, 0, "stage.x").real() / still.position.x, 1.0, 1e-8);
      EXPECT_NEAR(amplitude(stage, slow, 0, "stage.y").real() / still.position.y, 1.0, 1e-8);
      EXPECT_NEAR(amplitude(stage, slow, 0, "stage.rotation").real() / still.rotation, 1.0, 1e-8);
    }
  }
}

/// The slope of a path at one of its states, from paths to a little more and a little less.
TEST(Response, SlowlyItIsTheSlopeOfThePathThatItIsAbout) {
  const Mechanism stage = heavy_stage();
  const std::vector<Load> loads = {stage.load("stage", {-20.0, 15.0})};
  Model model = stage;
  PathStudy push;
  push.loads = loads;
  push.steps = 4;
  model.studies.push_back({"push", push, {}});
  ResponseStudy study = sweep({stage.load("stage", {0.0, 1.0})}, 0.0, 1.0, 2);
  study.about = StudyState{0, 1.0};
  const ModelingSettings settings = exact_modes(6);
  const ModelingResponse slow = respond(model, study, settings);
  constexpr double step = 1e-3;
  Pose at[2];
  for (int side = 0; side < 2; ++side) {
    const double more = side == 0 ? -step : step;
    at[side] = final_pose(stage, {stage.load("stage", {-20.0, 15.0 + more})}, settings,
                          stage.index("stage"), 4);
  }
  const Vec2 slope = (0.5 / step) * (at[1].position - at[0].position);
  EXPECT_NEAR(amplitude(model, slow, 0, "stage.x").real() / slope.x, 1.0, 1e-6);
  EXPECT_NEAR(amplitude(model, slow, 0, "stage.y").real() / slope.y, 1.0, 1e-6);
}

TEST(Response, AboutAnUnstableStateItSaysSo) {
  Mechanism column;
  column.material(70e3, 0.3).density(2.7e-9).section(RectangleSection{1.0, 8.0});
  column.fixed("ground").body("top").mass(5e-6);
  column.flexure("ground", "top", LineAxis{{0.0, 0.0}, {0.0, 200.0}});
  Model model = column;
  PathStudy push;
  push.loads = {column.load("top", {0.0, -1.0})};
  for (const double share : {0.5, 2.0}) {
    const double euler = M_PI * M_PI * 70e3 * 8.0 / 12.0 / (4.0 * 200.0 * 200.0);
    push.loads[0].force.y = -share * euler;
    model.studies = {{"push", push, {}}};
    ResponseStudy study = sweep({column.load("top", {1.0, 0.0})}, 1.0, 2.0, 2);
    study.about = StudyState{0, 1.0};
    const std::string reason = respond(model, study, exact_modes(4)).termination.reason;
    EXPECT_EQ(reason.empty(), share < 1.0) << reason;
  }
}

struct TimedCase {
  std::string name;
  DampingSettings damping;
  std::optional<StudyState> about;
};
class ResponseInTime : public ::testing::TestWithParam<TimedCase> {};

/// A transient under the same load, when what its start set off has died out.
TEST_P(ResponseInTime, IsWhatATransientSettlesTo) {
  Mechanism stage = heavy_stage();
  Model model = stage;
  PathStudy push;
  push.loads = {stage.load("stage", {-20.0, 15.0})};
  push.steps = 4;
  model.studies.push_back({"push", push, {}});
  const ModelingSettings settings = exact_modes(3);
  const double w0 = run_modes(stage, {}, settings, {}).modes.at(0).value;
  const double w = 0.8 * w0;
  const std::vector<Load> loads = {stage.load("stage", {0.0, 1e-3})};

  ResponseStudy study = sweep(loads, w, 2.0 * w, 2);
  study.damping = GetParam().damping;
  study.damping.mass *= w0;
  study.damping.stiffness /= w0;
  study.about = GetParam().about;
  const Complex truth = amplitude(model, respond(model, study, settings), 0, "stage.y");

  constexpr int periods = 14, per_period = 16;
  const double period = 2.0 * std::numbers::pi / w;
  TransientStudy motion = transient(periods * period, periods * per_period, 1e-9);
  motion.damping = study.damping;
  motion.loads = loads;  // as the cosine
  motion.loads[0].history = HarmonicHistory{w, 0.5 * std::numbers::pi};
  if (study.about) {
    motion.from = study.about;
    motion.loads.push_back(push.loads[0]);
  }
  const ModelingMotion found = move(model, motion, settings);
  ASSERT_EQ(found.states.size(), static_cast<std::size_t>(periods * per_period + 1));
  Complex sum;
  for (std::size_t k = (periods - 1) * per_period; k < periods * per_period; ++k)
    sum += pose_at(stage, found.states[k], "stage").position.y *
           std::polar(2.0 / per_period, -w * found.states[k].time);
  EXPECT_LT(std::abs(sum / truth - 1.0), 2e-5) << sum << " " << truth;
}

INSTANTIATE_TEST_SUITE_P(
    Dampings, ResponseInTime,
    ::testing::Values(TimedCase{"mass", {0.0, 0.4, 0.0}, {}},
                      TimedCase{"both", {0.0, 0.2, 0.2}, {}},
                      TimedCase{"modal", {0.2, 0.0, 0.0}, {}},
                      TimedCase{"about_a_state", {0.0, 0.0, 0.4}, StudyState{0, 1.0}}),
    [](const auto& tested) { return tested.param.name; });

/// The whole matrix, modal damping written into it.
TEST(Response, ModalDampingIsThatOfTheFullMatrix) {
  const Mechanism stage = heavy_stage();
  constexpr double share = 0.02;
  MotionStart start = drawn_start(stage, beam(4, 2), {});
  MotionSystem& system = *start.system;
  const Eigen::Index n = system.coordinates(), m = system.multipliers();
  const Vibrations modes = find_vibrations(system, start.moment, 200, ModesStudy::Solver::dense);
  Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(n, 1.0, 0.3);
  for (const double stiffness_damping : {0.0, 2e-5}) {
    system.set_rayleigh_damping(3.0, stiffness_damping);
    HarmonicMotion harmonic(system, start.moment, share);
    Eigen::MatrixXd stiffness, mass;
    system.dense(stiffness, mass);
    const Eigen::VectorXd losses = 2.0 * share * modes.squares.cwiseSqrt();
    const Eigen::MatrixXd momenta = mass * modes.shapes;
    Eigen::MatrixXd damping = momenta * losses.asDiagonal() * momenta.transpose() + 3.0 * mass;
    // without springs and loads elastic forces are all there is
    damping += stiffness_damping * stiffness.topLeftCorner(n, n);
    const double first = std::sqrt(modes.squares[0]);
    for (const double w : {0.0, 0.3 * first, first, std::sqrt(modes.squares[3]), 1e3 * first}) {
      // stretching is so much stiffer than bending that doubles lose half their digits
      using Long = std::complex<long double>;
      Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic> whole = stiffness.cast<Long>();
      whole.topLeftCorner(n, n) +=
          Long(0.0L, w) * damping.cast<Long>() - Long(w) * Long(w) * mass.cast<Long>();
      Eigen::Vector<Long, Eigen::Dynamic> rhs = Eigen::Vector<Long, Eigen::Dynamic>::Zero(n + m);
      rhs.head(n) = load.cast<Long>();
      const Eigen::VectorXcd truth =
          whole.partialPivLu().solve(rhs).head(n).template cast<Complex>();
      const Eigen::VectorXcd found = harmonic.solve(load, w);
      ASSERT_EQ(found.size(), n);
      EXPECT_LT((found - truth).norm(), 1e-7 * truth.norm()) << w << " " << stiffness_damping;
    }
  }
}

}  // namespace
}  // namespace flexura::testing

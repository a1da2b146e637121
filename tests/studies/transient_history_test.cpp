// A mass on a spring under every kind of history, against the closed form.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "flexura/io/model_reader.hpp"
#include "tests/io/model_text.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mass = 3.0, stiffness = 48.0, force = 6.0, rest = force / stiffness;
const double own = std::sqrt(stiffness / mass);

Mechanism cart() {
  Mechanism oscillator;
  oscillator.fixed("ground").centre({0.0, 0.0}).body("mass").mass(mass).centre({1.0, 0.0});
  oscillator.slide("ground", "mass", {1.0, 0.0}).spring("ground", "mass", stiffness);
  return oscillator;
}

/// How it moves under a force of which F(t)/k is `p` plus `slope` times the time since, from there.
struct Motion {
  double x = 0.0, v = 0.0;

  Motion after(double t, double p, double slope) const {
    const double c = std::cos(own * t), s = std::sin(own * t);
    return {p + slope * t + (x - p) * c + (v - slope) / own * s,
            slope - own * (x - p) * s + (v - slope) * c};
  }
};

/// Under straight lines between the rows of a table, of F/k.
double along_table(const std::vector<double>& times, const std::vector<double>& values, double t) {
  Motion motion;
  for (std::size_t k = 0; k + 1 < times.size() && times[k] < t; ++k) {
    const double slope = (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    motion = motion.after(std::min(t, times[k + 1]) - times[k], values[k], slope);
  }
  return motion.x;
}

/// sin(w t) for F/k: x = (sin w t - r sin n t)/(1 - r^2), r = w/n.
Motion under_sine(double w, double t) {
  const double r = w / own;
  return {(std::sin(w * t) - r * std::sin(own * t)) / (1.0 - r * r),
          (w * std::cos(w * t) - w * std::cos(own * t)) / (1.0 - r * r)};
}

/// The largest distance from a place by time, in rest displacements.
template <class Truth>
double error_under(const TimeHistory& history, const Truth& truth, TransientStudy study) {
  const Mechanism oscillator = cart();
  study.loads = {oscillator.load("mass", {force, 0.0})};
  study.loads[0].history = history;
  const ModelingMotion motion = move(oscillator, study, exact());
  double worst = 0.0;
  for (const MotionState& state : motion.states)
    worst = std::max(worst, std::abs((pose_at(oscillator, state, "mass").position.x - 1.0) / rest -
                                     truth(state.time)));
  return worst;
}

template <class Truth>
void expect_motion(const TimeHistory& history, const Truth& truth, double tolerance = 1e-9) {
  using Method = TransientStudy::Method;
  const double by_tolerance = error_under(history, truth, transient(4.0, 37, 1e-10));
  const double by_steps =
      error_under(history, truth, in_steps(transient(4.0, 37, 1e-6), Method::radau, 0.02));
  const double by_midpoints = error_under(
      history, truth, in_steps(transient(4.0, 37, 1e-6), Method::energy_momentum, 1e-3));
  note_measured("by_tolerance", by_tolerance);
  note_measured("by_steps", by_steps);
  note_measured("by_midpoints", by_midpoints);
  EXPECT_LT(by_tolerance, tolerance);
  EXPECT_LT(by_steps, std::max(tolerance, 1e-7));
  EXPECT_LT(by_midpoints, std::max(tolerance, 5e-5));
}

TEST(TransientHistory, HalfASine) {
  constexpr double start = 0.3, duration = 0.8, w = pi / duration;
  expect_motion(HalfSineHistory{start, duration}, [](double t) {
    if (t < start) return 0.0;
    if (t < start + duration) return under_sine(w, t - start).x;
    return under_sine(w, duration).after(t - start - duration, 0.0, 0.0).x;
  });
}

TEST(TransientHistory, StepsRampsAndASine) {
  expect_motion(StepHistory{0.7},
                [](double t) { return t < 0.7 ? 0.0 : Motion{}.after(t - 0.7, 1.0, 0.0).x; });
  expect_motion(RampHistory{0.25, 1.5, false}, [](double t) {
    return along_table({0, 0.25, 1.5, 4}, {0, 0, 1, 1}, t);
  });
  expect_motion(HarmonicHistory{3.0, 0.0}, [](double t) { return under_sine(3.0, t).x; });
  expect_motion(LinearHistory{}, [](double t) { return Motion{}.after(t, 0.0, 1.0).x; });
  expect_motion(FunctionHistory{[](double t) { return std::sin(3.0 * t); }},
                [](double t) { return under_sine(3.0, t).x; });
}

const std::vector<double> times = {0.0, 0.35, 0.5, 1.3, 2.0, 4.0};
const std::vector<double> values = {0.0, 1.5, -0.5, 2.0, 0.0, 0.5};

TEST(TransientHistory, Table) {
  expect_motion(TableHistory{times, values, false},
                [](double t) { return along_table(times, values, t); });
}

/// A spline through sines is one to the fourth power of the distance between its rows.
TEST(TransientHistory, SmoothTable) {
  std::vector<double> rows, sines;
  for (int k = 0; k <= 200; ++k) {
    rows.push_back(0.02 * pi / 3.0 * k);  // ends where a natural spline does: without curvature
    sines.push_back(std::sin(3.0 * rows.back()));
  }
  expect_motion(
      TableHistory{rows, sines, true}, [](double t) { return under_sine(3.0, t).x; }, 1e-6);
}

/// The table once more, from a file beside the model; lengths are mm, and the mass has its grams.
TEST(TransientHistory, File) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / "flexura_transient_history";
  fs::create_directories(folder);
  std::ofstream csv(folder / "pulse.csv");
  csv << "note,t,share\n";
  for (std::size_t k = 0; k < times.size(); ++k)
    csv << "x," << times[k] << "," << values[k] << "\n";
  csv.close();
  std::ofstream(folder / "cart.toml")
      << "flexura = 1\n[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"s\"\n"
         "[bodies.ground]\nfixed = true\ncentre = [0, 0]\n"
         "[bodies.mass]\nmass = \"3 kg\"\ncentre = [1000, 0]\n"
         "[joints.rail]\nprismatic = { bodies = [\"ground\", \"mass\"], direction = [1, 0] }\n"
         "[springs.s]\nbetween = [\"ground\", \"mass\"]\nstiffness = \"48 N/m\"\n"
         "[studies.shake]\nkind = \"transient\"\nduration = 4\noutputs = 37\ntolerance = 1e-10\n"
         "loads = [{ on = \"mass\", force = [6, 0], history = { file = \"pulse.csv\", time = "
         "\"t\", "
         "value = \"share\" } }]\nmodelings = [\"exact\"]\n";
  const ModelReading reading = read_model(folder / "cart.toml");
  fs::remove_all(folder);
  ASSERT_TRUE(reading.model.has_value()) << messages(reading.diagnostics);
  const auto& study = std::get<TransientStudy>(reading.model->studies.at(0).kind);
  const ModelingMotion motion = move(*reading.model, study, study.modelings.at(0));
  ASSERT_EQ(motion.states.size(), 38u);
  double worst = 0.0;
  for (const MotionState& state : motion.states)
    worst = std::max(worst, std::abs((state.state.bodies[0].position.x - 1000.0) / (1e3 * rest) -
                                     along_table(times, values, state.time)));
  note_measured("error", worst);
  EXPECT_LT(worst, 1e-7);
}

}  // namespace
}  // namespace flexura::testing

#include "tests/report/sample_motion.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tests/report/sample_linkage.hpp"

namespace flexura::sample {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double duration = 1.0;
constexpr double speed = 3.2 * full_turn;
constexpr double leaf_frequency = 17.0;  // cycles per time
constexpr double rod_frequency = 41.3;

struct SampleModeling {
  const char* label;
  const char* modeling;
  double pace;  ///< of vibrations, against the exact ones
  int axis_points;
  int unknowns;
  double seconds;
};

constexpr SampleModeling modelings[] = {
    {"prbm", "prbm", 1.03, 5, 9, 0.021},
    {"scmbm", "scmbm", 1.015, 25, 9, 0.017},
    {"exact", "exact", 1.0, 41, 9, 0.083},
    {"fine", "beam", 0.9995, 41, 198, 1.72},
};
constexpr std::size_t reference = 2;

/// The leaf is shaken by the piston and rings down; the rod sings.
LinkagePose pose_at(const SampleModeling& modeling, double time) {
  const double fade = std::exp(-1.6 * time);
  LinkagePose pose;
  pose.turn = speed * time;
  pose.bow = 1.1 * (1.0 - fade) * std::sin(full_turn * rod_frequency * modeling.pace * time);
  pose.bend = 2.5 * (1.0 - std::cos(pose.turn)) +
              4.0 * fade * std::sin(full_turn * leaf_frequency * modeling.pace * time);
  return pose;
}

double rate(const SampleModeling& modeling, double time, double LinkagePose::*part) {
  constexpr double h = 1e-6;
  return (pose_at(modeling, time + h).*part - pose_at(modeling, time - h).*part) / (2.0 * h);
}

EnergyBalance energy_at(const SampleModeling& modeling, double time) {
  const LinkagePose pose = pose_at(modeling, time);
  const auto square = [](double v) { return v * v; };
  EnergyBalance e;
  e.kinetic = 40.0 + 2e-4 * square(rate(modeling, time, &LinkagePose::bend)) +
              1e-4 * square(rate(modeling, time, &LinkagePose::bow));
  e.strain = 2.2 * square(pose.bend) + 3.0 * square(pose.bow);
  e.dissipated = 18.0 * (1.0 - std::exp(-3.2 * time));
  e.error = 2e-6 * std::sin(9.0 * time) * modeling.pace;
  e.work = e.kinetic + e.strain + e.dissipated - e.error - 40.0;
  e.momentum = {3e-3 * std::cos(pose.turn), 1e-3 * std::sin(pose.turn)};
  e.angular_momentum = 0.2 + 0.01 * std::sin(pose.turn);
  e.drift = 3e-13 * time;
  return e;
}

/// How far the point P comes from where the reference puts it, of how far it moves.
double difference(const ModelingMotion& motion, const ModelingMotion& from) {
  double largest = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < std::min(motion.states.size(), from.states.size()); ++i) {
    const Vec2 place = from.states[i].state.points[0];
    largest = std::max(largest, norm(motion.states[i].state.points[0] - place));
    scale = std::max(scale, norm(place - from.states[0].state.points[0]));
  }
  return largest / scale;
}

ModelingMotion run(const SampleModeling& modeling, int outputs, int last_output) {
  ModelingMotion motion;
  motion.label = modeling.label;
  motion.modeling = modeling.modeling;
  motion.termination.status = Status::converged;
  motion.unknowns = modeling.unknowns;
  motion.seconds = modeling.seconds;
  for (int k = 0; k <= last_output; ++k) {
    MotionState moment;
    moment.time = duration * k / outputs;
    moment.state = make_linkage_state(pose_at(modeling, moment.time), modeling.axis_points);
    moment.state.reactions = {
        {{0.3 * std::sin(speed * moment.time), 0.0}, 12.0 * std::cos(speed * moment.time)}};
    moment.energy = energy_at(modeling, moment.time);
    motion.states.push_back(std::move(moment));
  }
  const MotionState& last = motion.states.back();
  motion.members = make_linkage_members(pose_at(modeling, last.time), last.state);
  motion.steps = 640;
  motion.rejected = 3;
  motion.iterations = 1873;
  motion.smallest_step = 2.1e-4;
  motion.largest_step = 3.4e-3;
  motion.energy_error = 3.3e-8;
  motion.error_estimate = 4.6e-6;
  return motion;
}

MotionResult make_motion(int outputs) {
  MotionResult result;
  result.bodies = {"crank", "piston", "tip"};
  result.points = {"tip.P"};
  result.flexures = {"rod", "leaf"};
  result.strengths = {{}, 50.0};
  result.held = {{"crank", 0, {}}};
  result.method = "radau";
  result.damping = "2 % of critical in every mode about the start";
  for (const SampleModeling& modeling : modelings)
    result.modelings.push_back(run(modeling, outputs, outputs));
  ModelingMotion& stopped = result.modelings[1];
  stopped.states.resize(static_cast<std::size_t>(0.62 * outputs) + 1);
  stopped.termination = {Status::stopped,
                         "The step shrank below 1e-9 of the duration at 0.62 s: the mechanism may "
                         "snap there. Try a looser tolerance, or damping."};
  result.reference = reference;
  for (ModelingMotion& motion : result.modelings)
    if (&motion != &result.modelings[reference])
      motion.difference = difference(motion, result.modelings[reference]);
  return result;
}

/// The change from one pose to another that is close, blown up to a largest displacement of 1.
Mode make_mode(const LinkagePose& from, const LinkagePose& to, double value) {
  const PathState a = make_linkage_state(from, 21);
  const PathState b = make_linkage_state(to, 21);
  double largest = 0.0;
  for (std::size_t f = 0; f < a.axes.size(); ++f)
    for (std::size_t k = 0; k < a.axes[f].size(); ++k)
      largest = std::max(largest, norm(b.axes[f][k] - a.axes[f][k]));
  const double scale = 1.0 / largest;
  const auto moved = [&](const Pose& p, const Pose& q) {
    return Pose{scale * (q.position - p.position), scale * (q.rotation - p.rotation)};
  };
  Mode mode;
  mode.value = value;
  mode.bodies = a.bodies;
  mode.axes = a.axes;
  mode.shape.axes = a.axes;
  for (std::size_t i = 0; i < a.bodies.size(); ++i)
    mode.shape.bodies.push_back(moved(a.bodies[i], b.bodies[i]));
  for (std::size_t i = 0; i < a.mids.size(); ++i)
    mode.shape.mids.push_back(moved(a.mids[i], b.mids[i]));
  mode.shape.points = {scale * (b.points[0] - a.points[0])};
  for (std::size_t f = 0; f < a.axes.size(); ++f)
    for (std::size_t k = 0; k < a.axes[f].size(); ++k)
      mode.shape.axes[f][k] = scale * (b.axes[f][k] - a.axes[f][k]);
  return mode;
}

/// Angular frequencies under a share of the load: the first one falls, and turns unstable.
std::vector<double> frequencies_at(double load_factor, double pace) {
  const double square = 1.0 - 1.3 * load_factor;
  const double first = full_turn * leaf_frequency * pace * std::sqrt(std::abs(square));
  return {square < 0.0 ? -first : first,
          full_turn * rod_frequency * pace * (1.0 - 0.1 * load_factor),
          full_turn * 66.0 * pace * (1.0 + 0.05 * load_factor)};
}

ModeResult make_modes() {
  ModeResult result;
  result.bodies = {"crank", "piston", "tip"};
  result.points = {"tip.P"};
  result.flexures = {"rod", "leaf"};
  for (const SampleModeling& modeling : modelings) {
    if (modeling.label == std::string("scmbm")) continue;
    ModelingModes modes;
    modes.label = modeling.label;
    modes.modeling = modeling.modeling;
    modes.termination.status = Status::converged;
    modes.unknowns = modeling.unknowns;
    modes.seconds = 0.1 * modeling.seconds;
    const std::vector<double> values = frequencies_at(1.0, modeling.pace);
    modes.modes = {make_mode({}, {0.0, 0.0, 0.01}, values[0]),
                   make_mode({}, {0.0, 0.01, 0.0}, values[1]),
                   make_mode({}, {0.002, 0.01, -0.02}, values[2])};
    for (int k = 0; k <= 10; ++k)
      modes.curve.push_back({0.1 * k, frequencies_at(0.1 * k, modeling.pace)});
    modes.error_estimate = 2e-7;
    if (modeling.modeling != std::string("exact")) modes.difference = modeling.pace - 1.0;
    result.modelings.push_back(std::move(modes));
  }
  result.reference = 1;
  return result;
}

/// Two modes, each damped by 2 %, seen at places that take part in them unequally.
std::complex<double> amplitude_at(double w, double pace, std::size_t place) {
  const double natural[] = {full_turn * leaf_frequency * pace, full_turn * rod_frequency * pace};
  std::complex<double> sum = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double part = (k == 0 ? 1.0 : 0.35) * (1.0 + 0.3 * static_cast<double>(place % 4)) *
                        (place % 3 == 2 ? 0.02 : 900.0);
    const std::complex<double> stiffness(natural[k] * natural[k] - w * w, 0.04 * natural[k] * w);
    sum += part / stiffness;
  }
  return sum;
}

/// Over frequencies that grow by equal factors or, as a sensor would see it that reports late, by
/// equal steps from 0.
ResponseResult make_response(bool late) {
  constexpr int count = 300;
  ResponseResult result;
  result.places = {"crank.x",      "crank.y",         "crank.rotation", "piston.x",
                   "piston.y",     "piston.rotation", "tip.x",          "tip.y",
                   "tip.rotation", "tip.P.x",         "tip.P.y"};
  result.damping = "2 % of critical in every mode";
  for (const SampleModeling& modeling : modelings) {
    if (modeling.label == std::string("scmbm")) continue;
    ModelingResponse response;
    response.label = modeling.label;
    response.modeling = modeling.modeling;
    response.termination.status = Status::converged;
    response.unknowns = modeling.unknowns;
    response.seconds = 0.2 * modeling.seconds;
    response.error_estimate = 1.5e-6;
    if (modeling.modeling != std::string("exact")) response.difference = 1.1 * modeling.pace - 1.0;
    for (int k = 0; k < count; ++k) {
      ResponseState state;
      const double share = k / (count - 1.0);
      state.angular_frequency = full_turn * (late ? 80.0 * share : std::pow(10.0, 2.0 * share));
      const std::complex<double> turn =
          std::polar(1.0, late ? -0.02 * state.angular_frequency : 0.0);
      for (std::size_t p = 0; p < result.places.size(); ++p)
        // The piston keeps to its guide.
        state.amplitudes.push_back(
            p == 4 || p == 5 ? 0.0
                             : turn * amplitude_at(state.angular_frequency, modeling.pace, p));
      response.states.push_back(std::move(state));
    }
    result.modelings.push_back(std::move(response));
  }
  result.reference = 1;
  return result;
}

StudyResult study(const char* name, const char* kind) {
  StudyResult result;
  result.name = name;
  result.kind = kind;
  result.termination.status = Status::converged;
  result.loads = {{"tip.P", {0.4, 0.0}, 0.0}};
  return result;
}

}  // namespace

Result make_sample_motion(int outputs) {
  Result result;
  result.title = "A crank, an elastic rod & a leaf on a piston";
  result.model_file = "linkage.toml";
  result.version = "0.1.0";
  result.length_unit = "mm";
  result.force_unit = "N";
  result.time_unit = "s";
  result.drawing = make_linkage_drawing();

  result.studies.push_back(study("sing", "modes"));
  result.studies.back().content = make_modes();

  StudyResult turn = study("turn", "transient");
  turn.termination = {Status::stopped, "scmbm stopped early"};
  turn.loads[0].history = {"a half-sine from 0.1 s that lasts 0.05 s", 0.25, {0.0, 0.5, 0.0}};
  turn.fields.gravity = {0.0, -9810.0};
  turn.fields.constant = true;
  turn.content = make_motion(outputs);
  result.studies.push_back(std::move(turn));

  result.studies.push_back(study("shake", "response"));
  result.studies.back().content = make_response(false);
  result.studies.push_back(study("sweep", "response"));
  result.studies.back().content = make_response(true);
  return result;
}

}  // namespace flexura::sample

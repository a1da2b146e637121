#include "tests/report/sample_result.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/report/sample_chain.hpp"
#include "tests/report/sample_ellipse.hpp"
#include "tests/report/sample_field.hpp"

namespace flexura::sample {
namespace {

constexpr int load_steps = 20;

struct SampleModeling {
  const char* label;
  const char* modeling;
  std::size_t joints;
  double stiffness;
  int unknowns;
  double seconds;
};

constexpr SampleModeling modelings[] = {
    {"linear", "linear", 48, 1.0, 9, 21.4e-6},
    {"scmbm", "scmbm", 6, 0.96, 9, 183.0e-6},
    {"prbm", "prbm", 3, 1.0, 9, 96.0e-6},
    {"exact", "exact", 48, 1.0, 9, 0.47e-3},
    {"continuum", "continuum", 48, 1.0002, 67202, 131.6},
};

ModelingPath run(const SampleModeling& modeling, const TipLoad& full, int last_step) {
  const Chain chain = make_chain(modeling.joints, modeling.stiffness);
  const bool linear = modeling.modeling == std::string("linear");
  ModelingPath path;
  path.label = modeling.label;
  path.modeling = modeling.modeling;
  path.termination.status = Status::converged;
  path.unknowns = modeling.unknowns;
  path.seconds = modeling.seconds;
  std::vector<double> rotations(chain.joints.size(), 0.0);
  TipLoad load;
  for (int step = 0; step <= last_step; ++step) {
    const double factor = static_cast<double>(step) / load_steps;
    load = {factor * full.force, factor * full.moment};
    rotations = linear ? solve_linear(chain, load) : solve_chain(chain, load, rotations);
    path.states.push_back(make_state(chain, rotations, factor, linear));
  }
  path.steps = last_step;
  path.iterations = linear ? 0 : 4 * last_step;
  path.members = make_members(path.states.back(), load);
  if (path.modeling == "exact") path.error_estimate = 3.1e-10;
  if (path.modeling == "continuum") path.error_estimate = 2.4e-5;
  return path;
}

double difference(const ModelingPath& path, const ModelingPath& reference) {
  double largest = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < std::min(path.states.size(), reference.states.size()); ++i) {
    const Vec2 place = reference.states[i].points[0];
    largest = std::max(largest, norm(path.states[i].points[0] - place));
    scale = std::max(scale, norm(place - reference.states[0].points[0]));
  }
  return largest / scale;
}

PathResult make_path(const TipLoad& load) {
  PathResult result;
  result.bodies = {"link2", "link3", "link4"};
  result.points = {"link4.E"};
  result.flexures = {"e12", "e23", "e34"};
  for (const SampleModeling& modeling : modelings) {
    result.modelings.push_back(run(modeling, load, load_steps));
  }
  result.reference = result.modelings.size() - 1;
  for (std::size_t m = 0; m < result.reference; ++m) {
    result.modelings[m].difference =
        difference(result.modelings[m], result.modelings[result.reference]);
  }
  return result;
}

/// Cuts the path of `modeling` after `last`, as a solver does that cannot go on.
void stop_after(ModelingPath& modeling, std::size_t last) {
  modeling.states.resize(last + 1);
  modeling.steps = static_cast<int>(last);
  modeling.termination = {
      Status::stopped,
      "No equilibrium was found beyond load factor 0.65 even with steps of 1e-6: the load may "
      "pass a limit point there. Try control = \"arc_length\", or a smaller load."};
  PathEvent event;
  event.kind = "stability lost";
  event.load_factor = 0.57;
  event.state = modeling.states[last - 1];
  event.state.load_factor = 0.57;
  modeling.events.push_back(event);
  modeling.states[last - 1].unstable_directions = 1;
  modeling.states[last].unstable_directions = 1;
}

StudyResult study(const char* name, const char* kind, const TipLoad& load) {
  StudyResult result;
  result.name = name;
  result.kind = kind;
  result.termination.status = Status::converged;
  result.loads = {{"link4.E", load.force, load.moment, false}};
  return result;
}

/// A stage that stiffens as it travels; one modeling knows no largest stiffness.
void add_stage(PathResult& path) {
  path.stage = "link4.E";
  path.condensed = {"link4"};
  for (ModelingPath& modeling : path.modelings) {
    for (const PathState& state : modeling.states) {
      StageState stage;
      const double k = state.load_factor;
      stage.soft = 0.01 * (1.0 + k * k);
      if (modeling.modeling != "prbm") stage.stiff = 2.0 - k;
      stage.soft_direction = 0.3 * k;
      stage.instant_centre = Vec2{4.0 + k, 2.0};
      stage.centre_drift = k;
      stage.across = 0.2 * k * k;
      stage.rotation = -0.1 * k;
      stage.geometric_advantage = 3.0 - k;
      modeling.stage.push_back(stage);
    }
    modeling.condensed = {{0.0, {1.0, 0.0, -2.0, 0.0, 3.0, 0.5, -2.0, 0.5, 40.0}}};
  }
}

StudyResult make_inverse_study() {
  const TipLoad load{{0.0, 0.0}, 0.01};
  StudyResult result = study("hold", "inverse", load);
  result.loads.clear();
  PathResult path = make_path(load);
  std::erase_if(path.modelings, [](const ModelingPath& m) { return m.modeling == "continuum"; });
  path.reference = path.modelings.size() - 1;
  // Of the last flexure nothing is stated; one modeling comes up to the strength of the others.
  path.strengths = {30.0, 30.0, {}};
  for (ModelingPath& modeling : path.modelings)
    for (PathState& state : modeling.states)
      state.peak_stresses = {(modeling.modeling == "prbm" ? 36.0 : 24.0) * state.load_factor,
                             12.0 * state.load_factor, 90.0 * state.load_factor};
  for (std::size_t b = 0; b < path.bodies.size(); ++b) path.held.push_back({path.bodies[b], b, {}});
  for (ModelingPath& modeling : path.modelings) {
    if (modeling.modeling == "exact") modeling.difference.reset();
    for (PathState& state : modeling.states) {
      const double k = state.load_factor * (modeling.modeling == "prbm" ? 1.04 : 1.0);
      const double bent = k + 0.3 * k * k;
      state.reactions = {{{2e-4 * bent, -1e-4 * k}, 1e-3 * k},
                         {{-3e-4 * k, 1.5e-4 * bent}, -4e-4 * bent},
                         {{1e-4 * k, -0.5e-4 * k}, 0.01 * k}};
    }
  }
  result.content = std::move(path);
  return result;
}

}  // namespace

Result make_sample_result() {
  Result result;
  result.title = "Open chain of three circular-arc <flexures> & \"links\" {{data}} </script>";
  result.model_file = "arc_chain.toml";
  result.version = "0.1.0";
  result.length_unit = "mm";
  result.force_unit = "N";
  result.time_unit = "s";
  const Chain chain = make_chain(48);
  result.drawing = chain.drawing;
  const DrawnBody& last = result.drawing.bodies.back();
  result.drawing.springs = {{"coil", "ground", last.name, {2.0, 14.0}, last.points.front(), false},
                            {"spiral",
                             "ground",
                             result.drawing.bodies[1].name,
                             {},
                             result.drawing.bodies[1].centre,
                             true}};

  const TipLoad push{{1e-3, 0.0}, 0.0};
  StudyResult pushed = study("push", "path", push);
  PathResult pushed_path = make_path(push);
  add_stage(pushed_path);
  add_stress_fields(pushed_path.modelings.back(), false);
  pushed.content = std::move(pushed_path);
  result.studies.push_back(std::move(pushed));

  const TipLoad lift{{-5e-4, 1.1e-3}, 0.004};
  StudyResult lifted = study("lift & turn", "path", lift);
  PathResult path = make_path(lift);
  stop_after(path.modelings[1], 13);
  add_stress_fields(path.modelings.back(), true);
  lifted.termination = {Status::stopped, "scmbm stopped at load factor 0.65"};
  lifted.content = std::move(path);
  lifted.fields = {{{1, {0.0, -1e-4}}}, {0.0, -9810.0}, 20.0, false};
  result.studies.push_back(std::move(lifted));

  result.studies.push_back(make_inverse_study());

  StudyResult linear = study("ellipses", "linear", push);
  linear.content = make_linear_result(chain, push);
  result.studies.push_back(std::move(linear));
  return result;
}

}  // namespace flexura::sample

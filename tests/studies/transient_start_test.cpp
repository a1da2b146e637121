// Where a transient sets off, and where it ends before its time.
#include <cmath>

#include "flexura/studies/path_study.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/motion.hpp"

namespace flexura::testing {
namespace {

using Method = TransientStudy::Method;

/// A rubber leaf with a weight on its end, 0.4 m long; it bends about once a second.
Mechanism weighted_leaf() {
  Mechanism leaf;
  leaf.material(5e7, 0.4).density(1000.0).section(RectangleSection{0.01, 0.02});
  leaf.fixed("ground").body("weight").mass(0.05, 1e-4);
  leaf.flexure("ground", "weight", LineAxis{{0.0, 0.0}, {0.4, 0.0}});
  return leaf;
}

PathStudy pushed(const Mechanism& leaf) {
  PathStudy path;
  path.loads = {leaf.load("weight", {0.0, 0.1})};
  path.steps = 2;
  path.modelings = {exact_modes(3)};
  return path;
}

/// Studies 0: `push`, 1: `first` and 2: `later`, which goes on from it.
struct Course {
  Mechanism leaf = weighted_leaf();
  TransientStudy first = transient(1.2, 6, 1e-9);
  TransientStudy later = transient(0.8, 4, 1e-9);

  Model model() const {
    Model model = leaf;
    model.studies.push_back({"push", pushed(leaf), {}});
    model.studies.push_back({"first", first, {}});
    model.studies.push_back({"later", later, {}});
    return model;
  }
};

/// Let go from half of the push, or hit as drawn.
Course course(bool from_path, double modal) {
  Course course;
  if (from_path) course.first.from = StudyState{0, 0.5};
  for (TransientStudy* study : {&course.first, &course.later}) {
    study->damping.modal = modal;
    if (!from_path) study->loads = {course.leaf.load("weight", {0.02, 0.05}, 0.003)};
  }
  course.later.from = StudyState{1, 1.0};
  return course;
}

/// The largest distance of the weight from where another run has it at the same outputs.
double apart(const Mechanism& leaf, const ModelingMotion& a, std::size_t skipped,
             const ModelingMotion& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < b.states.size(); ++k) {
    const Pose p = pose_at(leaf, a.states.at(k + skipped), "weight");
    const Pose q = pose_at(leaf, b.states[k], "weight");
    worst = std::max({worst, norm(p.position - q.position), std::abs(p.rotation - q.rotation)});
  }
  return worst;
}

/// Half a motion and the other half that goes on from it are the whole one, by every integrator and
/// with damping whose modes are those of where all of it began.
TEST(TransientStart, GoingOnIsTheWholeMotion) {
  for (const Method method : {Method::radau, Method::generalized_alpha, Method::energy_momentum})
    for (const bool from_path : {true, false}) {
      Course parts = course(from_path, 0.03);
      for (TransientStudy* study : {&parts.first, &parts.later}) {
        study->method = method;
        if (method != Method::radau) study->step = 1e-3;
      }
      TransientStudy whole = parts.first;
      whole.duration = 2.0;
      whole.outputs = 10;
      const Model model = parts.model();
      const ModelingSettings settings = in_theory(exact_modes(3), "i");
      const double gap =
          apart(parts.leaf, move(model, whole, settings), 6, move(model, parts.later, settings));
      const std::string what = method_name(whole).substr(0, 6) + (from_path ? "_path" : "_drawn");
      note_measured(what, gap);
      EXPECT_LT(gap, method == Method::radau ? 1e-9 : 1e-7) << what;
    }
}

/// A state of a path goes nowhere while its loads stay, and gives back its strain energy when they
/// are gone.
TEST(TransientStart, APathIsLeftAtRest) {
  Course parts = course(true, 0.0);
  const Model model = parts.model();
  parts.first.loads = {parts.leaf.load("weight", {0.0, 0.05})};
  const ModelingMotion held = move(model, parts.first, exact_modes(3));
  for (const MotionState& state : held.states) {
    const double moved = norm(pose_at(parts.leaf, state, "weight").position -
                              pose_at(parts.leaf, held.states[0], "weight").position);
    EXPECT_LT(moved, 1e-9) << state.time;
  }
  const ModelingPath path =
      run_path(model, pushed(parts.leaf), exact_modes(3), [](double) { return true; });
  EXPECT_LT(norm(path.states.at(1).bodies[0].position -
                 pose_at(parts.leaf, held.states[0], "weight").position),
            1e-9);
  parts.first.loads.clear();
  const ModelingMotion free = move(model, parts.first, exact_modes(3));
  double fastest = 0.0;
  for (const MotionState& state : free.states) fastest = std::max(fastest, state.energy.kinetic);
  EXPECT_GT(fastest, 0.5 * path.states.at(1).strain_energy);
  EXPECT_NEAR(free.states[0].energy.strain, path.states.at(1).strain_energy,
              1e-8 * path.states.at(1).strain_energy);
  EXPECT_LT(free.energy_error, 1e-6);
}

/// What goes on is damped as it says itself.
TEST(TransientStart, EveryStudyHasItsOwnDamping) {
  Course parts = course(true, 0.1);
  parts.later.damping.modal = 0.0;
  const ModelingMotion free = move(parts.model(), parts.later, exact_modes(3));
  EXPECT_EQ(free.states.back().energy.dissipated, 0.0);
  parts.first.damping.modal = 0.0;
  parts.later.damping.modal = 0.1;
  const ModelingMotion damped = move(parts.model(), parts.later, exact_modes(3));
  const EnergyBalance& end = damped.states.back().energy;
  const double start = damped.states[0].energy.kinetic + damped.states[0].energy.strain;
  EXPECT_GT(end.dissipated, 0.5 * start);
  EXPECT_LT(damped.energy_error, 1e-6);
}

/// The estimate is what a much finer run shows, whatever the start and the damping; of errors in
/// the motion before it knows nothing. Two modes are too few by a known measure.
TEST(TransientStart, ErrorsAreEstimatedFromThere) {
  for (const bool from_path : {true, false})
    for (const bool later : {true, false}) {
      const Course parts = course(from_path, 0.03);
      TransientStudy study = later ? parts.later : parts.first;
      const Model model = parts.model();
      MotionResult result;
      study.estimate = true;
      result.modelings.push_back(move(model, study, exact_modes(2)));
      study.estimate = false;
      result.modelings.push_back(move(model, study, exact_modes(10)));
      result.reference = 1;
      compare_motions(result);
      const double truth = result.modelings[0].difference.value();
      const std::string what =
          std::string(from_path ? "path" : "drawn") + (later ? "_later" : "_first");
      ASSERT_TRUE(result.modelings[0].error_estimate.has_value()) << what;
      const double estimate = *result.modelings[0].error_estimate;
      note_measured(what, estimate);
      note_measured(what + "_true", truth);
      EXPECT_LT(estimate, 2.0 * truth) << what;
      EXPECT_GT(estimate, (later ? 0.1 : 0.5) * truth) << what;
    }
}

/// What a driver carries along starts as if it were rigid, however long the study is.
TEST(TransientStart, DriversCarryAllAlongFromTheStart) {
  const double speed = 2.0;
  const double inertia = 1000.0 * 0.01 * 0.02 * 0.4 * 0.4 * 0.4 / 3.0 + 0.05 * 0.4 * 0.4 + 1e-4;
  Mechanism leaf = weighted_leaf();
  leaf.body("hub").centre({0.0, 0.0});
  leaf.flexure("hub", "weight", LineAxis{{0.0, 0.0}, {0.4, 0.0}});
  Model model = leaf.turn("hub", speed, LinearHistory{}).model();
  model.flexures.erase(model.flexures.begin());
  for (const double duration : {1e-3, 10.0}) {
    TransientStudy study = transient(duration, 2, 1e-4);
    const ModelingMotion motion =
        run_transient(model, study, in_theory(exact_modes(3), "i"), [](double) { return false; });
    ASSERT_FALSE(motion.states.empty());
    EXPECT_NEAR(motion.states[0].energy.kinetic / (0.5 * inertia * speed * speed), 1.0, 1e-9);
  }
  model.studies.push_back({"first", transient(1.0, 2, 1e-4), {}});
  TransientStudy later = transient(1.0, 2, 1e-4);
  later.from = StudyState{0, 1.0};
  const ModelingMotion motion =
      run_transient(model, later, exact_modes(3), [](double) { return true; });
  EXPECT_NE(motion.termination.reason.find("'first' has left them"), std::string::npos)
      << motion.termination.reason;
}

/// What was computed before a run is cancelled stays as it is.
TEST(TransientStart, CancellationKeepsWhatIsDone) {
  const Course parts = course(true, 0.0);
  TransientStudy study = parts.first;
  const ModelingMotion whole = move(parts.model(), study, exact_modes(3));
  study.estimate = true;
  const ModelingMotion part = run_transient(parts.model(), study, exact_modes(3),
                                            [](double done) { return done < 0.4 * 0.35; });
  EXPECT_EQ(part.termination.status, Status::stopped);
  EXPECT_NE(part.termination.reason.find("cancelled at time 0."), std::string::npos)
      << part.termination.reason;
  ASSERT_EQ(part.states.size(), 3u);  // at 0, 0.2 and 0.4 of 1.2
  EXPECT_EQ(apart(parts.leaf, whole, 0, part), 0.0);
  EXPECT_FALSE(part.error_estimate.has_value());
  EXPECT_EQ(part.members.size(), 1u);
  EXPECT_GT(part.steps, 0);
}

}  // namespace
}  // namespace flexura::testing

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "flexura/studies/linkage_methods.hpp"
#include "flexura/studies/mechanism_state.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/periodic_motion.hpp"

namespace flexura {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double shares[] = {0.25, 0.5, 0.75, 1.0};  // of the study's speed
constexpr double trusted = 0.05;                     // difference of strains

/// A history over the angle, as one over time at a speed.
TimeHistory in_time(const TimeHistory& history, double speed) {
  if (const auto* half = std::get_if<HalfSineHistory>(&history))
    return HalfSineHistory{half->start / speed, half->duration / speed};
  if (const auto* ramp = std::get_if<RampHistory>(&history))
    return RampHistory{ramp->start / speed, ramp->end / speed, ramp->smooth};
  if (const auto* step = std::get_if<StepHistory>(&history)) return StepHistory{step->at / speed};
  if (const auto* harmonic = std::get_if<HarmonicHistory>(&history))
    return HarmonicHistory{speed * harmonic->angular_frequency, harmonic->phase};
  if (const auto* table = std::get_if<TableHistory>(&history)) {
    std::vector<double> times;
    for (const double angle : table->times()) times.push_back(angle / speed);
    return TableHistory{std::move(times), table->values(), table->smooth()};
  }
  return FunctionHistory{
      [history, speed](double time) { return evaluate_history(history, speed * time).value; }};
}

class Nonlinear {
 public:
  Nonlinear(const Model& model, const LinkageStudy& study, const LinkageTurn& turn,
            const LinkageResult& result, const std::function<bool(double)>& keep_going)
      : model_(model),
        study_(study),
        turn_(turn),
        result_(result),
        keep_going_(keep_going),
        linear_(study) {
    settle_damping();
  }
  NonlinearComparison run();

 private:
  void settle_damping();
  PeriodicMotion find(double speed) const;
  FlexureCurves curves_of(std::size_t flexure, const PeriodicMotion& found) const;
  void record(const PeriodicMotion& found, LinkageMotion& motion) const;
  double difference_from_linear(const LinkageMotion& motion, double speed) const;

  const Model& model_;
  const LinkageStudy& study_;
  const LinkageTurn& turn_;
  const LinkageResult& result_;
  const std::function<bool(double)>& keep_going_;
  LinkageStudy linear_;  // with the damping of the nonlinear motion
  std::string damping_;
};

/// A share z of critical damping at the frequency w is 2 z/w times the stiffness.
void Nonlinear::settle_damping() {
  if (study_.damping.modal == 0.0) return;
  double mean = 0.0;
  for (const std::vector<double>& row : result_.frequencies) mean += row.front();
  mean /= static_cast<double>(result_.frequencies.size());
  linear_.damping = {};
  linear_.damping.stiffness = 2.0 * study_.damping.modal / mean;
  damping_ = fmt::format(
      "damped in proportion to the elastic forces ({:.3g} {}), which gives the first mode {:g} % "
      "of "
      "critical damping as the study asks for, and higher modes more",
      linear_.damping.stiffness, model_.units.time, 100.0 * study_.damping.modal);
}

PeriodicMotion Nonlinear::find(double speed) const {
  PeriodicMotionStudy study;
  study.driver = study_.driver;
  study.speed = turn_.sense() * speed;
  for (Load load : study_.loads) {
    load.history = in_time(load.history, speed);
    study.loads.push_back(std::move(load));
  }
  study.fields.gravity = study_.gravity;
  study.damping = linear_.damping;
  study.inertia.rotary = study_.rotary_inertia;
  study.outputs = study_.positions;
  ModelingSettings settings;
  settings.kind = ExactSettings{6};
  settings.axial = study_.modeling.axial;
  settings.shear = study_.modeling.shear;
  return find_periodic_motion(model_, study, settings,
                              [&] { return !keep_going_ || keep_going_(0.3); });
}

FlexureCurves Nonlinear::curves_of(std::size_t k, const PeriodicMotion& found) const {
  FlexureCurves curves;
  const Section section = section_of(model_, model_.flexures[k]);
  const double modulus = model_.materials[model_.flexures[k].material].youngs_modulus;
  const double length = AxisCurve(model_.flexures[k].axis).length();
  for (const Moment& moment : found.moments) {
    const auto sections = MovingState(*found.system, moment).sections(k);
    const SectionState& first = sections.front();
    const SectionState& last = sections.back();
    const std::size_t middle = sections.size() / 2;
    const auto fibre_stress = [&](std::size_t i) {
      const double s = length * static_cast<double>(i) / static_cast<double>(sections.size() - 1);
      const SectionProperties at = section_properties(section, s, length);
      return std::pair{-0.5 * at.depth * sections[i].bending_moment / at.second_moment,
                       sections[i].axial_force / at.area};
    };
    curves.strain.push_back(fibre_stress(middle).first / modulus);
    curves.axial_strain.push_back(fibre_stress(middle).second / modulus);
    const Vec2 chord = last.pose.position - first.pose.position;
    curves.deflection.push_back(cross(chord, sections[middle].pose.position - first.pose.position) /
                                norm(chord));
    std::vector<double> upper, lower;
    double largest = 0.0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
      const auto [bending, axial] = fibre_stress(i);
      upper.push_back(axial + bending);
      lower.push_back(axial - bending);
      largest = std::max(largest, std::abs(axial) + std::abs(bending));
    }
    curves.upper_stress.push_back(std::move(upper));
    curves.lower_stress.push_back(std::move(lower));
    curves.stress.push_back(largest);
  }
  return curves;
}

/// Displacements are from the rigid links' places at the same angle.
void Nonlinear::record(const PeriodicMotion& found, LinkageMotion& motion) const {
  for (std::size_t k = 0; k < model_.flexures.size(); ++k)
    motion.flexures.push_back(curves_of(k, found));
  for (std::size_t i = 0; i < found.moments.size(); ++i) {
    const RigidPosition& rigid = result_.positions[i];
    const PathState state =
        make_path_state(model_, MovingState(*found.system, found.moments[i]), 0.0);
    std::vector<std::vector<Vec2>> displacements;
    for (std::size_t k = 0; k < rigid.flexures.size(); ++k) {
      std::vector<Vec2> moved;
      const std::vector<Vec2>& axis = state.axes[k];
      for (std::size_t j = 0; j < rigid.flexures[k].size(); ++j) {
        // both are even along the axis, maybe of different numbers
        const double at = static_cast<double>(j) * static_cast<double>(axis.size() - 1) /
                          static_cast<double>(rigid.flexures[k].size() - 1);
        const auto low = std::min(static_cast<std::size_t>(at), axis.size() - 2);
        const double share = at - static_cast<double>(low);
        moved.push_back((1.0 - share) * axis[low] + share * axis[low + 1] - rigid.flexures[k][j]);
      }
      displacements.push_back(std::move(moved));
    }
    motion.displacements.push_back(std::move(displacements));
    std::vector<Vec2> bodies, points;
    for (std::size_t b = 0; b < rigid.bodies.size(); ++b)
      bodies.push_back(state.bodies[b].position - rigid.bodies[b].position);
    for (std::size_t p = 0; p < rigid.points.size(); ++p)
      points.push_back(state.points[p] - rigid.points[p]);
    motion.bodies.push_back(std::move(bodies));
    motion.points.push_back(std::move(points));
  }
}

double Nonlinear::difference_from_linear(const LinkageMotion& motion, double speed) const {
  LinkageTurn turn(model_, linear_, false);
  if (!turn.visit(turn.positions())) return INFINITY;
  const LinkageSolution solution = solve_periodic(turn, linear_, speed);
  if (!solution.termination.converged()) return INFINITY;
  const Eigen::MatrixXd linear = middle_strains(linear_, turn, speed, solution.states);
  Eigen::MatrixXd nonlinear(linear.rows(), linear.cols());
  for (Eigen::Index m = 0; m < linear.cols(); ++m)
    for (Eigen::Index i = 0; i < linear.rows(); ++i)
      nonlinear(i, m) =
          motion.flexures[static_cast<std::size_t>(m)].strain[static_cast<std::size_t>(i)];
  return strain_distance(linear, nonlinear);
}

NonlinearComparison Nonlinear::run() {
  NonlinearComparison comparison;
  const auto start = std::chrono::steady_clock::now();
  std::string differences;
  double limit = 0.0;
  constexpr double rpm = 60.0 / full_turn;
  for (const double share : shares) {
    const double speed = share * result_.speed;
    PeriodicMotion found = find(speed);
    LinkageMotion motion;
    motion.label = "nonlinear";
    motion.termination = found.termination;
    motion.unknowns = found.system ? static_cast<int>(found.system->size()) : 0;
    motion.iterations = found.turns + found.multiplier_flows;
    motion.counted = "turns";
    motion.remark = damping_;
    if (found.termination.converged()) {
      record(found, motion);
      const double difference = difference_from_linear(motion, speed);
      differences += fmt::format("{}{:.3g} % at {:.4g} {}", differences.empty() ? "" : ", ",
                                 100.0 * difference, model_.units.time == "s" ? speed * rpm : speed,
                                 model_.units.time == "s" ? "rpm" : "rad per time unit");
      if (difference > trusted && limit == 0.0) limit = speed;
    }
    comparison.motion = std::move(motion);
    if (!found.termination.converged()) break;
  }
  comparison.motion.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!differences.empty())
    comparison.notes.push_back(
        "kineto-elastodynamics with the damping of the nonlinear motion is off by (strains): " +
        differences);
  if (limit > 0.0)
    comparison.notes.push_back(
        fmt::format("from {:.4g} {} on, or below, linear strains are off by more than {:g} %: "
                    "trust `nonlinear` "
                    "there",
                    model_.units.time == "s" ? limit * rpm : limit,
                    model_.units.time == "s" ? "rpm" : "rad per time unit", 100.0 * trusted));
  return comparison;
}

}  // namespace

NonlinearComparison compare_with_nonlinear(const Model& model, const LinkageStudy& study,
                                           const LinkageTurn& turn, const LinkageResult& result,
                                           const std::function<bool(double)>& keep_going) {
  return Nonlinear(model, study, turn, result, keep_going).run();
}

}  // namespace flexura

#include "flexura/studies/linkage_methods.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace flexura {
namespace {

constexpr double settled = 1e-9;  // change over a turn, of the largest displacement
constexpr int most_passes = 20;   // with the axial forces of the last
constexpr double same_motion = 1e-9;
constexpr int transient_stages = 4;

const char* const buckling_remark =
    "axial forces at some angle are beyond what a link bears at rest: it does not buckle in "
    "passing, but linear theory is at its end; modes that damp are those without axial forces";

std::string buckles(double angle) {
  return fmt::format(
      "a link buckles at {:.4g} degrees of the drive: its axial force there is beyond what it "
      "bears. A lower speed or load, or a stiffer link, helps",
      angle * 180.0 / std::numbers::pi);
}

/// States at the positions out of those at the ends of all intervals.
std::vector<ElasticState> at_positions(const LinkageTurn& turn, double speed,
                                       const std::vector<double>& ends,
                                       const std::vector<OscillationState>& states) {
  std::vector<ElasticState> chosen;
  std::size_t k = 0;
  for (const double angle : turn.positions()) {
    while (k + 1 < ends.size() && std::abs(ends[k] - angle) > 1e-10) ++k;
    chosen.push_back(by_time(turn.drive(angle), speed, states[k]));
  }
  return chosen;
}

/// The same of a periodic motion, where the first state has the second derivative of the last.
std::vector<ElasticState> of_period(const LinkageTurn& turn, double speed,
                                    const std::vector<double>& ends,
                                    std::vector<OscillationState> states) {
  states.front().second = states.back().second;
  return at_positions(turn, speed, ends, states);
}

/// Matrices by the angle, with the stiffness of the axial forces that the study wants.
class Oscillation {
 public:
  Oscillation(const LinkageTurn& turn, double speed) : turn_(turn), speed_(speed) {}
  void set_displacements(const std::vector<double>& angles,
                         const std::vector<Eigen::VectorXd>& displacements) {
    for (std::size_t k = 0; k < angles.size(); ++k) known_[angles[k]] = displacements[k];
  }
  /// Throws Buckled if a link does at one of these angles.
  void probe(const std::vector<double>& angles) const {
    for (const double angle : angles) (*this)(angle);
  }
  /// Where links buckle at rest, modes that damp are those of the elastic stiffness.
  void damp_elastically() { elastic_damping_ = true; }
  OscillationMatrices operator()(double angle) const {
    const auto found = known_.find(angle);
    const Eigen::MatrixXd stiffness = found == known_.end()
                                          ? turn_.stiffness(angle, speed_)
                                          : turn_.stiffness_of(angle, found->second);
    return turn_.oscillation(angle, speed_, stiffness,
                             elastic_damping_ ? turn_.matrices(angle).stiffness : stiffness);
  }

 private:
  bool elastic_damping_ = false;
  const LinkageTurn& turn_;
  double speed_;
  std::map<double, Eigen::VectorXd> known_;
};

}  // namespace

ElasticState by_time(const DriveRate& drive, double speed, const OscillationState& state) {
  const double w = speed * drive.rate;
  return {state.u, w * state.first,
          w * w * state.second + (speed * speed * drive.rate * drive.slope) * state.first};
}

LinkageSolution solve_quasi_static(const LinkageTurn& turn, double speed) {
  LinkageSolution solution;
  for (const double angle : turn.positions()) {
    const LinkageMatrices& m = turn.matrices(angle);
    const Eigen::LLT<Eigen::MatrixXd> factor(turn.stiffness(angle, speed));
    if (factor.info() != Eigen::Success) {
      solution.termination = {Status::stopped, buckles(angle)};
      return solution;
    }
    const Eigen::VectorXd q = factor.solve(m.load + speed * speed * m.inertia_load);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(q.size());
    solution.states.push_back({q, none, none});
  }
  solution.termination = {Status::converged, {}};
  return solution;
}

namespace {

/// Largest distance of two sets of displacements over the largest of the second.
double distance(const std::vector<Eigen::VectorXd>& before,
                const std::vector<Eigen::VectorXd>& now) {
  double change = 0.0, size = 0.0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    change = std::max(change, (now[k] - before[k]).norm());
    size = std::max(size, now[k].norm());
  }
  return change / std::max(size, 1e-300);
}

/// With the axial forces of the pass before, until they are its own; one pass where they are those
/// at rest. Throws Buckled.
void pass_until_agreed(LinkageTurn& turn, const std::vector<double>& ends, int stages, bool dynamic,
                       double speed, Oscillation& matrices, LinkageSolution& solution) {
  const std::vector<double> angles = LinkageTurn::stage_angles(ends, stages);
  std::vector<Eigen::VectorXd> before;
  for (int pass = 0; pass < most_passes; ++pass) {
    const PeriodicOscillation oscillation(ends, stages, matrices);
    const PeriodicOscillation::Periodic periodic = oscillation.solve_periodic();
    solution.iterations += periodic.turns;
    solution.multipliers = periodic.multipliers;
    solution.states = of_period(turn, speed, ends, oscillation.states(periodic.start));
    if (!(periodic.residual < 1e-8)) {
      solution.termination = {Status::stopped,
                              "no periodic motion: a multiplier of Floquet is 1, a resonance "
                              "without damping. Damping, or another speed, helps"};
      return;
    }
    std::vector<Eigen::VectorXd> now = oscillation.stage_displacements(periodic.start);
    if (!dynamic || (!before.empty() && distance(before, now) <= same_motion)) {
      solution.termination = {Status::converged, {}};
      return;
    }
    before = std::move(now);
    matrices.set_displacements({angles.begin() + 1, angles.end()}, before);
  }
  solution.termination = {Status::stopped,
                          "the axial forces of the vibration and the stiffness that they give do "
                          "not come to agree: the linkage is beyond what this theory can say"};
}

}  // namespace

LinkageSolution solve_periodic(LinkageTurn& turn, const LinkageStudy& study, double speed,
                               int stages) {
  LinkageSolution solution;
  const std::vector<double> ends = turn.interval_ends(1);
  if (!turn.visit(LinkageTurn::stage_angles(ends, stages))) return solution;
  const bool dynamic = study.geometric_stiffness == LinkageStudy::GeometricStiffness::dynamic;
  Oscillation matrices(turn, speed);
  solution.counted = "turns";
  try {
    pass_until_agreed(turn, ends, stages, dynamic, speed, matrices, solution);
  } catch (const LinkageTurn::Buckled&) {
    matrices.damp_elastically();
    solution.remark = buckling_remark;
    pass_until_agreed(turn, ends, stages, dynamic, speed, matrices, solution);
  }
  return solution;
}

namespace {

/// The turn that starts at y, whose second derivative is that of the equation of motion there.
LinkageSolution show_turn(const LinkageTurn& turn, double speed, const std::vector<double>& ends,
                          const PeriodicOscillation& oscillation, const Oscillation& matrices,
                          const Eigen::VectorXd& y, LinkageSolution solution) {
  std::vector<OscillationState> states = oscillation.states(y);
  const OscillationMatrices m = matrices(0.0);
  states.front().second = m.mass.ldlt().solve(m.load - m.damping * states.front().first -
                                              m.stiffness * states.front().u);
  ++solution.iterations;
  if (!states.back().u.allFinite()) {
    solution.termination = {Status::stopped, "the motion grows beyond all bounds"};
    return solution;
  }
  solution.states = at_positions(turn, speed, ends, states);
  solution.termination = {Status::converged, {}};
  return solution;
}

}  // namespace

LinkageSolution solve_transient(LinkageTurn& turn, const LinkageStudy& study, double speed,
                                const std::function<bool(double)>& keep_going) {
  LinkageSolution solution;
  const std::vector<double> ends = turn.interval_ends(2);
  if (!turn.visit(LinkageTurn::stage_angles(ends, transient_stages))) return solution;
  solution.counted = "turns";
  Oscillation matrices(turn, speed);
  try {
    matrices.probe(turn.positions());
  } catch (const LinkageTurn::Buckled&) {
    matrices.damp_elastically();
    solution.remark = buckling_remark;
  }
  const PeriodicOscillation oscillation(ends, transient_stages, matrices);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * oscillation.size());
  y.head(oscillation.size()) = turn.static_displacement(0.0, speed);
  if (study.turn_from_rest) {
    for (; solution.iterations + 1 < *study.turn_from_rest; ++solution.iterations) {
      y = oscillation.advance(y, true);
      const double done = static_cast<double>(solution.iterations) / *study.turn_from_rest;
      if (keep_going && !keep_going(done)) return solution;
    }
    return show_turn(turn, speed, ends, oscillation, matrices, y, std::move(solution));
  }
  double change = 1.0;
  for (; solution.iterations < study.turns && change > settled; ++solution.iterations) {
    const Eigen::VectorXd after = oscillation.advance(y, true);
    change = (after - y).norm() / std::max(after.norm(), 1e-300);
    y = after;
    if (keep_going && !keep_going(static_cast<double>(solution.iterations) / study.turns)) break;
  }
  solution.states = of_period(turn, speed, ends, oscillation.states(y));
  solution.termination = {Status::converged, {}};
  if (!std::isfinite(change) || change > settled)
    solution.termination = {
        Status::stopped,
        fmt::format("after {} turns the motion still changes by {:.2g} in a turn: more `turns`, or "
                    "more damping, lets it settle, unless it grows",
                    solution.iterations, change)};
  return solution;
}

}  // namespace flexura

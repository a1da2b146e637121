#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "flexura/solvers/vibration.hpp"
#include "flexura/studies/linkage_methods.hpp"

namespace flexura {
namespace {

constexpr int most_iterations = 200;
constexpr double agreed = 1e-10;
// Stretching modes are left to follow their load: displacements that are carried over to the next
// interval strain links that have turned by then, by the square of nothing small.
constexpr int default_modes = 4;

/// An interval with the matrices of its middle: modes that are damped oscillators by themselves.
struct FrozenInterval {
  double time = 0.0;
  Eigen::MatrixXd shapes;              // mass-normalised columns
  Eigen::MatrixXd weighted;            // mass * shapes
  Eigen::VectorXd frequency, damping;  // damping: the share of critical
  Eigen::MatrixXd turning, carrying;   // coupling terms by u' and u
  Eigen::VectorXd load;
  // with the coupling terms of the last iteration:
  Eigen::VectorXd whole_load, modal_load;
  Eigen::LDLT<Eigen::MatrixXd> stiffness;
};

/// Modal coordinates and their rates.
struct ModalState {
  Eigen::VectorXd value, rate;
};

/// At the ends of all intervals of a turn: states, velocities by the modes, and the start of the
/// next turn.
struct TurnMotion {
  std::vector<ElasticState> states;
  std::vector<Eigen::VectorXd> rates;
  ModalState end;
};

/// The damped oscillator x'' + 2 z w x' + w^2 x = f over a time, in closed form.
ModalState advance(const FrozenInterval& interval, const ModalState& start, bool loaded) {
  ModalState end{start.value, start.rate};
  for (Eigen::Index i = 0; i < start.value.size(); ++i) {
    const double w = interval.frequency[i], z = interval.damping[i];
    const double rest = loaded ? interval.modal_load[i] / (w * w) : 0.0;
    const double x = start.value[i] - rest;
    const double decay = z * w, t = interval.time;
    const double own = w * std::sqrt(std::abs(1.0 - z * z));
    // beyond critical damping the circular functions become hyperbolic ones
    const double c = z < 1.0 ? std::cos(own * t) : std::cosh(own * t);
    const double s = own * t < 1e-9 ? t : (z < 1.0 ? std::sin(own * t) : std::sinh(own * t)) / own;
    const double e = std::exp(-decay * t);
    end.value[i] = rest + e * (x * (c + decay * s) + start.rate[i] * s);
    end.rate[i] = e * (start.rate[i] * (c - decay * s) - x * w * w * s);
  }
  return end;
}

/// Displacements by the modes that were left out: they follow the load as at rest.
Eigen::VectorXd left_out(const FrozenInterval& interval) {
  const Eigen::VectorXd kept = interval.modal_load.array() / interval.frequency.array().square();
  return interval.stiffness.solve(interval.whole_load) - interval.shapes * kept;
}

class Midha {
 public:
  Midha(LinkageTurn& turn, const LinkageStudy& study, double speed)
      : turn_(turn), study_(study), speed_(speed), ends_(turn.interval_ends(1)) {}
  LinkageSolution solve();

 private:
  bool freeze();
  std::optional<FrozenInterval> freeze(double angle, double length);
  /// At the start of an interval, seen by the modes there: those of its middle would strain links
  /// that are not yet where the middle has them.
  ElasticState seen_at(std::size_t bound, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;
  /// From the end of an interval to the start of the next.
  ModalState carry_over(std::size_t from, const ModalState& state) const;
  ModalState over_turn(ModalState state, bool loaded) const;
  void factorize_turn();
  ModalState periodic_start() const;
  ModalState at_rest() const;
  TurnMotion follow(ModalState state) const;
  bool settle(const std::optional<ModalState>& start, TurnMotion& motion, int& iterations);
  void load_with(const std::vector<ElasticState>& last, const std::vector<Eigen::VectorXd>& rates);

  LinkageTurn& turn_;
  const LinkageStudy& study_;
  double speed_;
  std::vector<double> ends_;
  std::vector<FrozenInterval> intervals_;
  std::vector<FrozenInterval> bounds_;  // of no length, at their ends
  std::optional<double> buckled_;
  Eigen::PartialPivLU<Eigen::MatrixXd> turn_factor_;
};

std::optional<FrozenInterval> Midha::freeze(double angle, double length) {
  const LinkageMatrices& m = turn_.matrices(angle);
  const Eigen::MatrixXd stiffness = turn_.stiffness(angle, speed_);
  const Vibrations modes = dense_vibrations(
      stiffness, m.mass, Eigen::MatrixXd(0, m.mass.cols()),
      std::min(study_.midha_modes.value_or(default_modes), static_cast<int>(m.mass.rows())));
  if (!modes.found || modes.squares.size() == 0 || modes.squares[0] <= 0.0) {
    buckled_ = angle;
    return {};
  }
  FrozenInterval interval;
  interval.time = length / (speed_ * turn_.drive(angle).rate);
  interval.shapes = modes.shapes;
  interval.weighted = m.mass * modes.shapes;
  interval.frequency = modes.squares.cwiseSqrt();
  const DampingSettings& damping = study_.damping;
  interval.damping = damping.modal + 0.5 * damping.mass * interval.frequency.array().inverse() +
                     0.5 * damping.stiffness * interval.frequency.array();
  interval.turning = speed_ * m.turning;
  interval.carrying = speed_ * speed_ * m.carrying;
  interval.load = m.load + speed_ * speed_ * m.inertia_load;
  interval.whole_load = interval.load;
  interval.modal_load = interval.shapes.transpose() * interval.load;
  interval.stiffness.compute(stiffness);
  // one sign from interval to interval
  if (!intervals_.empty())
    for (Eigen::Index i = 0; i < interval.shapes.cols(); ++i)
      if (intervals_.back().weighted.col(i).dot(interval.shapes.col(i)) < 0.0) {
        interval.shapes.col(i) *= -1.0;
        interval.weighted.col(i) *= -1.0;
        interval.modal_load[i] *= -1.0;
      }
  return interval;
}

bool Midha::freeze() {
  std::vector<double> angles = ends_;
  for (std::size_t k = 0; k + 1 < ends_.size(); ++k)
    angles.push_back(0.5 * (ends_[k] + ends_[k + 1]));
  if (!turn_.visit(angles)) return false;
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    auto bound = freeze(ends_[k], 0.0);
    if (!bound) return false;
    bounds_.push_back(std::move(*bound));
    if (k + 1 == ends_.size()) break;
    auto interval = freeze(angles[ends_.size() + k], ends_[k + 1] - ends_[k]);
    if (!interval) return false;
    intervals_.push_back(std::move(*interval));
  }
  return true;
}

ElasticState Midha::seen_at(std::size_t k, const Eigen::VectorXd& u,
                            const Eigen::VectorXd& v) const {
  FrozenInterval bound = bounds_[k];
  if (study_.coupling) bound.whole_load = bound.load - bound.turning * v - bound.carrying * u;
  bound.modal_load = bound.shapes.transpose() * bound.whole_load;
  const Eigen::ArrayXd value = bound.weighted.transpose() * u;
  const Eigen::ArrayXd rate = bound.weighted.transpose() * v;
  const Eigen::VectorXd second = bound.modal_load.array() -
                                 2.0 * bound.damping.array() * bound.frequency.array() * rate -
                                 bound.frequency.array().square() * value;
  return {bound.shapes * value.matrix() + left_out(bound), bound.shapes * rate.matrix(),
          bound.shapes * second};
}

ModalState Midha::carry_over(std::size_t from, const ModalState& state) const {
  if (study_.continuity == LinkageStudy::Continuity::modal) return state;
  const FrozenInterval& next = intervals_[(from + 1) % intervals_.size()];
  const Eigen::MatrixXd across = next.weighted.transpose() * intervals_[from].shapes;
  return {across * state.value, across * state.rate};
}

ModalState Midha::over_turn(ModalState state, bool loaded) const {
  for (std::size_t k = 0; k < intervals_.size(); ++k)
    state = carry_over(k, advance(intervals_[k], state, loaded));
  return state;
}

/// 1 - the map of a turn without loads, column by column.
void Midha::factorize_turn() {
  const Eigen::Index m = intervals_.front().frequency.size();
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(2 * m, 2 * m);
  for (Eigen::Index j = 0; j < 2 * m; ++j) {
    ModalState unit{Eigen::VectorXd::Zero(m), Eigen::VectorXd::Zero(m)};
    (j < m ? unit.value[j] : unit.rate[j - m]) = 1.0;
    const ModalState after = over_turn(unit, false);
    system.col(j).head(m) -= after.value;
    system.col(j).tail(m) -= after.rate;
  }
  turn_factor_.compute(system);
}

ModalState Midha::periodic_start() const {
  const Eigen::Index m = intervals_.front().frequency.size();
  const ModalState loaded = over_turn({Eigen::VectorXd::Zero(m), Eigen::VectorXd::Zero(m)}, true);
  Eigen::VectorXd right(2 * m);
  right << loaded.value, loaded.rate;
  const Eigen::VectorXd start = turn_factor_.solve(right);
  return {start.head(m), start.tail(m)};
}

/// Coupling terms by the mean of both ends of the last iteration.
void Midha::load_with(const std::vector<ElasticState>& last,
                      const std::vector<Eigen::VectorXd>& rates) {
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    FrozenInterval& interval = intervals_[k];
    const Eigen::VectorXd u = 0.5 * (last[k].q + last[k + 1].q);
    const Eigen::VectorXd v = 0.5 * (rates[k] + rates[k + 1]);
    interval.whole_load = interval.load - interval.turning * v - interval.carrying * u;
    interval.modal_load = interval.shapes.transpose() * interval.whole_load;
  }
}

/// The motion of a turn from its start with the coupling terms of the last iteration.
TurnMotion Midha::follow(ModalState state) const {
  TurnMotion motion;
  for (std::size_t k = 0; k <= intervals_.size(); ++k) {
    const FrozenInterval& interval = intervals_[k % intervals_.size()];
    const Eigen::VectorXd u = interval.shapes * state.value;
    const Eigen::VectorXd v = interval.shapes * state.rate;
    motion.states.push_back(seen_at(k, u, v));
    motion.rates.push_back(v);
    if (k < intervals_.size()) state = carry_over(k, advance(interval, state, true));
  }
  motion.end = std::move(state);
  return motion;
}

/// A turn with its coupling terms, from this start or, without one, closed upon itself. Whether
/// they have come to rest.
bool Midha::settle(const std::optional<ModalState>& start, TurnMotion& motion, int& iterations) {
  motion = {};
  for (int i = 0; i < most_iterations; ++i) {
    ++iterations;
    TurnMotion now = follow(start ? *start : periodic_start());
    double size = 0.0, moved = 0.0;
    for (std::size_t k = 0; k < now.states.size(); ++k) {
      const Eigen::VectorXd& q = now.states[k].q;
      size = std::max(size, q.norm());
      moved = std::max(moved, i == 0 ? q.norm() : (q - motion.states[k].q).norm());
    }
    motion = std::move(now);
    if (!study_.coupling) return true;
    load_with(motion.states, motion.rates);
    if (moved <= agreed * std::max(size, 1e-300)) return true;
  }
  return false;
}

/// At rest in the quasi-static position, as far as the modes have it.
ModalState Midha::at_rest() const {
  const Eigen::VectorXd u = turn_.static_displacement(ends_.front(), speed_);
  const FrozenInterval& first = intervals_.front();
  return {first.weighted.transpose() * u, Eigen::VectorXd::Zero(first.frequency.size())};
}

LinkageSolution Midha::solve() {
  LinkageSolution solution;
  solution.counted = "iterations of the coupling terms";
  if (!freeze()) {
    if (buckled_)
      solution.termination = {
          Status::stopped, fmt::format("a link buckles at {:.4g} degrees of the drive: its modes "
                                       "have no frequency there",
                                       *buckled_ * 180.0 / std::numbers::pi)};
    return solution;
  }
  TurnMotion motion;
  bool at_peace = true;
  if (study_.turn_from_rest) {
    std::optional<ModalState> start = at_rest();
    for (int turn = 0; turn < *study_.turn_from_rest && at_peace; ++turn) {
      at_peace = settle(start, motion, solution.iterations);
      start = motion.end;
    }
  } else {
    factorize_turn();
    at_peace = settle({}, motion, solution.iterations);
  }
  std::size_t k = 0;
  for (const double angle : turn_.positions()) {
    while (k + 1 < ends_.size() && std::abs(ends_[k] - angle) > 1e-10) ++k;
    solution.states.push_back(motion.states[k]);
  }
  solution.termination = {Status::converged, {}};
  if (!at_peace)
    solution.termination = {Status::stopped,
                            "the iteration of the coupling terms does not come to rest: at this "
                            "speed they are no small correction. Method periodic solves for them"};
  return solution;
}

}  // namespace

LinkageSolution solve_midha(LinkageTurn& turn, const LinkageStudy& study, double speed) {
  return Midha(turn, study, speed).solve();
}

}  // namespace flexura

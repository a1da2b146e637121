#include "flexura/studies/modes_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/studies/mode_shape.hpp"
#include "flexura/studies/motion_start.hpp"

namespace flexura {
namespace {

constexpr Eigen::Index largest_dense = 300;
constexpr int most_refinements = 5;

/// What Lanczos' method asks of a mechanism.
class MotionOperator final : public VibrationOperator {
 public:
  explicit MotionOperator(const MotionSystem& system) : system_(system) {}
  Eigen::Index size() const override { return system_.coordinates(); }
  Eigen::Index most_rigid() const override { return system_.moving(); }
  bool set_shift(double shift) override { return system_.factorize(shift, 0.0, factor_); }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const override {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(system_.size());
    x.head(size()) = b;
    system_.solve(factor_, x);
    return x.head(size());
  }
  Eigen::VectorXd multiply_mass(const Eigen::VectorXd& x) const override {
    return system_.multiply_mass(x);
  }
  std::optional<int> count_below(double square) const override {
    MotionFactor<double> factor;
    if (!system_.factorize(-square, 0.0, factor)) return std::nullopt;
    return system_.negative(factor);
  }

 private:
  const MotionSystem& system_;
  MotionFactor<double> factor_;
};

class Modes {
 public:
  Modes(const Model& model, const ModesStudy& study, const ModelingSettings& settings,
        const std::function<bool(double)>& keep_going)
      : model_(model), study_(study), settings_(settings), keep_going_(keep_going) {}

  ModelingModes run();

 private:
  void find_all(MotionStart start);
  void add_curve();
  bool go_on(double fraction) const { return !keep_going_ || keep_going_(fraction); }

  const Model& model_;
  const ModesStudy& study_;
  const ModelingSettings& settings_;
  const std::function<bool(double)>& keep_going_;
  ModelingModes modes_;
};

std::optional<double> largest_change(const std::vector<double>& coarse,
                                     const std::vector<double>& fine) {
  std::optional<double> worst;
  for (std::size_t i = 0; i < std::min(coarse.size(), fine.size()); ++i)
    if (fine[i] != 0.0) worst = std::max(worst.value_or(0.0), std::abs(coarse[i] / fine[i] - 1.0));
  return worst;
}

double error_ratio(const MotionSystem& system) {
  double ratio = 1.0;
  for (std::size_t k = 0; k < system.member_count(); ++k)
    ratio = std::max(ratio, system.port(k).error_ratio());
  return ratio;
}

/// Refines until the frequencies settle, where the modeling chooses its own modes; the change by
/// one refinement more is the estimate.
void Modes::find_all(MotionStart start) {
  Vibrations found = find_vibrations(*start.system, start.moment, study_.count, study_.solver);
  for (int refinements = 0; found.found; ++refinements) {
    auto finer = start.system->refined();
    if (!finer) break;
    Moment moment = start.system->prolong(start.moment, *finer);
    if (study_.about && !solve_at_rest(*finer, moment)) break;
    Vibrations more = find_vibrations(*finer, moment, study_.count, study_.solver);
    if (!more.found) break;
    const auto change = largest_change(signed_frequencies(found), signed_frequencies(more));
    if (change) modes_.error_estimate = error_ratio(*start.system) * *change;
    if (!change || !chooses_modes(settings_) || refinements == most_refinements ||
        *change <= std::max(settings_.tolerance, 1e-11) || !go_on(0.5))
      break;
    start.system = std::move(finer);
    start.moment = std::move(moment);
    found = std::move(more);
  }
  modes_.unknowns = static_cast<int>(start.system->size());
  if (!found.found) {
    modes_.termination = {Status::stopped,
                          "no frequencies were found: the mechanism has no mass that can move, or "
                          "its stiffness is not finite"};
    return;
  }
  const std::vector<double> values = signed_frequencies(found);
  for (std::size_t i = 0; i < values.size(); ++i)
    modes_.modes.push_back(make_mode(model_, *start.system, start.moment,
                                     found.shapes.col(static_cast<Eigen::Index>(i)), values[i]));
  const auto unstable = std::count_if(values.begin(), values.end(), [](double w) { return w < 0; });
  if (unstable > 0)
    modes_.termination.reason = fmt::format("the state is unstable: {} of the modes grow{}",
                                            unstable, unstable == 1 ? "s" : "");
}

/// Frequencies about every output state, by the modeling's own first choice of modes.
void Modes::add_curve() {
  const PathStart path(model_, path_study_of(model_, *study_.about), settings_, study_.inertia,
                       study_.about->load_factor);
  const std::size_t states = path.load_factors().size();
  for (std::size_t k = 0; k < states; ++k) {
    MotionStart start = path.at(k);
    if (!start.termination.converged()) break;
    const Vibrations found =
        find_vibrations(*start.system, start.moment, study_.count, study_.solver);
    if (!found.found) break;
    modes_.curve.push_back({path.load_factors()[k], signed_frequencies(found)});
    if (!go_on(static_cast<double>(k + 1) / static_cast<double>(states))) return;
  }
}

ModelingModes Modes::run() {
  modes_.label = settings_.label;
  modes_.modeling = modeling_name(settings_);
  MotionStart start = start_about(model_, study_.about, settings_, study_.inertia);
  modes_.termination = start.termination;
  if (!start.termination.converged()) return std::move(modes_);
  find_all(std::move(start));
  if (study_.curve && study_.about && modes_.termination.converged()) add_curve();
  return std::move(modes_);
}

}  // namespace

Vibrations find_vibrations(MotionSystem& system, const Moment& moment, int count,
                           ModesStudy::Solver solver) {
  Eigen::VectorXd r;
  system.residual(moment, r);
  system.linearize(moment);
  const Eigen::Index n = system.coordinates();
  const bool dense = solver == ModesStudy::Solver::dense ||
                     (solver == ModesStudy::Solver::automatic && n <= largest_dense) ||
                     n <= count + 1;
  if (dense) {
    Eigen::MatrixXd stiffness, mass;
    system.dense(stiffness, mass);
    return dense_vibrations(stiffness.topLeftCorner(n, n), mass,
                            stiffness.bottomLeftCorner(system.multipliers(), n), count);
  }
  MotionOperator op(system);
  return sparse_vibrations(op, count);
}

std::vector<double> signed_frequencies(const Vibrations& vibrations) {
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < vibrations.squares.size(); ++i) {
    const double square = vibrations.squares[i];
    frequencies.push_back(square < 0.0 ? -std::sqrt(-square) : std::sqrt(square));
  }
  return frequencies;
}

ModelingModes run_modes(const Model& model, const ModesStudy& study,
                        const ModelingSettings& settings,
                        const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  ModelingModes modes = Modes(model, study, settings, keep_going).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  modes.seconds = took.count();
  return modes;
}

}  // namespace flexura

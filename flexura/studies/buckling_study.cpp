#include "flexura/studies/buckling_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/modelings/make_system.hpp"
#include "flexura/studies/arc_tracer.hpp"
#include "flexura/studies/error_estimate.hpp"
#include "flexura/studies/mode_shape.hpp"
#include "flexura/studies/singular_mechanism.hpp"

namespace flexura {
namespace {

constexpr double far_off = 1e8;  // of the nearest: a mode that only rounding finds
constexpr int path_steps = 20;   // largest arc-length step 2/20 of the first load factor

struct Critical {
  double load_factor = 0.0;
  std::vector<double> direction;
};

/// K1 by differences of fourth order along z', at a step that keeps eleven digits.
Eigen::MatrixXd hessian_rate(System& system, const std::vector<double>& start,
                             const std::vector<double>& slope, double unit) {
  const auto at = [&](double step) {
    std::vector<double> z = start;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += step * slope[i];
    system.set_load_factor(step);
    return system.hessian(z);
  };
  const double h = 1e-3 * unit;
  return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
}

/// All real mu of det(K0 + mu K1) = 0, the nearest first.
std::vector<Critical> linearised_factors(System& system) {
  const std::vector<double> start = system.initial_state();
  system.set_load_factor(0.0);
  if (!system.linearize(start)) return {};
  std::vector<double> slope;
  system.load_direction(slope);
  const Eigen::VectorXd scale = system.unknown_scale();
  const double size = scale.cwiseInverse()
                          .cwiseProduct(Eigen::Map<const Eigen::VectorXd>(
                              slope.data(), static_cast<Eigen::Index>(slope.size())))
                          .lpNorm<Eigen::Infinity>();
  const double one = size > 0.0 ? 1.0 / size : 1.0;  // changes an unknown by its size
  const Eigen::MatrixXd rate =
      scale.asDiagonal() * hessian_rate(system, start, slope, one) * scale.asDiagonal();
  system.set_load_factor(0.0);
  const Eigen::MatrixXd rest = scale.asDiagonal() * system.hessian(start) * scale.asDiagonal();
  // K1 v = nu K0 v, nu = -1/mu
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(rest.partialPivLu().solve(rate).eval());
  std::vector<Critical> found;
  const double nearest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < eigen.eigenvalues().size(); ++i) {
    const auto nu = eigen.eigenvalues()[i];
    if (!(std::abs(nu) > nearest / far_off) || std::abs(nu.imag()) > 1e-7 * std::abs(nu)) continue;
    Critical critical{-1.0 / nu.real(), std::vector<double>(start.size())};
    const Eigen::VectorXd v = scale.cwiseProduct(eigen.eigenvectors().col(i).real());
    std::copy(v.begin(), v.end(), critical.direction.begin());
    found.push_back(std::move(critical));
  }
  std::sort(found.begin(), found.end(), [](const Critical& a, const Critical& b) {
    return std::abs(a.load_factor) < std::abs(b.load_factor);
  });
  return found;
}

std::vector<double> positive_factors(const std::vector<Critical>& found) {
  std::vector<double> positive;
  for (const Critical& critical : found)
    if (critical.load_factor > 0.0) positive.push_back(critical.load_factor);
  return positive;
}

class Buckling {
 public:
  Buckling(const Model& model, const BucklingStudy& study, const ModelingSettings& settings,
           const std::function<bool(double)>& keep_going)
      : model_(model), study_(study), settings_(settings), keep_going_(keep_going) {}

  ModelingModes run();

 private:
  void run_linearised(std::unique_ptr<System> system);
  void run_along_path(System& system);
  TracedPath trace(const std::vector<double>& estimates, int refinements) const;
  void add_critical(TracedPath& traced, const TracedEvent& event, double unit);
  bool suffices(const std::optional<double>& error, int refinements) const;
  std::optional<double> relative_error(const System& system, const std::vector<double>& coarse,
                                       const std::vector<double>& fine) const;
  void say_none_found(const std::vector<Critical>& linearised);

  const Model& model_;
  const BucklingStudy& study_;
  const ModelingSettings& settings_;
  const std::function<bool(double)>& keep_going_;
  ModelingModes modes_;
};

ModelingModes Buckling::run() {
  modes_.label = settings_.label;
  modes_.modeling = modeling_name(settings_);
  auto system = std::make_unique<System>(make_layout(model_, study_.loads, settings_));
  modes_.unknowns = static_cast<int>(system->size());
  if (!system->linearize(system->initial_state()) || system->is_singular()) {
    modes_.termination = {Status::stopped, describe_singular(model_, system->softest_body())};
    return std::move(modes_);
  }
  modes_.termination.status = Status::converged;
  if (study_.linearised)
    run_linearised(std::move(system));
  else
    run_along_path(*system);
  return std::move(modes_);
}

/// By the largest relative change from coarse to fine over the values that both have, up to the
/// study's count; absent without any.
std::optional<double> Buckling::relative_error(const System& system,
                                               const std::vector<double>& coarse,
                                               const std::vector<double>& fine) const {
  std::optional<double> worst;
  const std::size_t both =
      std::min({coarse.size(), fine.size(), static_cast<std::size_t>(study_.count)});
  for (std::size_t i = 0; i < both; ++i)
    worst =
        std::max(worst.value_or(0.0), error_ratio(system) * std::abs(coarse[i] / fine[i] - 1.0));
  return worst;
}

bool Buckling::suffices(const std::optional<double>& error, int refinements) const {
  constexpr int most_refinements = 6;
  return !error || !chooses_modes(settings_) || refinements == most_refinements ||
         *error <= std::max(settings_.tolerance, 1e-10);
}

void Buckling::say_none_found(const std::vector<Critical>& linearised) {
  modes_.termination.reason = "the tangent turns singular at no positive load factor";
  if (!linearised.empty() && linearised.front().load_factor < 0.0)
    modes_.termination.reason +=
        fmt::format("; with its loads reversed the mechanism buckles at about {:.6g}",
                    -linearised.front().load_factor);
}

void Buckling::run_linearised(std::unique_ptr<System> system) {
  std::vector<Critical> found = linearised_factors(*system);
  for (int refinements = 0;; ++refinements) {
    auto finer = system->refined();
    if (!finer) break;
    std::vector<Critical> more = linearised_factors(*finer);
    modes_.error_estimate =
        relative_error(*system, positive_factors(found), positive_factors(more));
    if (suffices(modes_.error_estimate, refinements)) break;
    system = std::move(finer);
    found = std::move(more);
    if (keep_going_ && !keep_going_(0.5)) break;
  }
  modes_.unknowns = static_cast<int>(system->size());
  for (const Critical& critical : found) {
    if (critical.load_factor <= 0.0) continue;
    if (modes_.modes.size() == static_cast<std::size_t>(study_.count)) break;
    modes_.modes.push_back(make_mode(model_, *system, system->initial_state(), critical.direction,
                                     critical.load_factor));
  }
  if (modes_.modes.empty()) say_none_found(found);
}

/// Loads are scaled so that the first load factor is about one, which is what arc-length steps
/// suit.
TracedPath Buckling::trace(const std::vector<double>& estimates, int refinements) const {
  const double unit = estimates.empty() ? 1.0 : estimates.front();
  const std::size_t wanted = std::min(estimates.size(), static_cast<std::size_t>(study_.count));
  PathStudy path;
  path.loads = study_.loads;
  for (Load& load : path.loads) {
    load.force = unit * load.force;
    load.moment *= unit;
  }
  path.arc_length = true;
  path.steps = path_steps;
  path.until.load_factor = wanted == 0 ? 1.0 : 2.0 * estimates[wanted - 1] / unit;
  path.until.limit_points = 1;
  path.until.critical = study_.count;
  return trace_by_arc_length(model_, path, settings_, keep_going_, refinements);
}

void Buckling::add_critical(TracedPath& traced, const TracedEvent& event, double unit) {
  System& system = *traced.systems[event.system];
  system.set_load_factor(event.load_factor);
  // exactly at the critical state there may be nothing to factorize
  for (const double beside : {0.0, 1e-9, -1e-9}) {
    system.set_load_factor(event.load_factor * (1.0 + beside));
    if (system.linearize(event.z)) break;
  }
  for (const auto& direction : system.critical_directions(event.directions)) {
    if (modes_.modes.size() == static_cast<std::size_t>(study_.count)) return;
    modes_.modes.push_back(make_mode(model_, system, event.z, direction, unit * event.load_factor));
  }
}

bool is_critical(const TracedEvent& event) {
  return event.kind == "limit point" || event.kind == "bifurcation";
}

std::vector<double> critical_factors(const TracedPath& traced) {
  std::vector<double> values;
  for (const TracedEvent& event : traced.events)
    if (is_critical(event))
      values.insert(values.end(), static_cast<std::size_t>(event.directions), event.load_factor);
  return values;
}

void Buckling::run_along_path(System& system) {
  const std::vector<Critical> linearised = linearised_factors(system);
  const std::vector<double> estimates = positive_factors(linearised);
  const double unit = estimates.empty() ? 1.0 : estimates.front();
  TracedPath traced = trace(estimates, 0);
  for (int refinements = 0; traced.systems.back()->refined(); ++refinements) {
    TracedPath finer = trace(estimates, refinements + 1);
    modes_.error_estimate =
        relative_error(*traced.systems.back(), critical_factors(traced), critical_factors(finer));
    if (suffices(modes_.error_estimate, refinements)) break;
    traced = std::move(finer);
  }
  modes_.unknowns = static_cast<int>(traced.systems.back()->size());
  for (const TracedEvent& event : traced.events)
    if (is_critical(event)) add_critical(traced, event, unit);
  if (!traced.termination.converged()) modes_.termination = traced.termination;
  if (modes_.modes.empty() && modes_.termination.converged()) say_none_found(linearised);
}

}  // namespace

ModelingModes run_buckling(const Model& model, const BucklingStudy& study,
                           const ModelingSettings& settings,
                           const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  ModelingModes modes = Buckling(model, study, settings, keep_going).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  modes.seconds = took.count();
  return modes;
}

void compare_modes(ModeResult& result) {
  const std::vector<Mode> reference = result.modelings[result.reference].modes;
  for (std::size_t m = 0; m < result.modelings.size(); ++m) {
    if (m == result.reference) continue;
    ModelingModes& modes = result.modelings[m];
    for (std::size_t i = 0; i < std::min(reference.size(), modes.modes.size()); ++i)
      if (reference[i].value != 0.0)
        modes.difference = std::max(modes.difference.value_or(0.0),
                                    std::abs(modes.modes[i].value / reference[i].value - 1.0));
  }
}

}  // namespace flexura

#include "flexura/studies/linkage_study.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "flexura/results/linkage_peaks.hpp"
#include "flexura/studies/linkage_methods.hpp"

namespace flexura {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr Eigen::Index most_estimated = 150;  // unknowns of a refined linkage
constexpr double near_change_point = 5e-3;    // RigidState::freedom
constexpr double large_deflection = 0.02;     // of a link's length: beyond it linear theory is off

using Method = LinkageStudy::Method;

std::string name_of(Method method) {
  switch (method) {
    case Method::quasi_static:
      return "quasi_static";
    case Method::periodic:
      return "periodic";
    case Method::midha:
      return "midha";
    case Method::transient:
      return "transient";
    case Method::nonlinear:
      break;
  }
  return "nonlinear";
}

std::string damping_of(const DampingSettings& damping) {
  if (damping.modal > 0.0)
    return fmt::format("{:.6g} of critical damping in every mode at every angle", damping.modal);
  if (damping.mass == 0.0 && damping.stiffness == 0.0) return "no damping";
  return fmt::format("Rayleigh damping: {:.6g} times mass and {:.6g} times stiffness", damping.mass,
                     damping.stiffness);
}

class Linkage {
 public:
  Linkage(const Model& model, const LinkageStudy& study,
          const std::function<bool(double)>& keep_going)
      : model_(model),
        study_(study),
        keep_going_(keep_going),
        speed_(std::abs(model.drivers[study.driver].amount)),
        turn_(model, study, false) {}

  LinkageResult run(Termination& termination);

 private:
  bool go_round(Termination& termination);
  std::string why(const RigidFailure& failure) const;
  LinkageSolution solve(Method method, LinkageTurn& turn) const;
  LinkageMotion solve_and_record(Method method);
  std::optional<double> estimate(Method method, const std::vector<ElasticState>& states);
  void note_change_points();
  void note_reductions();
  void note_peaks();
  void warn_of_large_deflections(LinkageMotion& motion) const;
  void compare();

  const Model& model_;
  const LinkageStudy& study_;
  const std::function<bool(double)>& keep_going_;
  double speed_;
  LinkageTurn turn_;
  std::unique_ptr<LinkageTurn> finer_;  // for estimates
  LinkageResult result_;
};

std::string Linkage::why(const RigidFailure& failure) const {
  using Kind = RigidFailure::Kind;
  if (failure.kind == Kind::ungoverned)
    return fmt::format(
        "as drawn, the drive does not govern all links, or they do not fit: every link needs a "
        "place that follows from the angle of driver '{}'. Rigid links are flexures clamped to the "
        "same body",
        result_.driver);
  return fmt::format(
      "the drive cannot go round: at {:.4g} degrees from the drawn position {}. Another branch, or "
      "other lengths, would let it pass",
      failure.angle / degree,
      failure.kind == Kind::change_point
          ? "it comes to a change point, where links are in one line and could go on in two ways, "
            "or no further"
          : "the links cannot be closed beyond it");
}

bool Linkage::go_round(Termination& termination) {
  if (turn_.visit(turn_.positions())) return true;
  termination = {Status::stopped, why(*turn_.failure())};
  return false;
}

LinkageSolution Linkage::solve(Method method, LinkageTurn& turn) const {
  if (turn.system().size() == 0) return solve_quasi_static(turn, speed_);  // nothing vibrates
  switch (method) {
    case Method::quasi_static:
      return solve_quasi_static(turn, speed_);
    case Method::periodic:
      return solve_periodic(turn, study_, speed_);
    case Method::midha:
      return solve_midha(turn, study_, speed_);
    case Method::transient:
      return solve_transient(turn, study_, speed_, keep_going_);
    case Method::nonlinear:
      break;
  }
  return {};
}

/// Against a linkage of finer flexures.
std::optional<double> Linkage::estimate(Method method, const std::vector<ElasticState>& states) {
  if (method != Method::quasi_static && method != Method::periodic) return {};
  if (!finer_) finer_ = std::make_unique<LinkageTurn>(model_, study_, true);
  LinkageTurn& finer = *finer_;
  if (finer.system().size() > most_estimated || !finer.visit(finer.positions())) return {};
  const LinkageSolution fine = method == Method::periodic
                                   ? solve_periodic(finer, study_, speed_, estimate_stages)
                                   : solve(method, finer);
  if (!fine.termination.converged()) return {};
  return strain_distance(middle_strains(study_, turn_, speed_, states),
                         middle_strains(study_, finer, speed_, fine.states));
}

/// Where links nearly come into one line, the mechanism nearly loses its hold on itself.
void Linkage::note_change_points() {
  double least = 1.0, where = 0.0;
  for (const double angle : turn_.positions()) {
    const double freedom = turn_.state(angle).freedom;
    if (freedom >= least) continue;
    least = freedom;
    where = angle;
  }
  if (least > near_change_point) return;
  result_.notes.push_back(
      fmt::format("close to a change point at {:.4g} degrees of the drive: links are nearly in one "
                  "line there, and small errors of their lengths matter",
                  turn_.sense() * where / degree));
}

void Linkage::note_reductions() {
  for (std::size_t k = 0; k < result_.flexures.size(); ++k) {
    const ElasticLink& link = turn_.system().layout().members[k].link;
    if (link.whole_size > link.size())
      result_.notes.push_back(
          fmt::format("'{}' has {} unknowns, of which its ends and its {} lowest vibrations with "
                      "both ends held are kept",
                      result_.flexures[k], link.whole_size, link.size() - 6));
  }
}

/// By what factor vibration raises the largest stress of each flexure above the quasi-static one.
void Linkage::note_peaks() {
  const auto of = [&](const char* label) -> const LinkageMotion* {
    for (const LinkageMotion& motion : result_.modelings)
      if (motion.label == label && !motion.flexures.empty()) return &motion;
    return nullptr;
  };
  const LinkageMotion* still = of("quasi_static");
  const LinkageMotion* moving = of("periodic");
  if (!still || !moving) return;
  std::string words;
  for (std::size_t k = 0; k < result_.flexures.size(); ++k) {
    const double rest = find_peak(result_, still->flexures[k].stress).value;
    if (rest == 0.0) continue;
    words += fmt::format("{}{} {:.3g}", words.empty() ? "" : ", ", result_.flexures[k],
                         find_peak(result_, moving->flexures[k].stress).value / rest);
  }
  if (words.empty()) return;
  result_.notes.push_back("largest stress with vibration over the quasi-static one: " + words);
}

void Linkage::warn_of_large_deflections(LinkageMotion& motion) const {
  for (std::size_t k = 0; k < motion.flexures.size(); ++k) {
    const ElasticLink& link = turn_.system().layout().members[k].link;
    const double length = norm(link.action - link.base);
    double largest = 0.0;
    for (const double value : motion.flexures[k].deflection)
      largest = std::max(largest, std::abs(value));
    if (largest <= large_deflection * length) continue;
    motion.remark += fmt::format(
        "{}'{}' deflects by {:.2g} of its length: displacements are not small any more, and linear "
        "theory is off by more than it says",
        motion.remark.empty() ? "" : "; ", result_.flexures[k], largest / length);
  }
}

LinkageMotion Linkage::solve_and_record(Method method) {
  LinkageMotion motion;
  motion.label = name_of(method);
  const auto start = std::chrono::steady_clock::now();
  LinkageSolution solution = solve(method, turn_);
  motion.termination = solution.termination;
  // between positions, where methods look more closely
  if (solution.termination.status == Status::not_run && turn_.failure())
    motion.termination = {Status::stopped, why(*turn_.failure())};
  motion.unknowns = static_cast<int>(turn_.system().size());
  motion.iterations = solution.iterations;
  motion.counted = solution.counted;
  if (motion.counted == "turns" && motion.iterations == 1) motion.counted = "turn";
  motion.remark = solution.remark;
  if (study_.turn_from_rest && (method == Method::midha || method == Method::transient))
    motion.remark += fmt::format("{}turn {} from rest, not the settled one",
                                 motion.remark.empty() ? "" : "; ", *study_.turn_from_rest);
  motion.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (solution.states.empty()) return motion;
  record_elastic_motion(model_, study_, turn_, solution.states, motion);
  warn_of_large_deflections(motion);
  if (solution.termination.converged()) motion.error_estimate = estimate(method, solution.states);
  if (method == Method::periodic) result_.multipliers = solution.multipliers;
  return motion;
}

/// The periodic solution is what others are compared with.
void Linkage::compare() {
  const auto strains = [](const LinkageMotion& motion) {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(motion.flexures.front().strain.size()),
                        static_cast<Eigen::Index>(motion.flexures.size()));
    for (Eigen::Index m = 0; m < all.cols(); ++m)
      for (Eigen::Index i = 0; i < all.rows(); ++i)
        all(i, m) =
            motion.flexures[static_cast<std::size_t>(m)].strain[static_cast<std::size_t>(i)];
    return all;
  };
  for (std::size_t k = 0; k < result_.modelings.size(); ++k)
    if (result_.modelings[k].label == "periodic") result_.reference = k;
  const LinkageMotion& reference = result_.modelings[result_.reference];
  if (reference.flexures.empty()) return;
  for (LinkageMotion& motion : result_.modelings)
    if (&motion != &reference && !motion.flexures.empty())
      motion.difference = strain_distance(strains(motion), strains(reference));
}

LinkageResult Linkage::run(Termination& termination) {
  result_ = make_linkage_names(model_, study_, turn_);
  result_.modeling = modeling_name(study_.modeling);
  result_.damping = damping_of(study_.damping);
  if (!go_round(termination)) return std::move(result_);
  record_rigid_motion(model_, study_, turn_, result_);
  describe_four_bar(turn_, result_);
  find_frequencies(turn_, study_, speed_, result_);
  note_change_points();
  note_reductions();
  termination.status = Status::converged;
  double done = 0.0;
  for (const Method method : study_.methods) {
    if (method == Method::nonlinear) {
      NonlinearComparison comparison =
          compare_with_nonlinear(model_, study_, turn_, result_, keep_going_);
      result_.modelings.push_back(std::move(comparison.motion));
      result_.notes.insert(result_.notes.end(), comparison.notes.begin(), comparison.notes.end());
    } else {
      result_.modelings.push_back(solve_and_record(method));
    }
    done += 0.5 / static_cast<double>(study_.methods.size());
    if (keep_going_ && !keep_going_(done)) {
      termination = {Status::stopped, "cancelled"};
      return std::move(result_);
    }
  }
  compare();
  note_peaks();
  if (study_.speeds)
    result_.speeds = sweep_speeds(model_, study_, [&](double share) {
      return !keep_going_ || keep_going_(0.5 + 0.5 * share);
    });
  for (const LinkageMotion& motion : result_.modelings)
    if (!motion.termination.converged()) {
      termination.status = Status::stopped;
      termination.reason += (termination.reason.empty() ? "" : ", ") + motion.label;
    }
  if (!termination.reason.empty()) termination.reason += " stopped early";
  return std::move(result_);
}

}  // namespace

LinkageResult run_linkage(const Model& model, const LinkageStudy& study, Termination& termination,
                          const std::function<bool(double)>& keep_going) {
  return Linkage(model, study, keep_going).run(termination);
}

}  // namespace flexura

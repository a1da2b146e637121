#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

constexpr int most_frequencies = 100000;
constexpr int most_outputs = 1000000;

/// Rules that the three studies share; `path` is the study's.
struct MotionRules {
  const Model& model;
  const KeyPath& path;
  Mistakes& mistakes;

  void require_within(const KeyPath& key, double value, double least, double greatest) const {
    if (!(value >= least && value <= greatest))
      mistakes.add(key, fmt::format("must lie between {} and {}, is {}", least, greatest, value));
  }

  void check_common(const std::vector<ModelingSettings>& modelings, std::size_t reference,
                    const InertiaSettings& inertia) const {
    for (std::size_t m = 0; m < modelings.size(); ++m) {
      const KeyPath entry = path / "modelings" / m;
      const auto* beam = std::get_if<BeamSettings>(&modelings[m].kind);
      if (beam && beam->theory == BeamSettings::Theory::printed)
        mistakes.add(entry, "the printed elements have no place in motion; 'von_karman' moves");
      if (inertia.lumped && !beam)
        mistakes.add(path / "mass",
                     fmt::format("masses are lumped at the nodes of beam elements, and modeling "
                                 "'{}' has none",
                                 modelings[m].label));
    }
    for (const Flexure& flexure : model.flexures)
      for (std::size_t m = 0; flexure.link && m < modelings.size(); ++m)
        if (std::holds_alternative<LinearSettings>(modelings[m].kind) ||
            std::holds_alternative<ScmbmSettings>(modelings[m].kind))
          mistakes.add(path / "modelings" / m,
                       fmt::format("flexure '{}' is a mesh, whose mass only modeling continuum "
                                   "moves",
                                   flexure.name));
    check_load_ratios(modelings, "in motion", path, mistakes);
    check_modelings(model, modelings, reference, path, mistakes);
  }

  void refuse_constant(const std::vector<Load>& loads, const char* instead) const {
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (loads[i].constant)
        mistakes.add(path / "loads" / i / "constant",
                     fmt::format("constant loads belong to studies of kind path; {}", instead));
  }

  /// What starts as drawn must fit as drawn.
  void refuse_assembly(const std::optional<StudyState>& start, const char* key) const {
    if (start || !needs_assembly(model)) return;
    mistakes.add(path / "kind",
                 fmt::format("this study starts from the mechanism as drawn, and this one is "
                             "assembled from parts that do not fit (misfit, free_length, "
                             "free_angle or preload): a path assembles it, and `{}` takes up a "
                             "state of that",
                             key));
  }

  void check_state(const StudyState& state, const KeyPath& key, bool of_motion) const {
    if (state.study >= model.studies.size()) {
      mistakes.add(key / "study", fmt::format("there is no study number {}", state.study));
      return;
    }
    const Study& other = model.studies[state.study];
    const auto* traced = std::get_if<PathStudy>(&other.kind);
    if (traced) {
      check_load_factor(state.load_factor, *traced, other.name, key / "load_factor");
    } else if (!of_motion || !std::holds_alternative<TransientStudy>(other.kind)) {
      mistakes.add(key / "study", fmt::format("study '{}' is no path{}: it has no state to take up",
                                              other.name, of_motion ? " and no transient" : ""));
    }
  }

  /// Vibrations about a state are found by solvers for symmetric matrices.
  void refuse_followers(const StudyState& about) const {
    if (about.study >= model.studies.size()) return;
    const Study& other = model.studies[about.study];
    const auto* traced = std::get_if<PathStudy>(&other.kind);
    if (!traced) return;
    const auto follows = [](const Load& load) { return load.follower && load.force != Vec2{}; };
    if (std::any_of(traced->loads.begin(), traced->loads.end(), follows))
      mistakes.add(path / "about" / "study",
                   fmt::format("study '{}' has follower loads, which have no potential: vibrations "
                               "about its states have no real frequencies to be sure of. A "
                               "transient shows whether they grow",
                               other.name));
  }

  /// A path by arc length reaches its last load factor from the side on which it starts.
  void check_load_factor(double load_factor, const PathStudy& traced, const std::string& name,
                         const KeyPath& key) const {
    if (!traced.arc_length) {
      require_within(key, load_factor, 0.0, 1.0);
      return;
    }
    const double last = traced.until.load_factor;
    const bool beyond = last > 0.0 ? load_factor > last : load_factor < last;
    mistakes.require_finite(key, load_factor);
    if (beyond)
      mistakes.add(key, fmt::format("{} lies beyond the end of study '{}', at load factor {}",
                                    load_factor, name, last));
  }

  void check_damping(const DampingSettings& damping) const {
    const KeyPath key = path / "damping";
    require_within(key / "modal", damping.modal, 0.0, 1.0);
    mistakes.require_not_negative(key / "mass", damping.mass);
    mistakes.require_not_negative(key / "stiffness", damping.stiffness);
  }
};

/// At time 0; of histories that are no histories at all, 0.
double value_at_start(const TimeHistory& history) {
  if (const auto* table = std::get_if<TableHistory>(&history))
    return table->values().empty() ? 0.0 : table->values().front();
  const auto* other = std::get_if<FunctionHistory>(&history);
  return other && !other->function ? 0.0 : evaluate_history(history, 0.0).value;
}

/// Rules of a transient alone.
struct TransientRules {
  const Model& model;
  const TransientStudy& study;
  const KeyPath& path;
  Mistakes& mistakes;

  void check_something_happens() const {
    if (study.loads.empty() && !study.fields.act() && study.prescribe.empty() &&
        model.drivers.empty() && !study.from)
      mistakes.add(path / "loads",
                   "nothing would move: a transient needs a load, gravity, something prescribed, a "
                   "driver, or a state to start `from`");
  }

  void check_steps() const {
    mistakes.require_positive(path / "duration", study.duration);
    if (study.step == 0.0) {
      mistakes.add(path / "step", "a time step of zero gets nowhere");
    } else if (study.step) {
      mistakes.require_positive(path / "step", *study.step);
      if (study.duration > 0.0 && *study.step > study.duration)
        mistakes.add(path / "step",
                     fmt::format("a step of {} is longer than the study, of duration {}",
                                 *study.step, study.duration));
    } else if (study.method == TransientStudy::Method::energy_momentum) {
      mistakes.add(path / "step",
                   "energy_momentum needs a `step`: its energy balance holds for fixed steps only");
    }
    const MotionRules rules{model, path, mistakes};
    rules.require_within(path / "tolerance", study.tolerance, 1e-12, 1e-1);
    rules.require_within(path / "spectral_radius", study.spectral_radius, 0.0, 1.0);
    mistakes.require_between(path / "outputs", study.outputs, 1, most_outputs);
  }

  void check_histories() const {
    const auto check = [&](const TimeHistory& history, const KeyPath& key) {
      check_history(history, key, mistakes);
      check_history_during(history, study.duration, "the study", key, mistakes);
    };
    for (std::size_t i = 0; i < study.loads.size(); ++i)
      check(study.loads[i].history, path / "loads" / i / "history");
    for (std::size_t i = 0; i < study.prescribe.size(); ++i) {
      check(study.prescribe[i].history, path / "prescribe" / i / "history");
      check_start(study.prescribe[i], path / "prescribe" / i);
    }
    for (const Driver& driver : model.drivers) {
      const KeyPath key = {"drivers", driver.name, "history"};
      const std::string name = fmt::format("study '{}'", path.back());
      check_history_during(driver.history, study.duration, name, key, mistakes);
      const double start = value_at_start(driver.history);
      if (starts_undriven() && std::abs(start) > nothing)
        mistakes.add(key, fmt::format("at time 0 this is {} already, and {} starts with the body "
                                      "where it is drawn",
                                      start, name));
    }
  }

  /// A path leaves drivers where they are drawn.
  bool starts_undriven() const {
    return !study.from ||
           (study.from->study < model.studies.size() &&
            std::holds_alternative<PathStudy>(model.studies[study.from->study].kind));
  }

  /// What is prescribed starts where the mechanism does, and never jumps.
  void check_start(const Prescribed& p, const KeyPath& entry) const {
    if (p.x.value_or(0.0) == 0.0 && p.y.value_or(0.0) == 0.0 && p.rotation.value_or(0.0) == 0.0)
      return;
    const auto* step = std::get_if<StepHistory>(&p.history);
    const double start = value_at_start(p.history);
    if (step && (step->at > 0.0 || !study.from)) {
      mistakes.add(entry,
                   "what is prescribed cannot be elsewhere in no time: a history such as { "
                   "ramp = [0, 1] } takes it there");
    } else if (!study.from && std::abs(start) > nothing) {
      mistakes.add(
          entry / "history",
          fmt::format("at time 0 this is {} already, and the study starts as drawn", start));
    }
  }

  static constexpr double nothing = 1e-9;
};

}  // namespace

void check_motion(const Model& model, const ModesStudy& study, const KeyPath& path,
                  Mistakes& mistakes) {
  const MotionRules rules{model, path, mistakes};
  if (study.about) {
    rules.check_state(*study.about, path / "about", false);
    rules.refuse_followers(*study.about);
  }
  rules.refuse_assembly(study.about, "about");
  mistakes.require_between(path / "count", study.count, 1, largest_mode_count);
  rules.check_common(study.modelings, study.reference, study.inertia);
}

void check_motion(const Model& model, const TransientStudy& study, const KeyPath& path,
                  Mistakes& mistakes) {
  const MotionRules rules{model, path, mistakes};
  const TransientRules own{model, study, path, mistakes};
  own.check_something_happens();
  check_loads(model, study.loads, path, mistakes);
  rules.refuse_constant(study.loads, "in time, a load without a history is there from the start");
  check_fields(model, study.fields, study.modelings, path, mistakes);
  check_prescribed(model, study.prescribe, path, mistakes);
  if (study.from) rules.check_state(*study.from, path / "from", true);
  rules.refuse_assembly(study.from, "from");
  own.check_steps();
  own.check_histories();
  rules.check_damping(study.damping);
  rules.check_common(study.modelings, study.reference, study.inertia);
}

void check_motion(const Model& model, const ResponseStudy& study, const KeyPath& path,
                  Mistakes& mistakes) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const MotionRules rules{model, path, mistakes};
  if (study.loads.empty()) mistakes.add(path / "loads", "a response needs a load to respond to");
  check_loads(model, study.loads, path, mistakes);
  rules.refuse_constant(study.loads, "here every load is an amplitude");
  for (std::size_t i = 0; i < study.loads.size(); ++i)
    if (study.loads[i].follower)
      mistakes.add(path / "loads" / i / "follower",
                   "an amplitude is small and does not turn with its body: the load keeps its "
                   "direction");
  if (study.about) {
    rules.check_state(*study.about, path / "about", false);
    rules.refuse_followers(*study.about);
  }
  rules.refuse_assembly(study.about, "about");
  const KeyPath range = path / "frequencies";
  if (study.logarithmic) {
    mistakes.require_positive(range / "from", study.from / turn);
  } else {
    mistakes.require_not_negative(range / "from", study.from / turn);
  }
  mistakes.require_finite(range / "to", study.to / turn);
  if (study.to <= study.from)
    mistakes.add(range / "to",
                 fmt::format("must be greater than where the range begins, {:.10g}; is {:.10g}",
                             study.from / turn, study.to / turn));
  mistakes.require_between(range / "count", study.count, 2, most_frequencies);
  rules.check_damping(study.damping);
  rules.check_common(study.modelings, study.reference, study.inertia);
}

namespace {

bool is_of_motion(const Study& study) {
  return std::holds_alternative<ModesStudy>(study.kind) ||
         std::holds_alternative<TransientStudy>(study.kind) ||
         std::holds_alternative<ResponseStudy>(study.kind) ||
         std::holds_alternative<LinkageStudy>(study.kind);
}

void check_densities(const Model& model, Mistakes& mistakes) {
  std::vector<bool> told(model.materials.size(), false);
  for (const Flexure& flexure : model.flexures) {
    if (flexure.material >= model.materials.size() || told[flexure.material]) continue;
    const Material& material = model.materials[flexure.material];
    if (material.density) continue;
    told[flexure.material] = true;
    mistakes.add({"materials", material.name, "density"},
                 fmt::format("material '{}' of flexure '{}' needs a density: without it a flexure "
                             "has no inertia",
                             material.name, flexure.name));
  }
}

/// The transient that a study starts from; none if it starts from anything else.
std::optional<std::size_t> transient_before(const Model& model, std::size_t study) {
  const auto* transient = std::get_if<TransientStudy>(&model.studies[study].kind);
  if (!transient || !transient->from || transient->from->study >= model.studies.size()) return {};
  const std::size_t before = transient->from->study;
  const bool moves = std::holds_alternative<TransientStudy>(model.studies[before].kind);
  return moves ? std::optional(before) : std::nullopt;
}

/// Every circle of studies that start from one another is reported once, at the first in the file.
void check_starts(const Model& model, Mistakes& mistakes) {
  std::vector<std::size_t> seen(model.studies.size(), 0);
  for (std::size_t start = 0; start < model.studies.size(); ++start) {
    std::vector<std::size_t> trail;
    std::optional<std::size_t> at = start;
    while (at && seen[*at] == 0) {
      seen[*at] = start + 1;
      trail.push_back(*at);
      at = transient_before(model, *at);
    }
    if (!at || seen[*at] != start + 1) continue;
    std::vector<std::size_t> circle(std::find(trail.begin(), trail.end(), *at), trail.end());
    std::rotate(circle.begin(), std::min_element(circle.begin(), circle.end()), circle.end());
    const std::string& first = model.studies[circle.front()].name;
    std::string names = first;
    for (std::size_t i = 1; i < circle.size(); ++i) names += " -> " + model.studies[circle[i]].name;
    mistakes.add({"studies", first, "from", "study"},
                 circle.size() == 1
                     ? "a study cannot start from its own end"
                     : fmt::format("these studies start from one another: {} -> {}", names, first));
  }
}

}  // namespace

void check_motion_of_all(const Model& model, Mistakes& mistakes) {
  if (std::any_of(model.studies.begin(), model.studies.end(), is_of_motion))
    check_densities(model, mistakes);
  check_starts(model, mistakes);
}

}  // namespace flexura

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

constexpr int most_steps = 100000;
constexpr int most_modes = 1000;

void check_load(const Model& model, const Load& load, const KeyPath& path, Mistakes& mistakes) {
  if (load.body >= model.bodies.size()) {
    mistakes.add(path / "on", fmt::format("there is no body number {}", load.body));
    return;
  }
  const Body& body = model.bodies[load.body];
  if (load.point && *load.point >= body.points.size()) {
    mistakes.add(path / "on",
                 fmt::format("body '{}' has no point number {}", body.name, *load.point));
  }
  if (body.fixed) {
    mistakes.add(path / "on",
                 fmt::format("body '{}' is fixed: a load there has no effect", body.name));
  }
  mistakes.require_finite(path / "force", load.force);
  mistakes.require_finite(path / "moment", load.moment);
}

/// A body has three displacements to prescribe, each once; at points of it they count together.
void check_prescribed(const Model& model, const std::vector<Prescribed>& all, const KeyPath& path,
                      Mistakes& mistakes) {
  std::vector<int> components(model.bodies.size(), 0);
  std::vector<int> turns(model.bodies.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Prescribed& p = all[i];
    const KeyPath entry = path / "prescribe" / i;
    if (p.body >= model.bodies.size()) {
      mistakes.add(entry / "on", fmt::format("there is no body number {}", p.body));
      continue;
    }
    const Body& body = model.bodies[p.body];
    if (p.point && *p.point >= body.points.size()) {
      mistakes.add(entry / "on",
                   fmt::format("body '{}' has no point number {}", body.name, *p.point));
    }
    if (body.fixed) {
      mistakes.add(entry / "on", fmt::format("body '{}' is fixed: it cannot be moved", body.name));
    }
    const bool can_turn = body.fixed || body_can_turn(model, p.body);
    if (p.rotation && !can_turn) {
      mistakes.add(
          entry / "rotation",
          fmt::format("body '{}' hangs on one pin and has no rotation of its own", body.name));
    }
    mistakes.require_finite(entry / "x", p.x.value_or(0.0));
    mistakes.require_finite(entry / "y", p.y.value_or(0.0));
    mistakes.require_finite(entry / "rotation", p.rotation.value_or(0.0));
    components[p.body] += (p.x ? 1 : 0) + (p.y ? 1 : 0) + (p.rotation ? 1 : 0);
    turns[p.body] += p.rotation ? 1 : 0;
    const int most = can_turn ? 3 : 2;
    if (components[p.body] > most || turns[p.body] > 1) {
      mistakes.add(entry,
                   fmt::format("body '{}' is prescribed more than it can move: it has "
                               "{} displacements{}",
                               body.name, most, can_turn ? ", one of them its rotation" : ""));
    }
  }
}

struct StudyRules {
  const Model& model;
  const KeyPath path;
  Mistakes& mistakes;

  void check_loads(const std::vector<Load>& loads) const {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      check_load(model, loads[i], path / "loads" / i, mistakes);
    }
  }

  void operator()(const LinearStudy& study) const {
    check_loads(study.loads);
    refuse_assembly(study.loads);
  }

  /// What these studies find out counts from the drawn state, which must be in equilibrium.
  void refuse_assembly(const std::vector<Load>& loads) const {
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (loads[i].constant)
        mistakes.add(path / "loads" / i / "constant",
                     "constant loads belong to studies of kind path");
    if (needs_assembly(model))
      mistakes.add(path / "kind",
                   "this study counts from the mechanism as drawn, and this one is assembled from "
                   "parts that do not fit (misfit, free_length, free_angle or preload): only "
                   "studies of kind path assemble it");
  }

  void operator()(const PathStudy& study) const {
    if (study.loads.empty() && study.prescribe.empty() && !study.fields.act() &&
        !needs_assembly(model))
      mistakes.add(path / "loads", "a path needs a load, or something to prescribe");
    check_fields(study);
    check_loads(study.loads);
    check_prescribed(model, study.prescribe, path, mistakes);
    mistakes.require_between(path / "steps", study.steps, 1, most_steps);
    if (study.arc_length) check_arc_length(study);
    if (study.stage) check_stage(*study.stage);
    for (std::size_t i = 0; i < study.condense.size(); ++i) {
      const std::size_t body = study.condense[i];
      if (body < model.bodies.size() && model.bodies[body].fixed)
        mistakes.add(path / "condense" / i, fmt::format("body '{}' is fixed: it has no stiffness",
                                                        model.bodies[body].name));
      if (std::count(study.condense.begin(), study.condense.end(), body) > 1)
        mistakes.add(path / "condense" / i, "every body once");
    }
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }

  /// What acts along flexures needs their density or expansion, and a modeling that carries it.
  void check_fields(const PathStudy& study) const {
    const FieldLoads& fields = study.fields;
    for (const SpreadLoad& load : fields.spread) {
      if (load.flexure >= model.flexures.size())
        mistakes.add(path / "loads", fmt::format("there is no flexure number {}", load.flexure));
      mistakes.require_finite(path / "loads", load.per_length);
    }
    mistakes.require_finite(path / "gravity", fields.gravity);
    mistakes.require_finite(path / "temperature", fields.temperature);
    for (const Flexure& flexure : model.flexures) {
      if (flexure.material >= model.materials.size()) continue;
      const Material& material = model.materials[flexure.material];
      if (norm(fields.gravity) > 0.0 && !material.density)
        mistakes.add(path / "gravity", fmt::format("material '{}' of flexure '{}' needs a density",
                                                   material.name, flexure.name));
      if (fields.temperature != 0.0 && !material.thermal_expansion)
        mistakes.add(path / "temperature",
                     fmt::format("material '{}' of flexure '{}' needs a thermal_expansion",
                                 material.name, flexure.name));
    }
    if (!fields.act()) return;
    for (std::size_t m = 0; m < study.modelings.size(); ++m)
      if (!carries_fields(study.modelings[m]))
        mistakes.add(path / "modelings" / m,
                     fmt::format("modeling '{}' carries no loads along its flexures and knows no "
                                 "temperature: linear, scmbm and exact do, and beam: of theory "
                                 "exact with axial and shear strain, von_karman or linear",
                                 modeling_name(study.modelings[m])));
  }

  static bool carries_fields(const ModelingSettings& settings) {
    if (const auto* beam = std::get_if<BeamSettings>(&settings.kind))
      return beam->theory == BeamSettings::Theory::exact
                 ? settings.axial && settings.shear
                 : beam->theory != BeamSettings::Theory::printed;
    return !std::holds_alternative<PrbmSettings>(settings.kind) &&
           !std::holds_alternative<BcmSettings>(settings.kind);
  }

  void check_stage(const StageSettings& stage) const {
    const auto check = [&](const DirectedPlace& place, const char* on, const char* along) {
      if (place.body >= model.bodies.size()) {
        mistakes.add(path / "stage" / on, fmt::format("there is no body number {}", place.body));
      } else if (model.bodies[place.body].fixed) {
        mistakes.add(path / "stage" / on, fmt::format("body '{}' is fixed: it cannot move",
                                                      model.bodies[place.body].name));
      }
      if (place.along && !(norm(*place.along) > 0.0 && std::isfinite(norm(*place.along))))
        mistakes.add(path / "stage" / along, "a direction needs a length that is not zero");
    };
    check(stage.output, "on", "along");
    if (stage.input) check(*stage.input, "input", "input_along");
  }

  void check_arc_length(const PathStudy& study) const {
    const KeyPath until = path / "until";
    mistakes.require_finite(until / "load_factor", study.until.load_factor);
    if (study.until.load_factor == 0.0)
      mistakes.add(until / "load_factor", "the path starts there: another load factor is needed");
    if (study.until.limit_points)
      mistakes.require_between(until / "limit_points", *study.until.limit_points, 1, most_steps);
    if (study.until.steps)
      mistakes.require_between(until / "steps", *study.until.steps, 1, most_steps);
    if (study.branch) {
      mistakes.require_between(path / "branch" / "at", study.branch->at, 1, most_steps);
      if (study.branch->side != 1 && study.branch->side != -1)
        mistakes.add(path / "branch" / "side", "a bifurcation has two sides: 1 and -1");
    }
    check_load_ratios(study.modelings);
  }

  void operator()(const BucklingStudy& study) const {
    if (study.loads.empty()) mistakes.add(path / "loads", "buckling needs a load");
    check_loads(study.loads);
    refuse_assembly(study.loads);
    for (std::size_t i = 0; i < study.loads.size(); ++i)
      if (study.loads[i].follower)
        mistakes.add(path / "loads" / i / "follower",
                     "follower loads have no potential: their critical loads are not those of "
                     "this study. A path with control = \"arc_length\" follows them");
    mistakes.require_between(path / "count", study.count, 1, most_modes);
    for (std::size_t m = 0; m < study.modelings.size(); ++m) {
      const auto* beam = std::get_if<BeamSettings>(&study.modelings[m].kind);
      if (beam && beam->theory == BeamSettings::Theory::printed)
        mistakes.add(path / "modelings" / m,
                     "the printed elements have no place in buckling: a path shows where they lose "
                     "their stiffness; 'von_karman' buckles");
    }
    check_load_ratios(study.modelings);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }

  void operator()(const ModesStudy& study) const {
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }
  void operator()(const TransientStudy& study) const {
    check_loads(study.loads);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }
  void operator()(const ResponseStudy& study) const {
    check_loads(study.loads);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }

  /// Howell's load ratios are found by iteration under load control.
  void check_load_ratios(const std::vector<ModelingSettings>& modelings) const {
    for (std::size_t m = 0; m < modelings.size(); ++m) {
      const auto* prbm = std::get_if<PrbmSettings>(&modelings[m].kind);
      const auto* howell = prbm ? std::get_if<PrbmHowell>(&prbm->parameters) : nullptr;
      if (howell && !howell->load_ratio)
        mistakes.add(path / "modelings" / m,
                     "Howell's parameters follow the load: by arc length they need a load_ratio");
    }
  }

  void operator()(const InverseStudy& study) const {
    if (study.relative.empty()) {
      mistakes.add(path / "relative", "an inverse study needs the displacements to prescribe");
    }
    refuse_assembly({});
    for (std::size_t i = 0; i < study.relative.size(); ++i) {
      const RelativeDisplacement& relative = study.relative[i];
      const KeyPath entry = path / "relative" / i;
      if (relative.flexure >= model.flexures.size()) {
        mistakes.add(entry / "flexure",
                     fmt::format("there is no flexure number {}", relative.flexure));
      }
      mistakes.require_finite(entry / "x", relative.displacement.x);
      mistakes.require_finite(entry / "y", relative.displacement.y);
      mistakes.require_finite(entry / "rotation", relative.rotation);
    }
    mistakes.require_between(path / "steps", study.steps, 1, most_steps);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }
};

}  // namespace

void check_studies(const Model& model, Mistakes& mistakes) {
  for (const Study& study : model.studies) {
    std::visit(StudyRules{model, {"studies", study.name}, mistakes}, study.kind);
  }
}

}  // namespace flexura

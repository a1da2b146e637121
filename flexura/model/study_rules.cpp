#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

constexpr int most_steps = 100000;

struct StudyRules {
  const Model& model;
  const KeyPath path;
  Mistakes& mistakes;

  void operator()(const LinearStudy& study) const {
    check_loads(model, study.loads, path, mistakes);
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
    check_weights(study);
    check_fields(model, study.fields, study.modelings, path, mistakes);
    check_loads(model, study.loads, path, mistakes);
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

  void check_weights(const PathStudy& study) const {
    if (!(norm(study.fields.gravity) > 0.0)) return;
    for (const Flexure& flexure : model.flexures) {
      if (flexure.material >= model.materials.size()) continue;
      const Material& material = model.materials[flexure.material];
      if (!material.density)
        mistakes.add(path / "gravity", fmt::format("material '{}' of flexure '{}' needs a density",
                                                   material.name, flexure.name));
    }
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
    check_load_ratios(study.modelings, "by arc length", path, mistakes);
  }

  void operator()(const BucklingStudy& study) const {
    if (study.loads.empty()) mistakes.add(path / "loads", "buckling needs a load");
    check_loads(model, study.loads, path, mistakes);
    refuse_assembly(study.loads);
    for (std::size_t i = 0; i < study.loads.size(); ++i)
      if (study.loads[i].follower)
        mistakes.add(path / "loads" / i / "follower",
                     "follower loads have no potential: their critical loads are not those of "
                     "this study. A path with control = \"arc_length\" follows them");
    mistakes.require_between(path / "count", study.count, 1, largest_mode_count);
    for (std::size_t m = 0; m < study.modelings.size(); ++m) {
      const auto* beam = std::get_if<BeamSettings>(&study.modelings[m].kind);
      if (beam && beam->theory == BeamSettings::Theory::printed)
        mistakes.add(path / "modelings" / m,
                     "the printed elements have no place in buckling: a path shows where they lose "
                     "their stiffness; 'von_karman' buckles");
      if (std::holds_alternative<ContinuumSettings>(study.modelings[m].kind))
        mistakes.add(path / "modelings" / m,
                     "modeling continuum has no place in buckling: a path notes where a continuum "
                     "loses its stability; exact, beam and bcm buckle");
    }
    check_load_ratios(study.modelings, "by arc length", path, mistakes);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }

  /// ModesStudy, TransientStudy, ResponseStudy and LinkageStudy.
  template <typename MotionStudy>
  void operator()(const MotionStudy& study) const {
    check_motion(model, study, path, mistakes);
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

#include <fmt/format.h>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

constexpr int most_steps = 100000;

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

struct StudyRules {
  const Model& model;
  const KeyPath path;
  Mistakes& mistakes;

  void check_loads(const std::vector<Load>& loads) const {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      check_load(model, loads[i], path / "loads" / i, mistakes);
    }
  }

  void operator()(const LinearStudy& study) const { check_loads(study.loads); }

  void operator()(const PathStudy& study) const {
    if (study.loads.empty()) mistakes.add(path / "loads", "a path needs a load");
    check_loads(study.loads);
    mistakes.require_between(path / "steps", study.steps, 1, most_steps);
    check_modelings(model, study.modelings, study.reference, path, mistakes);
  }

  void operator()(const InverseStudy& study) const {
    if (study.relative.empty()) {
      mistakes.add(path / "relative", "an inverse study needs the displacements to prescribe");
    }
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

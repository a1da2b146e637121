#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

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
class PrescribedRules {
 public:
  PrescribedRules(const Model& model, Mistakes& mistakes)
      : model_(model),
        mistakes_(mistakes),
        pins_(hanging_pins(model)),
        components_(model.bodies.size(), 0),
        turns_(model.bodies.size(), 0) {}

  void check(const Prescribed& p, const KeyPath& entry) {
    if (p.body >= model_.bodies.size()) {
      mistakes_.add(entry / "on", fmt::format("there is no body number {}", p.body));
      return;
    }
    check_target(p, entry);
    mistakes_.require_finite(entry / "x", p.x.value_or(0.0));
    mistakes_.require_finite(entry / "y", p.y.value_or(0.0));
    mistakes_.require_finite(entry / "rotation", p.rotation.value_or(0.0));
    components_[p.body] += (p.x ? 1 : 0) + (p.y ? 1 : 0) + (p.rotation ? 1 : 0);
    turns_[p.body] += p.rotation ? 1 : 0;
    const bool can_turn = !pins_[p.body];
    const int most = can_turn ? 3 : 2;
    if (components_[p.body] > most || turns_[p.body] > 1) {
      mistakes_.add(entry, fmt::format("body '{}' is prescribed more than it can move: it has "
                                       "{} displacements{}",
                                       model_.bodies[p.body].name, most,
                                       can_turn ? ", one of them its rotation" : ""));
    }
  }

 private:
  void check_target(const Prescribed& p, const KeyPath& entry) {
    const Body& body = model_.bodies[p.body];
    if (p.point && *p.point >= body.points.size()) {
      mistakes_.add(entry / "on",
                    fmt::format("body '{}' has no point number {}", body.name, *p.point));
    }
    if (body.fixed) {
      mistakes_.add(entry / "on", fmt::format("body '{}' is fixed: it cannot be moved", body.name));
    }
    const auto& drivers = model_.drivers;
    const auto driver = std::find_if(drivers.begin(), drivers.end(),
                                     [&](const Driver& one) { return one.body == p.body; });
    if (driver != drivers.end() && !body.fixed)
      mistakes_.add(entry / "on", fmt::format("driver '{}' says already how body '{}' moves",
                                              driver->name, body.name));
    if (p.rotation && pins_[p.body]) {
      mistakes_.add(
          entry / "rotation",
          fmt::format("body '{}' hangs on one pin and has no rotation of its own", body.name));
    }
  }

  const Model& model_;
  Mistakes& mistakes_;
  std::vector<std::optional<Vec2>> pins_;
  std::vector<int> components_;
  std::vector<int> turns_;
};

bool carries_fields(const ModelingSettings& settings) {
  if (const auto* beam = std::get_if<BeamSettings>(&settings.kind))
    return beam->theory == BeamSettings::Theory::exact
               ? settings.axial && settings.shear
               : beam->theory != BeamSettings::Theory::printed;
  return !std::holds_alternative<PrbmSettings>(settings.kind) &&
         !std::holds_alternative<BcmSettings>(settings.kind) &&
         !std::holds_alternative<ContinuumSettings>(settings.kind);
}

}  // namespace

void check_loads(const Model& model, const std::vector<Load>& loads, const KeyPath& path,
                 Mistakes& mistakes) {
  for (std::size_t i = 0; i < loads.size(); ++i)
    check_load(model, loads[i], path / "loads" / i, mistakes);
}

void check_prescribed(const Model& model, const std::vector<Prescribed>& all, const KeyPath& path,
                      Mistakes& mistakes) {
  if (all.empty()) return;
  PrescribedRules rules(model, mistakes);
  for (std::size_t i = 0; i < all.size(); ++i) rules.check(all[i], path / "prescribe" / i);
}

void check_fields(const Model& model, const FieldLoads& fields,
                  const std::vector<ModelingSettings>& modelings, const KeyPath& path,
                  Mistakes& mistakes) {
  for (const SpreadLoad& load : fields.spread) {
    if (load.flexure >= model.flexures.size())
      mistakes.add(path / "loads", fmt::format("there is no flexure number {}", load.flexure));
    mistakes.require_finite(path / "loads", load.per_length);
  }
  mistakes.require_finite(path / "gravity", fields.gravity);
  mistakes.require_finite(path / "temperature", fields.temperature);
  for (const Flexure& flexure : model.flexures) {
    if (flexure.material >= model.materials.size() || fields.temperature == 0.0) continue;
    const Material& material = model.materials[flexure.material];
    if (!material.thermal_expansion)
      mistakes.add(path / "temperature",
                   fmt::format("material '{}' of flexure '{}' needs a thermal_expansion",
                               material.name, flexure.name));
  }
  if (!fields.act()) return;
  for (const Flexure& flexure : model.flexures)
    if (flexure.link)
      mistakes.add(path, fmt::format("flexure '{}' is a mesh: gravity, temperature and distributed "
                                     "loads act on strips only",
                                     flexure.name));
  for (std::size_t m = 0; m < modelings.size(); ++m)
    if (!carries_fields(modelings[m]))
      mistakes.add(path / "modelings" / m,
                   fmt::format("modeling '{}' carries no loads along its flexures and knows no "
                               "temperature: linear, scmbm and exact do, and beam: of theory "
                               "exact with axial and shear strain, von_karman or linear",
                               modeling_name(modelings[m])));
}

}  // namespace flexura

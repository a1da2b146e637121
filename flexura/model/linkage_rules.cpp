#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

constexpr int most_positions = 100000;
constexpr int most_elements = 1000;
constexpr int most_speeds = 100000;

struct LinkageRules {
  const Model& model;
  const LinkageStudy& study;
  const KeyPath& path;
  Mistakes& mistakes;

  void check_driver() const {
    if (study.driver >= model.drivers.size()) {
      mistakes.add(path / "driver", fmt::format("there is no driver number {}", study.driver));
      return;
    }
    const Driver& driver = model.drivers[study.driver];
    if (driver.direction)
      mistakes.add(path / "driver",
                   fmt::format("driver '{}' moves a body along a line: a linkage goes round and "
                               "round with one that turns",
                               driver.name));
    else if (!std::holds_alternative<LinearHistory>(driver.history))
      mistakes.add(path / "driver",
                   fmt::format("driver '{}' has an angle with a history: a linkage needs a speed, "
                               "such as speed = \"300 rpm\"; `speed_fluctuation` makes it vary",
                               driver.name));
    if (model.drivers.size() > 1)
      mistakes.add(path / "driver",
                   fmt::format("this model has {} drivers: a linkage has one, and all else follows",
                               model.drivers.size()));
  }

  void check_modeling() const {
    const auto* beam = std::get_if<BeamSettings>(&study.modeling.kind);
    if (beam && beam->theory == BeamSettings::Theory::printed)
      mistakes.add(path / "modeling", "the printed elements have no place in a linkage");
    if (beam && beam->theory == BeamSettings::Theory::linear && !study.modeling.axial)
      mistakes.add(path / "modeling",
                   "axial = false: beams of a linkage have axial strains, which carry their axial "
                   "forces; modeling exact can leave them out");
    mistakes.require_between(path / "elements", study.elements, 1, most_elements);
    for (const LinkageStudy::ElementCount& count : study.flexure_elements)
      if (count.flexure < model.flexures.size())
        mistakes.require_between(path / "elements" / model.flexures[count.flexure].name,
                                 count.elements, 1, most_elements);
  }

  void check_loads_of_turn() const {
    check_loads(model, study.loads, path, mistakes);
    for (std::size_t i = 0; i < study.loads.size(); ++i) {
      const KeyPath entry = path / "loads" / i;
      if (study.loads[i].constant)
        mistakes.add(entry / "constant",
                     "constant loads belong to studies of kind path; over a "
                     "turn, a load without an angle is always there");
      check_history(study.loads[i].history, entry / "angle", mistakes);
      check_history_during(study.loads[i].history, 2.0 * std::numbers::pi, "turn", entry / "angle",
                           mistakes);
    }
    mistakes.require_finite(path / "gravity", norm(study.gravity));
  }

  void check_speeds() const {
    double variation = 0.0;
    for (std::size_t i = 0; i < study.fluctuation.size(); ++i) {
      const KeyPath entry = path / "speed_fluctuation" / i;
      mistakes.require_between(entry / "order", study.fluctuation[i].order, 1, 1000);
      mistakes.require_finite(entry / "amplitude", study.fluctuation[i].amplitude);
      variation += std::abs(study.fluctuation[i].amplitude);
    }
    if (variation >= 1.0)
      mistakes.add(path / "speed_fluctuation",
                   "amplitudes are shares of the mean speed: with 1 or more in all the drive would "
                   "stop or turn back");
    if (!study.speeds) return;
    mistakes.require_positive(path / "speeds" / "from", study.speeds->from);
    if (!(study.speeds->to > study.speeds->from))
      mistakes.add(path / "speeds" / "to", "must be greater than where the range begins");
    mistakes.require_between(path / "speeds" / "count", study.speeds->count, 2, most_speeds);
  }

  /// The nonlinear motion is that of geometrically exact flexures at a constant speed.
  void check_nonlinear() const {
    if (!study.uses(LinkageStudy::Method::nonlinear)) return;
    if (!study.fluctuation.empty())
      mistakes.add(path / "speed_fluctuation",
                   "method nonlinear turns at a constant speed: the other methods let it vary");
    for (const Flexure& flexure : model.flexures)
      if (flexure.link)
        mistakes.add(
            path / "methods",
            fmt::format("method nonlinear takes strips, and flexure '{}' has another shape",
                        flexure.name));
    if (study.damping.modal == 0.0 && study.damping.stiffness == 0.0)
      mistakes.add(path / "damping",
                   "method nonlinear needs damping (modal, or stiffness): without it no motion "
                   "settles to a periodic one");
  }

  void check_rest() const {
    for (const Spring& spring : model.springs)
      mistakes.add(path / "kind",
                   fmt::format("spring '{}' has no place in a linkage yet: studies of kind "
                               "transient have springs and dampers",
                               spring.name));
    if (needs_assembly(model))
      mistakes.add(path / "kind",
                   "a linkage turns as drawn, and this one has parts that do not fit "
                   "(misfit)");
    mistakes.require_between(path / "positions", study.positions, 8, most_positions);
    mistakes.require_between(path / "modes", study.modes, 4, 1000);
    mistakes.require_between(path / "turns", study.turns, 1, 1000000);
    if (study.turn_from_rest) {
      mistakes.require_between(path / "turn_from_rest", *study.turn_from_rest, 1, 1000000);
      if (!study.uses(LinkageStudy::Method::midha) && !study.uses(LinkageStudy::Method::transient))
        mistakes.add(path / "turn_from_rest",
                     "a start from rest is shown by methods midha and transient, and this study "
                     "has neither");
    }
    if (study.midha_modes)
      mistakes.require_between(path / "midha" / "modes", *study.midha_modes, 1, 1000);
    if (study.methods.empty()) mistakes.add(path / "methods", "a linkage needs a method");
    const DampingSettings& damping = study.damping;
    for (const auto& [key, value] :
         {std::pair{"modal", damping.modal}, std::pair{"mass", damping.mass},
          std::pair{"stiffness", damping.stiffness}})
      mistakes.require_not_negative(path / "damping" / key, value);
    if (damping.modal >= 1.0)
      mistakes.add(path / "damping" / "modal", "must be less than 1, which is critical damping");
  }
};

}  // namespace

void check_motion(const Model& model, const LinkageStudy& study, const KeyPath& path,
                  Mistakes& mistakes) {
  const LinkageRules rules{model, study, path, mistakes};
  rules.check_driver();
  rules.check_modeling();
  rules.check_loads_of_turn();
  rules.check_speeds();
  rules.check_nonlinear();
  rules.check_rest();
}

}  // namespace flexura

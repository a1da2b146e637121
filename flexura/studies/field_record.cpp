#include "flexura/studies/field_record.hpp"

#include <cmath>

#include "flexura/geometry/axis_curve.hpp"

namespace flexura {

std::vector<FieldState::OfFlexure> make_fields(const Model& model,
                                               const MechanismState& mechanism) {
  std::vector<FieldState::OfFlexure> fields;
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    auto field = mechanism.stress_field(k);
    if (!field) continue;
    const Pose base = mechanism.base_section(k);
    const Vec2 start = AxisCurve(model.flexures[k].axis).position(0.0);
    const Vec2 turn = unit(base.rotation);
    for (Vec2& place : field->drawn) place = start + place;
    for (Vec2& place : field->places) place = base.position + rotate(base.rotation, place);
    for (PlaneStress& stress : field->stresses) stress = turned(turn.x, turn.y, stress);
    fields.push_back({k, std::move(*field)});
  }
  return fields;
}

std::optional<double> stress_error(const std::vector<FieldState::OfFlexure>& fields) {
  if (fields.empty()) return {};
  double error = 0.0;
  double energy = 0.0;
  for (const auto& [flexure, field] : fields) {
    for (const double part : field.error_energies) error += part;
    energy += field.energy;
  }
  return energy > 0.0 ? std::sqrt(error / energy) : 0.0;
}

std::optional<LargestStress> largest_stress(const std::vector<FieldState::OfFlexure>& fields) {
  std::optional<LargestStress> largest;
  for (const auto& [flexure, field] : fields) {
    for (std::size_t k = 0; k < field.stresses.size(); ++k) {
      const double stress = von_mises_stress(field.stresses[k]);
      if (!largest || stress > largest->von_mises)
        largest = LargestStress{stress, flexure, field.places[k], field.drawn[k]};
    }
  }
  return largest;
}

void add_fields(const Model& model, const PathStudy& study, const TracedPath& traced,
                ModelingPath& path) {
  const bool all = study.stress_fields == PathStudy::KeptFields::every_step;
  if (study.stress_fields == PathStudy::KeptFields::none) return;
  for (std::size_t i = 0; i < traced.states.size(); ++i) {
    const bool last = i + 1 == traced.states.size();
    if (!all && !last) continue;
    const TracedState& state = traced.states[i];
    auto fields = make_fields(model, StillState(*traced.systems[state.system], state.z));
    if (fields.empty()) return;
    if (last) {
      path.stress_error = stress_error(fields);
      path.largest_stress = largest_stress(fields);
    }
    path.fields.push_back({i, std::move(fields)});
  }
}

}  // namespace flexura

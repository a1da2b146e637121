#include "flexura/modelings/flexure_inertia.hpp"

#include "flexura/core/jet2.hpp"

namespace flexura {

SectionInertia FlexureInertia::at(double s) const {
  using Jet = Jet2<2>;
  const SectionProperties section = section_properties(shape, s, length);
  const SectionInertia full{density * section.area, density * section.rotary_second_moment};
  const Jet x = Jet::variable(0, 0.0);
  const Jet y = Jet::variable(1, 0.0);
  return {translation ? translation_energy(x, y, full).second(0, 0) : 0.0,
          rotary ? rotary_energy(x, y, full).second(0, 0) : 0.0};
}

FlexureInertia flexure_inertia(const Model& model, const Flexure& flexure,
                               const InertiaSettings& settings, bool shear) {
  return {model.materials[flexure.material].density.value_or(0.0),
          section_of(model, flexure),
          AxisCurve(flexure.axis).length(),
          settings.translation,
          settings.rotary.value_or(shear),
          settings.shear_rotary,
          settings.lumped};
}

}  // namespace flexura

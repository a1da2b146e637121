#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

FlexureProperties flexure_properties(const Model& model, const Flexure& flexure, bool axial,
                                     bool shear) {
  const Material& material = model.materials[flexure.material];
  const SectionProperties section = section_properties(model.sections[flexure.section].shape);
  const double e = material.youngs_modulus;
  const double g = e / (2.0 * (1.0 + material.poissons_ratio));
  return {AxisCurve(flexure.axis), e * section.second_moment,
          axial ? 1.0 / (e * section.area) : 0.0, shear ? 1.0 / (g * section.shear_area) : 0.0};
}

}  // namespace flexura

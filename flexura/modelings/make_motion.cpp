#include "flexura/modelings/make_motion.hpp"

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/make_system.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {
namespace {

struct MotionPortMaker {
  const FlexureProperties& flexure;
  const FlexureInertia& inertia;
  const Material& material;
  const StripShape& shape;
  const MeshLink* link;  // null for a strip
  double tolerance;

  Vec2 end() const { return flexure.axis.position(flexure.axis.length()); }
  using Port = std::shared_ptr<const MotionPort>;

  Port operator()(const LinearSettings&) const {
    return make_compliant_motion_port(flexure, inertia, end());
  }
  Port operator()(const ScmbmSettings& settings) const {
    const Vec2 at = settings.at == ScmbmSettings::At::end
                        ? end()
                        : elastic_centre(compliance_matrix(flexure, end()), end());
    return make_compliant_motion_port(flexure, inertia, at);
  }
  Port operator()(const PrbmSettings& settings) const {
    return make_prbm_motion_port(flexure, inertia, pseudo_rigid_chain(flexure, settings, {}));
  }
  Port operator()(const ExactSettings& settings) const {
    return make_exact_motion_port(flexure, inertia, settings, tolerance);
  }
  Port operator()(const BeamSettings& settings) const {
    return make_beam_motion_port(flexure, inertia, settings);
  }
  Port operator()(const BcmSettings& settings) const {
    return make_bcm_motion_port(flexure, inertia, settings);
  }
  Port operator()(const ContinuumSettings& settings) const {
    if (link) return make_link_motion_port(*link, material, inertia.density, settings);
    return make_continuum_motion_port(shape, material, inertia.density, settings, tolerance);
  }
};

}  // namespace

std::shared_ptr<const MotionPort> make_motion_port(const Model& model, std::size_t k,
                                                   const FieldLoads& fields,
                                                   const ModelingSettings& settings,
                                                   const InertiaSettings& inertia) {
  const Flexure& flexure = model.flexures[k];
  FlexureProperties properties = flexure_properties(model, flexure, settings.axial, settings.shear);
  properties.field = field_on(model, k, fields);
  properties.field.per_volume = {};  // gravity acts on all mass alike
  const FlexureInertia own = flexure_inertia(model, flexure, inertia, settings.shear);
  const StripShape shape(properties.axis, own.shape);
  const MotionPortMaker maker{
      properties,        own, model.materials[flexure.material], shape, flexure.link.get(),
      settings.tolerance};
  return std::visit(maker, settings.kind);
}

MotionLayout make_motion_layout(const Model& model, const MotionLoads& acting,
                                const ModelingSettings& settings, const InertiaSettings& inertia) {
  MotionLayout layout;
  layout.mechanism = make_layout(model, acting.loads, settings);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    layout.mechanism.bodies[b].moves = !model.bodies[b].fixed;
  for (std::size_t k = 0; k < model.flexures.size(); ++k)
    layout.ports.push_back(make_motion_port(model, k, acting.fields, settings, inertia));
  for (const Load& load : acting.loads) layout.loads.push_back(load.history);
  layout.gravity = acting.fields.gravity;
  layout.mass_damping = acting.damping.mass;
  layout.stiffness_damping = acting.damping.stiffness;
  return layout;
}

}  // namespace flexura

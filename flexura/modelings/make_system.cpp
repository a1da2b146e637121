#include "flexura/modelings/make_system.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/modelings/bcm.hpp"
#include "flexura/modelings/beam.hpp"
#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/continuum.hpp"
#include "flexura/modelings/continuum_link.hpp"
#include "flexura/modelings/exact.hpp"
#include "flexura/modelings/flexure_properties.hpp"
#include "flexura/modelings/prbm.hpp"

namespace flexura {
namespace {

/// A modeling's port, and the point of the tip that its load and displacement are taken at.
struct PlacedPort {
  std::shared_ptr<const TwoPort> port;
  Vec2 at;
};

struct PortMaker {
  const FlexureProperties& flexure;
  const Material& material;
  const StripShape& shape;
  const MeshLink* link;  // null for a strip
  double tolerance;
  std::optional<double> load_ratio;

  Vec2 end() const { return flexure.axis.position(flexure.axis.length()); }

  PlacedPort operator()(const LinearSettings&) const {
    return {std::make_shared<CompliantPort>(flexure, end()), end()};
  }
  PlacedPort operator()(const ScmbmSettings& settings) const {
    const Vec2 at = settings.at == ScmbmSettings::At::end
                        ? end()
                        : elastic_centre(compliance_matrix(flexure, end()), end());
    return {std::make_shared<CompliantPort>(flexure, at), at};
  }
  PlacedPort operator()(const PrbmSettings& settings) const {
    return {make_prbm_port(flexure, pseudo_rigid_chain(flexure, settings, load_ratio)), end()};
  }
  PlacedPort operator()(const ExactSettings& settings) const {
    return {make_exact_port(flexure, settings, tolerance), end()};
  }
  PlacedPort operator()(const BeamSettings& settings) const {
    return {make_beam_port(flexure, settings), end()};
  }
  PlacedPort operator()(const BcmSettings& settings) const {
    return {make_bcm_port(flexure, settings), end()};
  }
  PlacedPort operator()(const ContinuumSettings& settings) const {
    if (link) return {make_link_port(*link, material, settings), end()};
    return {make_continuum_port(shape, material, settings, tolerance), end()};
  }
};

}  // namespace

namespace {

SystemLayout::Joint make_joint(const SystemLayout& layout, const Joint& joint) {
  SystemLayout::Joint made;
  made.base = joint.base;
  made.action = joint.action;
  if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) {
    made.base_arm = pin->at - layout.bodies[joint.base].centre;
    made.action_arm = pin->at - layout.bodies[joint.action].centre;
    return made;
  }
  const Vec2 direction = std::get<PrismaticJoint>(joint.kind).direction;
  made.kind = SystemLayout::Joint::Kind::prismatic;
  made.direction = (1.0 / norm(direction)) * direction;
  return made;
}

}  // namespace

FlexureField field_on(const Model& model, std::size_t flexure, const FieldLoads& fields) {
  const Material& material = model.materials[model.flexures[flexure].material];
  FlexureField field;
  for (const SpreadLoad& load : fields.spread)
    if (load.flexure == flexure) field.per_length = field.per_length + load.per_length;
  field.per_volume = material.density.value_or(0.0) * fields.gravity;
  field.strain = material.thermal_expansion.value_or(0.0) * fields.temperature;
  return field;
}

SystemLayout make_layout(const Model& model, const std::vector<Load>& loads,
                         const ModelingSettings& settings,
                         const std::vector<std::optional<double>>& load_ratios,
                         const FieldLoads& fields) {
  SystemLayout layout;
  layout.constant_fields = fields.constant;
  const auto* beam = std::get_if<BeamSettings>(&settings.kind);
  layout.linearised = std::holds_alternative<LinearSettings>(settings.kind) ||
                      (beam && beam->theory == BeamSettings::Theory::linear);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const auto drives = [b](const Driver& driver) { return driver.body == b; };
    const bool driven = std::any_of(model.drivers.begin(), model.drivers.end(), drives);
    layout.bodies.push_back({body_centre(model, b), !body.fixed && !driven, body_can_turn(model, b),
                             body.mass, body.inertia});
  }
  for (const Joint& joint : model.joints) layout.joints.push_back(make_joint(layout, joint));
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const Flexure& flexure = model.flexures[k];
    FlexureProperties properties =
        flexure_properties(model, flexure, settings.axial, settings.shear);
    properties.field = field_on(model, k, fields);
    const auto ratio = load_ratios.empty() ? std::nullopt : load_ratios[k];
    const StripShape shape(properties.axis, section_of(model, flexure));
    const PortMaker maker{properties,
                          model.materials[flexure.material],
                          shape,
                          flexure.link.get(),
                          settings.tolerance,
                          ratio};
    PlacedPort placed = std::visit(maker, settings.kind);
    const Vec2 end = properties.axis.position(properties.axis.length());
    SystemLayout::Member member;
    member.base = flexure.base;
    member.action = flexure.action;
    member.pinned_base = flexure.pinned_base;
    member.pinned_action = flexure.pinned_action;
    member.arms = {properties.axis.position(0.0) - layout.bodies[flexure.base].centre,
                   end - layout.bodies[flexure.action].centre, placed.at - end};
    member.length = properties.axis.length();
    member.bending_stiffness = properties.bending_stiffness;
    member.port = std::move(placed.port);
    // the base end carries along what acts on the flexure
    const Vec2 dead = properties.load_ahead(0.0);
    if (norm(dead) > 0.0)
      layout.loads.push_back({flexure.base, member.arms.base, dead, 0.0, false, fields.constant});
    member.misfit = flexure.misfit;
    member.misfit_rotation = flexure.misfit_rotation;
    layout.members.push_back(std::move(member));
  }
  for (const Spring& spring : model.springs) {
    const auto arm = [&](const SpringEnd& end) {
      if (!end.point) return Vec2{};
      return model.bodies[end.body].points[*end.point].position - layout.bodies[end.body].centre;
    };
    const Vec2 a = arm(spring.base);
    const Vec2 b = arm(spring.action);
    const Vec2 apart =
        layout.bodies[spring.action.body].centre + b - layout.bodies[spring.base.body].centre - a;
    const double drawn = spring.torsional ? 0.0 : norm(apart);
    const double free =
        spring.preload ? drawn - *spring.preload / spring.stiffness : spring.free.value_or(drawn);
    layout.springs.push_back({spring.base.body, spring.action.body, a, b, spring.stiffness, free,
                              spring.torsional, free - drawn, spring.damping});
  }
  for (const Load& load : loads) {
    const Vec2 centre = layout.bodies[load.body].centre;
    const Vec2 at = load.point ? model.bodies[load.body].points[*load.point].position : centre;
    layout.loads.push_back(
        {load.body, at - centre, load.force, load.moment, load.follower, load.constant});
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].mass > 0.0 && norm(fields.gravity) > 0.0)
      layout.loads.push_back(
          {b, {}, model.bodies[b].mass * fields.gravity, 0.0, false, fields.constant});
  return layout;
}

bool follows_load_ratio(const ModelingSettings& settings) {
  const auto* prbm = std::get_if<PrbmSettings>(&settings.kind);
  const auto* howell = prbm ? std::get_if<PrbmHowell>(&prbm->parameters) : nullptr;
  return howell && !howell->load_ratio;
}

std::vector<std::optional<double>> find_load_ratios(const Model& model, const System& system,
                                                    const std::vector<double>& z) {
  std::vector<std::optional<double>> ratios;
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const AxisCurve axis(model.flexures[k].axis);
    const Vec2 t = unit(axis.tangent_angle(0.0));
    const Eigen::Vector3d load = system.member_load(k, z);
    const Vec2 f{load[0], load[1]};
    const double transverse = std::abs(dot(f, perp(t)));
    // a moment that bends a hundred times more than the force is a pure moment
    const bool moment_alone = axis.length() * norm(f) < 0.01 * std::abs(load[2]);
    if (moment_alone || norm(f) == 0.0)
      ratios.emplace_back();
    else
      ratios.emplace_back(-dot(f, t) / std::max(transverse, 1e-3 * norm(f)));
  }
  return ratios;
}

}  // namespace flexura

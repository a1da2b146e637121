#include "tests/support/mechanism.hpp"

#include <numbers>
#include <stdexcept>

namespace flexura::testing {

Mechanism& Mechanism::material(double youngs_modulus, double poissons_ratio) {
  Material material;
  material.name = "material" + std::to_string(model_.materials.size());
  material.youngs_modulus = youngs_modulus;
  material.poissons_ratio = poissons_ratio;
  model_.materials.push_back(material);
  return *this;
}

Mechanism& Mechanism::section(const Section& shape) {
  model_.sections.push_back({"section" + std::to_string(model_.sections.size()), shape, {}});
  return *this;
}

Mechanism& Mechanism::fixed(const std::string& name) {
  body(name);
  model_.bodies.back().fixed = true;
  return *this;
}

Mechanism& Mechanism::body(const std::string& name) {
  Body body;
  body.name = name;
  model_.bodies.push_back(body);
  return *this;
}

Mechanism& Mechanism::centre(Vec2 at) {
  model_.bodies.back().centre = at;
  return *this;
}

Mechanism& Mechanism::point(const std::string& name, Vec2 at) {
  model_.bodies.back().points.push_back({name, at});
  return *this;
}

Mechanism& Mechanism::flexure(const std::string& base, const std::string& action,
                              const AxisShape& axis) {
  Flexure flexure;
  flexure.name = "f" + std::to_string(model_.flexures.size());
  flexure.base = index(base);
  flexure.action = index(action);
  flexure.axis = axis;
  flexure.material = model_.materials.size() - 1;
  flexure.section = model_.sections.size() - 1;
  model_.flexures.push_back(flexure);
  return *this;
}

Mechanism& Mechanism::link(const std::string& base, const std::string& action, MeshLink shape) {
  flexure(base, action, link_axis(shape));
  model_.flexures.back().link = std::make_shared<const MeshLink>(std::move(shape));
  return *this;
}

Mechanism& Mechanism::pin_base() {
  model_.flexures.back().pinned_base = true;
  return *this;
}

Mechanism& Mechanism::pin_action() {
  model_.flexures.back().pinned_action = true;
  return *this;
}

Mechanism& Mechanism::density(double value) {
  for (Material& material : model_.materials) material.density = value;
  return *this;
}

Mechanism& Mechanism::mass(double mass, double inertia) {
  model_.bodies.back().mass = mass;
  model_.bodies.back().inertia = inertia;
  return *this;
}

Mechanism& Mechanism::free() {
  model_.bodies.back().free = true;
  return *this;
}

Mechanism& Mechanism::pin(const std::string& base, const std::string& action, Vec2 at) {
  model_.joints.push_back({"j" + std::to_string(model_.joints.size()),
                           index(base),
                           index(action),
                           RevoluteJoint{at},
                           {}});
  return *this;
}

Mechanism& Mechanism::slide(const std::string& base, const std::string& action, Vec2 direction) {
  model_.joints.push_back({"j" + std::to_string(model_.joints.size()),
                           index(base),
                           index(action),
                           PrismaticJoint{direction},
                           {}});
  return *this;
}

Mechanism& Mechanism::spring(const std::string& base, const std::string& action, double stiffness,
                             double damping) {
  Spring spring;
  spring.name = "s" + std::to_string(model_.springs.size());
  spring.base.body = index(base);
  spring.action.body = index(action);
  spring.stiffness = stiffness;
  spring.damping = damping;
  model_.springs.push_back(spring);
  return *this;
}

Mechanism& Mechanism::turn(const std::string& body, double amount, TimeHistory history) {
  model_.drivers.push_back({"d" + std::to_string(model_.drivers.size()),
                            index(body),
                            {},
                            amount,
                            std::move(history),
                            {}});
  return *this;
}

std::size_t Mechanism::index(const std::string& body) const {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    if (model_.bodies[b].name == body) return b;
  throw std::invalid_argument("no body " + body);
}

Load Mechanism::load(const std::string& on, Vec2 force, double moment) const {
  const std::size_t dot = on.find('.');
  Load load;
  load.body = index(on.substr(0, dot));
  if (dot != std::string::npos) {
    const auto& points = model_.bodies[load.body].points;
    std::size_t p = 0;
    while (points.at(p).name != on.substr(dot + 1)) ++p;
    load.point = p;
  }
  load.force = force;
  load.moment = moment;
  return load;
}

Load Mechanism::follower(const std::string& on, Vec2 force, double moment) const {
  Load load = this->load(on, force, moment);
  load.follower = true;
  return load;
}

/// E = 1, nu = 0: G = 1/2.
Mechanism& with_stiffness(Mechanism& mechanism, const Stiffness& stiffness) {
  GeneralSection section;
  section.area = stiffness.axial;
  section.second_moment = stiffness.bending;
  section.shear_area = 2.0 * stiffness.shear;
  return mechanism.material(1.0, 0.0).section(section);
}

Mechanism arc_chain() {
  constexpr double pi = std::numbers::pi;
  Mechanism chain;
  chain.material(2100.0, 0.35).section(RectangleSection{0.1, 1.0});
  chain.fixed("ground").body("link2").body("link3").body("link4").point("E", {19.093, 15.750});
  chain.flexure("ground", "link2", ArcAxis{{0.0, 3.0}, 3.0, -pi / 2.0, -4.0 * pi / 3.0});
  chain.flexure("link2", "link3", ArcAxis{{9.093, 8.25}, 3.5, -5.0 * pi / 6.0, 5.0 * pi / 6.0});
  chain.flexure("link3", "link4", ArcAxis{{12.593, 15.75}, 2.5, -pi / 2.0, -1.5 * pi});
  return chain;
}

Mechanism single_flexure(const AxisShape& axis) {
  Mechanism single;
  single.material(2100.0, 0.35).section(RectangleSection{0.1, 1.0});
  single.fixed("ground").body("stage").flexure("ground", "stage", axis);
  return single;
}

Mechanism cantilever(const Stiffness& stiffness, double length) {
  Mechanism beam;
  with_stiffness(beam, stiffness).fixed("ground").body("tip");
  beam.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {length, 0.0}});
  return beam;
}

Mechanism portal_frame() {
  GeneralSection leg;
  leg.area = 27.4434e-6;
  leg.second_moment = 0.170325e-9;
  GeneralSection coupler;
  coupler.area = 20.6257e-6;
  coupler.second_moment = 0.128012e-9;
  Mechanism frame;
  frame.material(1103.61e6, 0.35).fixed("ground").body("left").body("right");
  frame.section(leg).flexure("ground", "left", LineAxis{{0.0, 0.0}, {0.0, 0.7}});
  frame.section(coupler).flexure("left", "right", LineAxis{{0.0, 0.7}, {0.4, 0.7}});
  frame.section(leg).flexure("right", "ground", LineAxis{{0.4, 0.7}, {0.4, 0.0}});
  return frame;
}

Mechanism parallelogram() {
  Mechanism stage;
  stage.material(210e3, 0.3).section(RectangleSection{0.5, 10.0});
  stage.fixed("ground").body("stage").centre({50.0, 15.0}).point("P", {60.0, 15.0});
  stage.flexure("ground", "stage", LineAxis{{0.0, 0.0}, {50.0, 0.0}});
  stage.flexure("ground", "stage", LineAxis{{0.0, 30.0}, {50.0, 30.0}});
  return stage;
}

Mechanism lee_frame() {
  GeneralSection section;
  section.area = 6.0;
  section.second_moment = 2.0;
  Mechanism frame;
  frame.material(720.0, 0.3).section(section).fixed("ground").body("corner").body("loaded");
  frame.flexure("ground", "corner", LineAxis{{0.0, 0.0}, {0.0, 120.0}}).pin_base();
  frame.flexure("corner", "loaded", LineAxis{{0.0, 120.0}, {24.0, 120.0}});
  frame.flexure("loaded", "ground", LineAxis{{24.0, 120.0}, {120.0, 120.0}}).pin_action();
  return frame;
}

}  // namespace flexura::testing

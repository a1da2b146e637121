#include "flexura/modelings/make_linkage.hpp"

#include <algorithm>
#include <numeric>

#include "flexura/modelings/linkage_links.hpp"
#include "flexura/modelings/make_motion.hpp"

namespace flexura {
namespace {

constexpr int most_modes = 40;  // of a flexure with both ends held

/// Sets that grow together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  /// The smaller root stays.
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

Vec2 end_of(const Flexure& flexure, bool base) {
  const AxisEnds ends = axis_ends(flexure.axis);
  return base ? ends.base : ends.action;
}

/// A body's centre or, where it hangs on a pin, that pin.
Vec2 reference_place(const Model& model, std::size_t body,
                     const std::vector<std::optional<Vec2>>& hanging) {
  return hanging[body] ? *hanging[body] : body_centre(model, body);
}

class LinkageMaker {
 public:
  LinkageMaker(const Model& model, const LinkageStudy& study, bool refined)
      : model_(model),
        study_(study),
        refined_(refined),
        parts_(rigid_parts(model, study.driver)),
        bodies_(body_places(model, parts_)) {}
  LinkageLayout make();

 private:
  LinkageLayout::Place place_on(std::size_t body, Vec2 at) const {
    LinkageLayout::Place place = bodies_[body];
    place.at = at;
    return place;
  }
  bool is_held(std::size_t body) const {
    return model_.bodies[body].fixed || body == model_.drivers[study_.driver].body;
  }
  ElasticLink make_link(std::size_t flexure) const;
  void add_member(std::size_t flexure);
  void add_end(std::size_t flexure, bool base, LinkageLayout::Member& member);
  void add_joints();
  void add_loads();

  const Model& model_;
  const LinkageStudy& study_;
  bool refined_;
  RigidParts parts_;
  std::vector<LinkageLayout::Place> bodies_;
  LinkageLayout layout_;
};

bool is_plain_beam(const ModelingSettings& settings) {
  const auto* beam = std::get_if<BeamSettings>(&settings.kind);
  return beam && beam->theory == BeamSettings::Theory::linear;
}

ElasticLink LinkageMaker::make_link(std::size_t k) const {
  ModelingSettings settings = study_.modeling;
  const Flexure& flexure = model_.flexures[k];
  if (flexure.link && !std::holds_alternative<ContinuumSettings>(settings.kind)) {
    settings.kind = ContinuumSettings{};  // there is no other way to take it
    settings.axial = settings.shear = true;
  }
  const FlexureProperties properties =
      flexure_properties(model_, flexure, settings.axial, settings.shear);
  InertiaSettings inertia;
  inertia.rotary = study_.rotary_inertia;
  const FlexureInertia own = flexure_inertia(model_, flexure, inertia, settings.shear);
  if (is_plain_beam(settings))
    return make_beam_link(properties, own, (refined_ ? 2 : 1) * study_.elements_of(k));
  std::shared_ptr<const MotionPort> port = make_motion_port(model_, k, {}, settings, inertia);
  // the mesh of a link of any shape stays, with more of its vibrations
  const auto finer = refined_ && !flexure.link ? port->refined() : nullptr;
  if (finer) port = finer;
  return make_port_link(properties, own, model_.materials[flexure.material], *port,
                        refined_ ? 2 * most_modes : most_modes);
}

/// Clamped ends move with their bodies; pinned ones share a place with them.
void LinkageMaker::add_end(std::size_t k, bool base, LinkageLayout::Member& member) {
  const Flexure& flexure = model_.flexures[k];
  const std::size_t body = base ? flexure.base : flexure.action;
  const bool pinned = base ? flexure.pinned_base : flexure.pinned_action;
  const std::size_t first = base ? 0 : 3;
  const Vec2 at = end_of(flexure, base);
  const auto& own = bodies_[body].unknowns;
  if (!pinned) {
    for (std::size_t i = 0; i < 3; ++i) member.unknowns[first + i] = own[i];
    return;
  }
  member.unknowns[first + 2] = layout_.unknowns++;
  const bool at_centre = norm(at - bodies_[body].centre) <= 1e-9 * layout_.rigid.size;
  if (is_held(body)) return;
  if (at_centre) {
    member.unknowns[first] = own[0];
    member.unknowns[first + 1] = own[1];
    return;
  }
  member.unknowns[first] = layout_.unknowns++;
  member.unknowns[first + 1] = layout_.unknowns++;
  const LinkageLayout::Place end{
      member.part, {member.unknowns[first], member.unknowns[first + 1], -1}, at, at};
  layout_.pins.push_back({end, place_on(body, at)});
}

void LinkageMaker::add_member(std::size_t k) {
  const Flexure& flexure = model_.flexures[k];
  LinkageLayout::Member member{make_link(k), parts_.of_flexures[k], {}};
  const auto arm = [&](bool base) {
    const std::size_t body = base ? flexure.base : flexure.action;
    const bool pinned = base ? flexure.pinned_base : flexure.pinned_action;
    return pinned ? Vec2{} : end_of(flexure, base) - bodies_[body].centre;
  };
  attach_with_arms(member.link, arm(true), arm(false));
  member.unknowns.assign(static_cast<std::size_t>(member.link.size()), -1);
  add_end(k, true, member);
  add_end(k, false, member);
  for (std::size_t i = 6; i < member.unknowns.size(); ++i) member.unknowns[i] = layout_.unknowns++;
  layout_.members.push_back(std::move(member));
}

void LinkageMaker::add_joints() {
  for (const Joint& joint : model_.joints) {
    if (is_held(joint.base) && is_held(joint.action)) continue;
    if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) {
      layout_.pins.push_back({place_on(joint.base, pin->at), place_on(joint.action, pin->at)});
      continue;
    }
    const Vec2 along = std::get<PrismaticJoint>(joint.kind).direction;
    const Vec2 at = bodies_[joint.action].centre;
    layout_.slides.push_back(
        {place_on(joint.base, at), place_on(joint.action, at), (1.0 / norm(along)) * along});
  }
}

void LinkageMaker::add_loads() {
  for (const Load& load : study_.loads) {
    const Body& body = model_.bodies[load.body];
    const Vec2 at = load.point ? body.points[*load.point].position : bodies_[load.body].centre;
    layout_.loads.push_back(
        {place_on(load.body, at), load.force, load.moment, load.follower, load.history});
  }
  layout_.gravity = study_.gravity;
}

LinkageLayout LinkageMaker::make() {
  layout_.rigid = parts_.layout;
  for (const LinkageLayout::Place& place : bodies_)
    for (const int unknown : place.unknowns)
      layout_.unknowns = std::max(layout_.unknowns, unknown + 1);
  for (std::size_t k = 0; k < model_.flexures.size(); ++k) add_member(k);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const Body& body = model_.bodies[b];
    if (body.mass > 0.0 || body.inertia > 0.0)
      layout_.masses.push_back({bodies_[b], body.mass, body.inertia});
  }
  add_joints();
  add_loads();
  return std::move(layout_);
}

}  // namespace

LinkageLayout make_linkage(const Model& model, const LinkageStudy& study, bool refined) {
  return LinkageMaker(model, study, refined).make();
}

RigidParts rigid_parts(const Model& model, std::size_t driver) {
  const std::size_t bodies = model.bodies.size();
  const std::vector<std::optional<Vec2>> hanging = hanging_pins(model);
  Sets sets(1 + bodies + model.flexures.size());  // 0: the ground
  for (std::size_t b = 0; b < bodies; ++b)
    if (model.bodies[b].fixed) sets.join(0, 1 + b);
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const Flexure& flexure = model.flexures[k];
    if (!flexure.pinned_base) sets.join(1 + flexure.base, 1 + bodies + k);
    if (!flexure.pinned_action) sets.join(1 + flexure.action, 1 + bodies + k);
  }
  RigidParts parts;
  std::vector<std::size_t> number(1 + bodies + model.flexures.size(), 0);
  parts.layout.parts.push_back({});
  const auto part_of = [&](std::size_t item, Vec2 centre, bool turns) {
    const std::size_t root = sets.root(item);
    if (root != 0 && number[root] == 0) {
      number[root] = parts.layout.parts.size();
      parts.layout.parts.push_back({turns, centre});
    }
    return number[root];
  };
  const std::size_t driven = model.drivers[driver].body;
  parts.layout.driven = part_of(1 + driven, body_centre(model, driven), true);
  for (std::size_t b = 0; b < bodies; ++b)
    parts.of_bodies.push_back(
        part_of(1 + b, reference_place(model, b, hanging), !hanging[b].has_value()));
  for (std::size_t k = 0; k < model.flexures.size(); ++k)
    parts.of_flexures.push_back(part_of(1 + bodies + k, end_of(model.flexures[k], true), true));
  for (std::size_t k = 0; k < model.flexures.size(); ++k)
    for (const bool base : {true, false}) {
      const Flexure& flexure = model.flexures[k];
      if (!(base ? flexure.pinned_base : flexure.pinned_action)) continue;
      parts.layout.pins.push_back({parts.of_flexures[k],
                                   parts.of_bodies[base ? flexure.base : flexure.action],
                                   end_of(flexure, base)});
    }
  for (const Joint& joint : model.joints) {
    const std::size_t base = parts.of_bodies[joint.base], action = parts.of_bodies[joint.action];
    if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind))
      parts.layout.pins.push_back({base, action, pin->at});
    else
      parts.layout.slides.push_back({base, action, std::get<PrismaticJoint>(joint.kind).direction,
                                     reference_place(model, joint.action, hanging)});
  }
  for (RigidLinkageLayout::Slide& slide : parts.layout.slides)
    slide.direction = (1.0 / norm(slide.direction)) * slide.direction;
  parts.layout.size = mechanism_size(model);
  return parts;
}

std::vector<LinkageLayout::Place> body_places(const Model& model, const RigidParts& parts) {
  const std::vector<std::optional<Vec2>> hanging = hanging_pins(model);
  std::vector<LinkageLayout::Place> places;
  int unknowns = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Vec2 centre = reference_place(model, b, hanging);
    LinkageLayout::Place place{parts.of_bodies[b], {-1, -1, -1}, centre, centre};
    bool driven = false;
    for (const Driver& driver : model.drivers) driven = driven || driver.body == b;
    if (!model.bodies[b].fixed && !driven) {
      place.unknowns = {unknowns, unknowns + 1, hanging[b] ? -1 : unknowns + 2};
      unknowns += hanging[b] ? 2 : 3;
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace flexura

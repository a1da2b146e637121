#include <fmt/format.h>

#include <cmath>

#include "flexura/model/held_motions.hpp"
#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

bool has_direction(Vec2 direction) {
  const double length = norm(direction);
  return length > 0.0 && std::isfinite(length);
}

void check_bodies(const Model& model, const Joint& joint, const KeyPath& path, Mistakes& mistakes) {
  for (const std::size_t body : {joint.base, joint.action})
    if (body >= model.bodies.size()) {
      mistakes.add(path, fmt::format("there is no body number {}", body));
      return;
    }
  const Body& base = model.bodies[joint.base];
  const Body& action = model.bodies[joint.action];
  if (joint.base == joint.action) {
    mistakes.add(path,
                 fmt::format("a joint joins two different bodies, here both are '{}'", base.name));
  } else if (base.fixed && action.fixed) {
    mistakes.add(path,
                 fmt::format("'{}' and '{}' are both fixed: a joint between them does nothing",
                             base.name, action.name));
  }
}

void check_joint(const Model& model, const Joint& joint, Mistakes& mistakes) {
  const KeyPath path = {"joints", joint.name};
  if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) {
    check_bodies(model, joint, path / "revolute", mistakes);
    mistakes.require_finite(path / "at", pin->at);
    return;
  }
  check_bodies(model, joint, path / "prismatic" / "bodies", mistakes);
  if (!has_direction(std::get<PrismaticJoint>(joint.kind).direction))
    mistakes.add(path / "prismatic" / "direction", "a direction needs a length that is not zero");
}

/// "joints 'P' and 'R'", of what was found to hold the same as a joint.
std::string in_words(const Model& model, const std::vector<Holder>& holders) {
  std::string text;
  for (std::size_t i = 0; i < holders.size(); ++i) {
    const bool driver = holders[i].kind == Holder::Kind::driver;
    const bool first_of_kind = i == 0 || holders[i].kind != holders[i - 1].kind;
    const bool several = i + 1 < holders.size() && holders[i + 1].kind == holders[i].kind;
    if (i > 0) text += i + 1 == holders.size() ? " and " : ", ";
    if (first_of_kind)
      text += fmt::format("{}{} ", driver ? "driver" : "joint", several ? "s" : "");
    const auto& name =
        driver ? model.drivers[holders[i].index].name : model.joints[holders[i].index].name;
    text += "'" + name + "'";
  }
  return text;
}

}  // namespace

void check_joints(const Model& model, Mistakes& mistakes) {
  for (const Joint& joint : model.joints) check_joint(model, joint, mistakes);
}

void check_redundant_joints(const Model& model, Mistakes& mistakes) {
  for (const RedundantJoint& redundant : find_redundant_joints(model)) {
    const std::string& name = model.joints[redundant.joint].name;
    mistakes.add({"joints", name},
                 fmt::format("as drawn, joint '{}' holds again what {} hold{} already: leave one "
                             "out, or let a flexure give way",
                             name, in_words(model, redundant.holders),
                             redundant.holders.size() == 1 ? "s" : ""));
  }
}

}  // namespace flexura

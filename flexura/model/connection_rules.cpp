#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// Sets of bodies that hang together, all bodies whose place is given in one: fixed and driven ones
/// (union-find with path halving).
class Groups {
 public:
  explicit Groups(const Model& model) : parent_(model.bodies.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      if (model.bodies[i].fixed) parent_[i] = ground();
    }
    for (const Driver& driver : model.drivers) {
      if (driver.body < model.bodies.size()) join(driver.body, ground());
    }
  }

  std::size_t root(std::size_t body) {
    while (parent_[body] != body) {
      parent_[body] = parent_[parent_[body]];
      body = parent_[body];
    }
    return body;
  }

  /// False if the two hung together before.
  bool join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[a] = b;
    return a != b;
  }

  bool held(std::size_t body) { return root(body) == root(ground()); }

 private:
  std::size_t ground() const { return parent_.size() - 1; }

  std::vector<std::size_t> parent_;
};

/// Of a flexure or a joint.
template <typename Link>
bool indices_valid(const Model& model, const Link& link) {
  return link.base < model.bodies.size() && link.action < model.bodies.size();
}

/// A study that looks for equilibria, in words; nothing for those of motion, and for `inverse`,
/// which places every body itself.
struct Equilibria {
  std::optional<std::string> operator()(const LinearStudy&) const { return "linear"; }
  std::optional<std::string> operator()(const PathStudy&) const { return "path"; }
  std::optional<std::string> operator()(const BucklingStudy&) const { return "buckling"; }
  template <typename Other>
  std::optional<std::string> operator()(const Other&) const {
    return {};
  }
};

/// What flies has no equilibrium under loads.
void check_flying(const Model& model, std::size_t flying, Mistakes& mistakes) {
  for (const Study& study : model.studies) {
    const auto kind = std::visit(Equilibria{}, study.kind);
    if (!kind) continue;
    mistakes.add(
        {"studies", study.name, "kind"},
        fmt::format("nothing holds body '{}', which is free: what flies has no equilibrium "
                    "that a study of kind {} could find",
                    model.bodies[flying].name, *kind));
  }
}

/// The flexures of an `inverse` study must form a spanning forest that grows from fixed bodies.
void check_forest(const Model& model, const InverseStudy& study, const KeyPath& path,
                  Mistakes& mistakes) {
  Groups placed(model);
  for (std::size_t i = 0; i < study.relative.size(); ++i) {
    const RelativeDisplacement& relative = study.relative[i];
    if (relative.flexure >= model.flexures.size()) return;  // reported with the study itself
    const Flexure& flexure = model.flexures[relative.flexure];
    if (!indices_valid(model, flexure)) return;
    const KeyPath entry = path / "relative" / i;
    if (!placed.join(flexure.base, flexure.action)) {
      mistakes.add(entry / "flexure",
                   fmt::format("the displacements given before already place both '{}' and '{}' "
                               "that '{}' joins; each moving body must be reached exactly once",
                               model.bodies[flexure.base].name, model.bodies[flexure.action].name,
                               flexure.name));
    }
  }
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    if (placed.held(body)) continue;
    mistakes.add(path / "relative",
                 fmt::format("the displacements do not reach body '{}' from a fixed body; each "
                             "moving body must be reached exactly once",
                             model.bodies[body].name));
  }
}

}  // namespace

void check_connections(const Model& model, Mistakes& mistakes) {
  Groups groups(model);
  for (const Flexure& flexure : model.flexures)
    if (indices_valid(model, flexure)) groups.join(flexure.base, flexure.action);
  for (const Joint& joint : model.joints)
    if (indices_valid(model, joint)) groups.join(joint.base, joint.action);
  const auto& bodies = model.bodies;
  if (std::all_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.fixed; })) {
    mistakes.add_independent({"bodies"}, "there is no moving body: nothing to analyse");
    return;
  }
  const bool any_given = std::any_of(bodies.begin(), bodies.end(),
                                     [](const Body& body) { return body.fixed || body.free; });
  if (!any_given && model.drivers.empty()) {
    mistakes.add_independent({"bodies"},
                             "no body is fixed; one needs `fixed = true`, or `free = true` if it "
                             "flies");
    return;  // it explains why nothing is held
  }
  std::unordered_set<std::size_t> flying;
  std::optional<std::size_t> first;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (!bodies[body].free || groups.held(body)) continue;
    flying.insert(groups.root(body));
    if (!first) first = body;
  }
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (groups.held(body) || flying.contains(groups.root(body))) continue;
    mistakes.add_independent({"bodies", bodies[body].name},
                             "nothing holds this body: no chain of flexures and joints leads from "
                             "it to a fixed or driven body; `free = true` lets it fly");
  }
  if (first) check_flying(model, *first, mistakes);
}

void check_forests(const Model& model, Mistakes& mistakes) {
  for (const Study& study : model.studies) {
    const auto* inverse = std::get_if<InverseStudy>(&study.kind);
    if (!inverse || inverse->relative.empty()) continue;
    check_forest(model, *inverse, {"studies", study.name}, mistakes);
  }
}

}  // namespace flexura

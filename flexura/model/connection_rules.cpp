#include <fmt/format.h>

#include <numeric>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// Sets of bodies that hang together, all fixed bodies in one (union-find with path halving).
class Groups {
 public:
  explicit Groups(const Model& model) : parent_(model.bodies.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      if (model.bodies[i].fixed) parent_[i] = ground();
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

bool indices_valid(const Model& model, const Flexure& flexure) {
  return flexure.base < model.bodies.size() && flexure.action < model.bodies.size();
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
  for (const Flexure& flexure : model.flexures) {
    if (indices_valid(model, flexure)) groups.join(flexure.base, flexure.action);
  }
  bool any_fixed = false;
  bool any_moving = false;
  for (const Body& body : model.bodies) (body.fixed ? any_fixed : any_moving) = true;
  if (!any_moving) {
    mistakes.add_independent({"bodies"}, "there is no moving body: nothing to analyse");
  } else if (!any_fixed) {
    mistakes.add_independent({"bodies"}, "no body is fixed; one needs `fixed = true`");
    return;  // it explains why nothing is held
  }
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    if (groups.held(body)) continue;
    mistakes.add_independent({"bodies", model.bodies[body].name},
                             "nothing holds this body: no chain of flexures leads from it to a "
                             "fixed body");
  }
}

void check_forests(const Model& model, Mistakes& mistakes) {
  for (const Study& study : model.studies) {
    const auto* inverse = std::get_if<InverseStudy>(&study.kind);
    if (!inverse || inverse->relative.empty()) continue;
    check_forest(model, *inverse, {"studies", study.name}, mistakes);
  }
}

}  // namespace flexura

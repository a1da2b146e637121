#include "flexura/model/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "flexura/model/rules.hpp"

namespace flexura {

std::string to_text(const KeyPath& path) {
  std::string text;
  for (const std::string& key : path) {
    if (!text.empty() && !key.starts_with('[')) text += '.';
    text += key;
  }
  return text;
}

KeyPath operator/(KeyPath path, std::string key) {
  path.push_back(std::move(key));
  return path;
}

KeyPath operator/(KeyPath path, std::size_t index) {
  return std::move(path) / fmt::format("[{}]", index);
}

namespace {

const char* cure_of_sign(double value) { return value < 0.0 ? "; check the sign" : ""; }

}  // namespace

void Mistakes::require_finite(const KeyPath& path, double value) {
  if (!std::isfinite(value)) add(path, fmt::format("must be finite, is {}", value));
}

void Mistakes::require_finite(const KeyPath& path, Vec2 value) {
  if (!std::isfinite(value.x) || !std::isfinite(value.y)) {
    add(path, fmt::format("must be finite, is [{}, {}]", value.x, value.y));
  }
}

void Mistakes::require_positive(const KeyPath& path, double value) {
  if (!(value > 0.0)) {
    add(path, fmt::format("must be greater than 0, is {}{}", value, cure_of_sign(value)));
  } else {
    require_finite(path, value);
  }
}

void Mistakes::require_not_negative(const KeyPath& path, double value) {
  if (!(value >= 0.0)) {
    add(path, fmt::format("must not be negative, is {}{}", value, cure_of_sign(value)));
  } else {
    require_finite(path, value);
  }
}

void Mistakes::require_between(const KeyPath& path, int value, int least, int greatest) {
  if (value < least || value > greatest) {
    add(path, fmt::format("must lie between {} and {}, is {}", least, greatest, value));
  }
}

std::vector<Mistake> find_mistakes(const Model& model, const ValidationScope& scope) {
  Mistakes mistakes;
  check_names(model, mistakes);
  check_entities(model, mistakes);
  check_springs(model, mistakes);
  check_joints(model, mistakes);
  check_drivers(model, mistakes);
  check_studies(model, mistakes);
  check_motion_of_all(model, mistakes);
  if (scope.connections) check_connections(model, mistakes);
  if (scope.connections) check_forests(model, mistakes);
  if (scope.pins) check_redundant_joints(model, mistakes);
  if (scope.pins) check_pins(model, mistakes);
  return std::move(mistakes).take();
}

namespace {

/// The `source` fields of a model's entities, by the first two keys of their paths.
class Sources {
 public:
  explicit Sources(const Model& model) {
    add("materials", model.materials);
    add("sections", model.sections);
    add("bodies", model.bodies);
    add("flexures", model.flexures);
    add("springs", model.springs);
    add("joints", model.joints);
    add("drivers", model.drivers);
    add("studies", model.studies);
  }

  SourcePosition of(const KeyPath& path) const {
    if (path.size() < 2) return {};
    const auto at = positions_.find({path[0], path[1]});
    return at == positions_.end() ? SourcePosition{} : at->second;
  }

 private:
  template <typename Entities>
  void add(const std::string& kind, const Entities& entities) {
    for (const auto& entity : entities) positions_.try_emplace({kind, entity.name}, entity.source);
  }

  std::map<std::pair<std::string, std::string>, SourcePosition> positions_;
};

}  // namespace

Diagnostics validate_model(const Model& model) {
  const Sources sources(model);
  Diagnostics diagnostics;
  for (const Mistake& mistake : find_mistakes(model, {})) {
    diagnostics.push_back(
        {sources.of(mistake.path), to_text(mistake.path) + ": " + mistake.message});
  }
  std::stable_sort(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& a, const Diagnostic& b) { return a.position < b.position; });
  return diagnostics;
}

}  // namespace flexura

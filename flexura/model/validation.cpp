#include "flexura/model/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/model/rules.hpp"

namespace flexura {

std::string to_text(const KeyPath& path) {
  std::string text;
  for (const std::string& key : path) {
    if (!text.empty() && key.front() != '[') text += '.';
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
    add(path, fmt::format("must be greater than 0, is {}", value));
  } else {
    require_finite(path, value);
  }
}

void Mistakes::require_not_negative(const KeyPath& path, double value) {
  if (!(value >= 0.0)) {
    add(path, fmt::format("must not be negative, is {}", value));
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
  check_studies(model, mistakes);
  if (scope.connections) check_connections(model, mistakes);
  if (scope.connections) check_forests(model, mistakes);
  if (scope.pins) check_pins(model, mistakes);
  return std::move(mistakes).take();
}

namespace {

template <typename Entity>
SourcePosition find_source(const std::vector<Entity>& entities, const std::string& name) {
  for (const Entity& entity : entities) {
    if (entity.name == name) return entity.source;
  }
  return {};
}

}  // namespace

SourcePosition source_of(const Model& model, const KeyPath& path) {
  if (path.size() < 2) return {};
  if (path[0] == "materials") return find_source(model.materials, path[1]);
  if (path[0] == "sections") return find_source(model.sections, path[1]);
  if (path[0] == "bodies") return find_source(model.bodies, path[1]);
  if (path[0] == "flexures") return find_source(model.flexures, path[1]);
  if (path[0] == "studies") return find_source(model.studies, path[1]);
  return {};
}

Diagnostics validate_model(const Model& model) {
  Diagnostics diagnostics;
  for (const Mistake& mistake : find_mistakes(model, {})) {
    diagnostics.push_back(
        {source_of(model, mistake.path), to_text(mistake.path) + ": " + mistake.message});
  }
  std::stable_sort(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& a, const Diagnostic& b) { return a.position < b.position; });
  return diagnostics;
}

}  // namespace flexura

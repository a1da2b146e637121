#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace flexura {

/// The moving body that carries a point: the longest body name that "body.point" starts with,
/// since names may themselves contain dots. Index into names.bodies; the names are those of a
/// PathResult or a ModeResult.
template <class Names>
std::optional<std::size_t> owner_of_point(const Names& names, std::size_t point) {
  const std::string_view name = names.points[point];
  std::optional<std::size_t> owner;
  for (std::size_t b = 0; b < names.bodies.size(); ++b) {
    const std::string_view body = names.bodies[b];
    const bool carries = name.size() > body.size() && name.substr(0, body.size()) == body &&
                         name[body.size()] == '.';
    if (carries && (!owner || body.size() > names.bodies[*owner].size())) owner = b;
  }
  return owner;
}

}  // namespace flexura

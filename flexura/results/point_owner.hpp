#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// The moving body that carries a point: the longest body name that "body.point" starts with,
/// since names may themselves contain dots. Index into path.bodies.
inline std::optional<std::size_t> owner_of_point(const PathResult& path, std::size_t point) {
  const std::string_view name = path.points[point];
  std::optional<std::size_t> owner;
  for (std::size_t b = 0; b < path.bodies.size(); ++b) {
    const std::string_view body = path.bodies[b];
    const bool carries = name.size() > body.size() && name.substr(0, body.size()) == body &&
                         name[body.size()] == '.';
    if (carries && (!owner || body.size() > path.bodies[*owner].size())) owner = b;
  }
  return owner;
}

}  // namespace flexura

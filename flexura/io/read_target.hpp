#pragma once

#include <fmt/format.h>

#include <string>

#include "flexura/io/read_entities.hpp"
#include "flexura/io/read_studies.hpp"
#include "flexura/io/reading.hpp"

namespace flexura {

/// "body" or "body.point", into `body` and `point` of a Load, a Prescribed or a SpringEnd.
template <typename Target>
void read_target(Reading& reading, const Place& place, const StudyNames& names, Target& target) {
  const auto text = read_text(reading, place);
  if (!text) return;
  const auto dot = text->find('.');
  target.body = names.body_names.resolve(reading, place, text->substr(0, dot));
  if (dot == std::string::npos || target.body == NameIndex::none) return;
  const Body& body = names.bodies[target.body];
  NameIndex points("point", !reading.has_mistake({"bodies", body.name, "points"}),
                   fmt::format(" of body '{}'", body.name));
  for (const Point& point : body.points) points.add(point.name);
  target.point = points.resolve(reading, place, text->substr(dot + 1));
}

}  // namespace flexura

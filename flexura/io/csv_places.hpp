#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "flexura/io/csv_writer.hpp"
#include "flexura/results/path_result.hpp"
#include "flexura/results/point_owner.hpp"

// The columns that say where everything is, shared by the files of paths, modes and motions.

namespace flexura {

/// The points of every body, in the order of the columns; at last those that no body claims.
template <class Names>
std::vector<std::vector<std::size_t>> points_by_body(const Names& names) {
  std::vector<std::vector<std::size_t>> points(names.bodies.size() + 1);
  for (std::size_t p = 0; p < names.points.size(); ++p) {
    points[owner_of_point(names, p).value_or(names.bodies.size())].push_back(p);
  }
  return points;
}

/// Columns of the places of all bodies, points and flexures behind `columns`.
template <class Names>
std::vector<std::string> place_columns(const Names& names, std::vector<std::string> columns) {
  const auto add = [&](const std::string& name, std::initializer_list<const char*> suffixes) {
    for (const char* suffix : suffixes) columns.push_back(name + suffix);
  };
  const auto points = points_by_body(names);
  for (std::size_t b = 0; b < points.size(); ++b) {
    if (b < names.bodies.size()) add(names.bodies[b], {".x", ".y", ".rotation"});
    for (const std::size_t p : points[b]) add(names.points[p], {".x", ".y"});
  }
  for (const std::string& flexure : names.flexures) {
    add(flexure, {".mid.x", ".mid.y", ".mid.rotation"});
  }
  return columns;
}

/// Those and the reactions of a PathResult or a MotionResult, behind `columns`.
template <class Names>
std::vector<std::string> state_columns(const Names& names, std::vector<std::string> columns) {
  columns = place_columns(names, std::move(columns));
  for (const HeldPlace& held : names.held) {
    for (const char* suffix : {".reaction.x", ".reaction.y", ".reaction.moment"}) {
      columns.push_back(held.name + suffix);
    }
  }
  return columns;
}

/// The places of a PathState or the displacements of a ModeShape.
template <class State>
void add_places(CsvWriter& csv, const std::vector<std::vector<std::size_t>>& points,
                const State& state) {
  for (std::size_t b = 0; b < points.size(); ++b) {
    if (b + 1 < points.size())
      csv.vector(state.bodies[b].position).number(state.bodies[b].rotation);
    for (const std::size_t p : points[b]) csv.vector(state.points[p]);
  }
  for (const Pose& mid : state.mids) csv.vector(mid.position).number(mid.rotation);
}

/// What state_columns names, of a state.
inline void add_state(CsvWriter& csv, const std::vector<std::vector<std::size_t>>& points,
                      std::size_t held, const PathState& state) {
  add_places(csv, points, state);
  // The undeformed state may come without: nothing holds it.
  for (std::size_t h = 0; h < held; ++h) {
    const Reaction r = state.reactions.empty() ? Reaction{} : state.reactions[h];
    csv.vector(r.force).number(r.moment);
  }
}

}  // namespace flexura

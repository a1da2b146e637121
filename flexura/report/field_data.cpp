#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "flexura/report/data_json.hpp"

namespace flexura::report_data {
namespace {

constexpr std::size_t most_quads = 3000;     // of one state
constexpr std::size_t quads_of_all = 12000;  // of all states of a modeling
constexpr std::size_t least_quads = 400;
constexpr std::size_t most_rows = 7;
constexpr double stress_steps = 5000.0;  // more shades than anyone tells apart

/// So many of `count` things, evenly, first and last among them.
std::vector<std::size_t> chosen(std::size_t count, std::size_t most) {
  const std::size_t n = std::min(count, std::max<std::size_t>(most, 2));
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < n; ++i) indices.push_back((i * (count - 1) + (n - 1) / 2) / (n - 1));
  return indices;
}

/// What the page can colour by, under the names that its scripts have for it.
struct Shown {
  const char* key;
  double (*value)(const PlaneStress&);
};
constexpr std::array quantities = {
    Shown{"von_mises", von_mises_stress},
    Shown{"first", [](const PlaneStress& s) { return principal_stress(s).first; }},
    Shown{"second", [](const PlaneStress& s) { return principal_stress(s).second; }},
    Shown{"xx", [](const PlaneStress& s) { return s.xx; }},
    Shown{"yy", [](const PlaneStress& s) { return s.yy; }},
    Shown{"xy", [](const PlaneStress& s) { return s.xy; }},
};

/// Least and largest of every quantity over all nodes, those left out below among them.
Json ranges_json(const FieldState& state) {
  Json ranges;
  for (const Shown& shown : quantities) {
    double least = INFINITY, largest = -INFINITY;
    for (const auto& [flexure, field] : state.flexures) {
      for (const PlaneStress& stress : field.stresses) {
        least = std::min(least, shown.value(stress));
        largest = std::max(largest, shown.value(stress));
      }
    }
    ranges[shown.key] = {rounded(least), rounded(largest)};
  }
  return ranges;
}

double largest_component(const ModelingPath& modeling) {
  double largest = 0.0;
  for (const FieldState& state : modeling.fields)
    for (const auto& [flexure, field] : state.flexures)
      for (const PlaneStress& s : field.stresses)
        for (const double part : {s.xx, s.yy, s.xy, s.zz})
          largest = std::max(largest, std::abs(part));
  return largest;
}

bool has_stress_across(const ModelingPath& modeling) {
  for (const auto& [flexure, field] : modeling.fields.back().flexures)
    for (const PlaneStress& s : field.stresses)
      if (s.zz != 0.0) return true;
  return false;
}

/// Stresses as whole multiples of `unit`, one after the other.
class Stresses {
 public:
  Stresses(double unit, bool across) : unit_(unit), across_(across) {}
  void add(const PlaneStress& s) {
    for (const double value : {s.xx, s.yy, s.xy}) add(value);
    if (across_) add(s.zz);
  }
  Json take() { return std::move(list_); }

 private:
  void add(double value) {
    list_.push_back(unit_ > 0.0 ? static_cast<std::int64_t>(std::lround(value / unit_)) : 0);
  }
  double unit_;
  bool across_;
  Json list_ = Json::array();
};

/// A mesh as it is: it cannot be thinned out. `pieces` has four nodes each, of a triangle the last
/// one twice; `border` the nodes at either end of every side that no other piece has.
Json mesh_json(const FieldState::OfFlexure& of, double unit, bool across,
               const DrawnCoordinates& coordinates) {
  const StressField& field = of.field;
  Stresses stresses(unit, across);
  for (const PlaneStress& stress : field.stresses) stresses.add(stress);
  Json pieces = Json::array();
  std::set<std::pair<std::size_t, std::size_t>> sides;
  field.for_pieces([&](const StressField::Piece& piece) {
    for (const std::size_t node : piece.nodes) pieces.push_back(node);
    for (std::size_t k = 0; k < piece.corners; ++k) {
      const std::size_t a = piece.nodes[k], b = piece.nodes[(k + 1) % piece.corners];
      if (sides.erase({b, a}) == 0) sides.insert({a, b});
    }
  });
  Json border = Json::array();
  for (const auto& [a, b] : sides) {
    border.push_back(a);
    border.push_back(b);
  }
  return {{"flexure", of.flexure},
          {"pieces", std::move(pieces)},
          {"border", std::move(border)},
          {"places", coordinates(field.places)},
          {"stresses", stresses.take()}};
}

/// Some of a strip's nodes.
Json strip_json(const FieldState::OfFlexure& of, std::size_t most, double unit, bool across,
                const DrawnCoordinates& coordinates) {
  const StressField& field = of.field;
  const std::vector<std::size_t> rows = chosen(field.rows, most_rows);
  const std::vector<std::size_t> columns = chosen(field.columns, most / (rows.size() - 1) + 1);
  std::vector<Vec2> places;
  Stresses stresses(unit, across);
  for (const std::size_t column : columns) {
    for (const std::size_t row : rows) {
      const std::size_t node = field.node(column, row);
      places.push_back(field.places[node]);
      stresses.add(field.stresses[node]);
    }
  }
  return {{"flexure", of.flexure},
          {"rows", rows.size()},
          {"places", coordinates(places)},
          {"stresses", stresses.take()}};
}

}  // namespace

Json stress_fields_json(const ModelingPath& modeling, const DrawnCoordinates& coordinates) {
  if (modeling.fields.empty()) return nullptr;
  const double unit = largest_component(modeling) / stress_steps;
  const bool across = has_stress_across(modeling);
  const std::size_t of_state =
      std::clamp(quads_of_all / modeling.fields.size(), least_quads, most_quads);
  Json states = Json::array();
  for (const FieldState& state : modeling.fields) {
    Json flexures = Json::array();
    for (const FieldState::OfFlexure& of : state.flexures)
      flexures.push_back(of.field.pieces.empty() ? strip_json(of, of_state / state.flexures.size(),
                                                              unit, across, coordinates)
                                                 : mesh_json(of, unit, across, coordinates));
    states.push_back({{"state", state.state},
                      {"ranges", ranges_json(state)},
                      {"flexures", std::move(flexures)}});
  }
  return {{"unit", rounded(unit)},
          {"across", across},
          {"error", optional_number(modeling.stress_error)},
          {"states", std::move(states)}};
}

}  // namespace flexura::report_data

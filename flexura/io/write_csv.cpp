#include "flexura/io/write_csv.hpp"

#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "flexura/results/point_owner.hpp"

namespace flexura {
namespace {

/// Names are the engineer's: quoted where they hold what separates fields.
std::string field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Rows of named columns. Remembers the first value that is not a finite number.
class CsvWriter {
 public:
  explicit CsvWriter(std::vector<std::string> columns) : columns_(std::move(columns)) {
    for (const std::string& name : columns_) separate() += field(name);
    end_row();
  }

  CsvWriter& word(const std::string& text) {
    separate() += field(text);
    return *this;
  }
  CsvWriter& number(double value) {
    if (!std::isfinite(value) && error_.empty()) {
      error_ = fmt::format("row {}: {} is not a finite number", row_, columns_[column_]);
    }
    // Shortest text that reads back the same; + 0.0 writes the negative zero as 0.
    fmt::format_to(std::back_inserter(separate()), "{}", value + 0.0);
    return *this;
  }
  CsvWriter& vector(Vec2 v) { return number(v.x).number(v.y); }
  void end_row() {
    text_ += '\n';
    column_ = 0;
    ++row_;
  }

  CsvText result() && {
    return error_.empty() ? CsvText{std::move(text_), {}} : CsvText{{}, std::move(error_)};
  }

 private:
  std::string& separate() {
    if (column_++ > 0) text_ += ',';
    return text_;
  }

  std::vector<std::string> columns_;
  std::string text_;
  std::string error_;
  std::size_t column_ = 0;
  int row_ = -1;  // the header; data rows count from 0, as the steps do
};

/// The points of every body, in the order of the columns; at last those that no body claims.
template <class Names>
std::vector<std::vector<std::size_t>> points_by_body(const Names& path) {
  std::vector<std::vector<std::size_t>> points(path.bodies.size() + 1);
  for (std::size_t p = 0; p < path.points.size(); ++p) {
    points[owner_of_point(path, p).value_or(path.bodies.size())].push_back(p);
  }
  return points;
}

/// Columns of the places of all bodies, points and flexures behind `columns`.
template <class Names>
std::vector<std::string> place_columns(const Names& path, std::vector<std::string> columns) {
  const auto add = [&](const std::string& name, std::initializer_list<const char*> suffixes) {
    for (const char* suffix : suffixes) columns.push_back(name + suffix);
  };
  const auto points = points_by_body(path);
  for (std::size_t b = 0; b < points.size(); ++b) {
    if (b < path.bodies.size()) add(path.bodies[b], {".x", ".y", ".rotation"});
    for (const std::size_t p : points[b]) add(path.points[p], {".x", ".y"});
  }
  for (const std::string& flexure : path.flexures) {
    add(flexure, {".mid.x", ".mid.y", ".mid.rotation"});
  }
  return columns;
}

std::vector<std::string> path_columns(const PathResult& path) {
  std::vector<std::string> columns = place_columns(path, {"step", "load_factor"});
  for (const HeldPlace& held : path.held) {
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

}  // namespace

CsvText make_path_csv(const PathResult& path, const ModelingPath& modeling) {
  const auto points = points_by_body(path);
  CsvWriter csv(path_columns(path));
  int step = 0;
  for (const PathState& state : modeling.states) {
    csv.word(std::to_string(step++)).number(state.load_factor);
    add_places(csv, points, state);
    // The undeformed state may come without: nothing holds it.
    for (std::size_t h = 0; h < path.held.size(); ++h) {
      const Reaction r = state.reactions.empty() ? Reaction{} : state.reactions[h];
      csv.vector(r.force).number(r.moment);
    }
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText make_members_csv(const PathResult& path, const ModelingPath& modeling) {
  CsvWriter csv({"flexure", "s", "x", "y", "rotation", "axial_force", "shear_force",
                 "bending_moment", "stress"});
  for (std::size_t f = 0; f < modeling.members.size(); ++f) {
    for (const MemberStation& m : modeling.members[f]) {
      csv.word(path.flexures[f]).number(m.s).vector(m.section.position);
      csv.number(m.section.rotation).number(m.axial_force).number(m.shear_force);
      csv.number(m.bending_moment).number(m.stress);
      csv.end_row();
    }
  }
  return std::move(csv).result();
}

CsvText make_stage_csv(const ModelingPath& modeling) {
  CsvWriter csv({"step",
                 "load_factor",
                 "k_xx",
                 "k_xy",
                 "k_xr",
                 "k_yx",
                 "k_yy",
                 "k_yr",
                 "k_rx",
                 "k_ry",
                 "k_rr",
                 "stiff",
                 "soft",
                 "ratio",
                 "soft_direction",
                 "along",
                 "across",
                 "rotation",
                 "centre_x",
                 "centre_y",
                 "centre_drift",
                 "geometric_advantage",
                 "mechanical_advantage"});
  const auto optional = [&](const std::optional<double>& value) {
    value ? csv.number(*value) : csv.word("");
  };
  for (std::size_t k = 0; k < modeling.stage.size(); ++k) {
    csv.word(std::to_string(k)).number(modeling.states[k].load_factor);
    const std::optional<StageState>& state = modeling.stage[k];
    for (std::size_t i = 0; i < 9; ++i)
      optional(state && state->stiffness ? std::optional((*state->stiffness)[i]) : std::nullopt);
    optional(state ? state->stiff : std::nullopt);
    optional(state ? state->soft : std::nullopt);
    optional(state && state->stiff && state->soft ? std::optional(*state->stiff / *state->soft)
                                                  : std::nullopt);
    optional(state && state->soft ? std::optional(state->soft_direction) : std::nullopt);
    optional(state ? std::optional(state->along) : std::nullopt);
    optional(state ? std::optional(state->across) : std::nullopt);
    optional(state ? std::optional(state->rotation) : std::nullopt);
    const bool turns = state && state->instant_centre;
    optional(turns ? std::optional(state->instant_centre->x) : std::nullopt);
    optional(turns ? std::optional(state->instant_centre->y) : std::nullopt);
    optional(turns ? std::optional(state->centre_drift) : std::nullopt);
    optional(state ? state->geometric_advantage : std::nullopt);
    optional(state ? state->mechanical_advantage : std::nullopt);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText make_buckling_csv(const ModelingModes& modes) {
  CsvWriter csv({"mode", "load_factor"});
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    csv.word(std::to_string(k + 1)).number(modes.modes[k].value).end_row();
  }
  return std::move(csv).result();
}

CsvText make_shapes_csv(const ModeResult& names, const ModelingModes& modes) {
  const auto points = points_by_body(names);
  CsvWriter csv(place_columns(names, {"mode"}));
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    csv.word(std::to_string(k + 1));
    add_places(csv, points, modes.modes[k].shape);
    csv.end_row();
  }
  return std::move(csv).result();
}

}  // namespace flexura

#include "flexura/io/write_csv.hpp"

#include <optional>
#include <string>
#include <utility>

#include "flexura/io/csv_places.hpp"

namespace flexura {

CsvText make_path_csv(const PathResult& path, const ModelingPath& modeling) {
  const auto points = points_by_body(path);
  CsvWriter csv(state_columns(path, {"step", "load_factor"}));
  int step = 0;
  for (const PathState& state : modeling.states) {
    csv.word(std::to_string(step++)).number(state.load_factor);
    add_state(csv, points, path.held.size(), state);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText make_members_csv(const std::vector<std::string>& flexures,
                         const std::vector<std::vector<MemberStation>>& members) {
  CsvWriter csv({"flexure", "s", "x", "y", "rotation", "axial_force", "shear_force",
                 "bending_moment", "stress"});
  for (std::size_t f = 0; f < members.size(); ++f) {
    for (const MemberStation& m : members[f]) {
      csv.word(flexures[f]).number(m.s).vector(m.section.position);
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

#include "tests/report/sample_field.hpp"

#include <algorithm>

namespace flexura::sample {
namespace {

constexpr std::size_t rows = 5;
constexpr double depth = 0.1;

StressField make_strip(const ModelingPath& path, const PathState& state, std::size_t flexure) {
  const std::vector<Vec2>& axis = state.axes[flexure];
  const std::vector<Vec2>& start = path.states[0].axes[flexure];
  const std::vector<MemberStation>& members = path.members[flexure];
  StressField field;
  field.columns = axis.size();
  field.rows = rows;
  field.order_across = rows - 1;
  for (std::size_t c = 0; c < axis.size(); ++c) {
    const std::size_t next = std::min(c + 1, axis.size() - 1);
    const Vec2 ahead = axis[next] - axis[next - 1];
    const Vec2 t = (1.0 / norm(ahead)) * ahead;
    const double bending = state.load_factor * members[std::min(c, members.size() - 1)].stress;
    for (std::size_t r = 0; r < rows; ++r) {
      const double share = static_cast<double>(r) / (rows - 1) - 0.5;
      field.drawn.push_back(start[c] + share * depth * perp(t));
      field.places.push_back(axis[c] + share * depth * perp(t));
      field.stresses.push_back(turned(t.x, t.y, {-2.0 * share * bending, 0.0, 0.0, 0.0}));
    }
  }
  field.error_energies.assign(axis.size() - 1, 1e-6);
  field.energy = 1.0;
  return field;
}

}  // namespace

void add_stress_fields(ModelingPath& path, bool every_step) {
  for (std::size_t i = every_step ? 0 : path.states.size() - 1; i < path.states.size(); ++i) {
    FieldState fields;
    fields.state = i;
    for (std::size_t f = 0; f < path.members.size(); ++f)
      fields.flexures.push_back({f, make_strip(path, path.states[i], f)});
    path.fields.push_back(std::move(fields));
  }
  path.stress_error = 4e-3;
}

}  // namespace flexura::sample

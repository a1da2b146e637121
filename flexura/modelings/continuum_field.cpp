#include <algorithm>
#include <cmath>

#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_port.hpp"
#include "flexura/modelings/continuum_stress.hpp"

namespace flexura {
namespace {

/// Recovers a continuous stress after Zienkiewicz and Zhu (Int. J. Num. Meth. Eng. 24, 1987): that
/// of the quadrature points, taken to the nodes of their element and there averaged by volume. It
/// is taken along in axes that follow the strip, so that its turning is no error of the stress, and
/// the sides of the strip, which are free, carry none across themselves.
class StressRecovery {
 public:
  StressRecovery(const ContinuumStrip& strip, const std::vector<Vec2>& moved);

  template <class Density>
  StressField run(const Density& density, const double* strains);

 private:
  /// The strip's direction where shape functions have these slopes along the element.
  Vec2 along(std::size_t ex, std::size_t ey, const double* slopes) const;
  Vec2 along_at_node(std::size_t ex, std::size_t ey, std::size_t a) const;
  template <class Density>
  PlaneStress point_stress(const Density& density, const double* strains, std::size_t ex,
                           std::size_t ey, std::size_t g) const;
  template <class Density>
  void add_element(const Density& density, const double* strains, std::size_t ex, std::size_t ey);
  void average();
  void measure(std::size_t ex, std::size_t ey);
  void turn_to_axes();
  double energy(const PlaneStress& s) const {
    return stress_energy(strip_.material, strip_.settings.plane, s);
  }

  const ContinuumStrip& strip_;
  const StripMesh& mesh_;
  std::size_t per_;                    // nodes of an element
  std::size_t in_column_;              // of its nodes
  std::vector<double> to_nodes_;       // [node][quadrature point]
  std::vector<double> column_slopes_;  // [node along][node along]
  std::vector<PlaneStress> raw_;       // of every quadrature point, in axes that follow the strip
  std::vector<Vec2> directions_;       // of the strip at the nodes
  std::vector<double> weights_;        // of the nodes
  StressField field_;
};

StressRecovery::StressRecovery(const ContinuumStrip& strip, const std::vector<Vec2>& moved)
    : strip_(strip),
      mesh_(strip.mesh),
      per_(mesh_.nodes_per_element()),
      in_column_(mesh_.cross_line.order() + 1) {
  const std::size_t in_row = mesh_.line.order() + 1;
  for (std::size_t i = 0; i < in_row; ++i) {
    const std::vector<double> slopes = mesh_.line.slopes(mesh_.line.place(i));
    column_slopes_.insert(column_slopes_.end(), slopes.begin(), slopes.end());
    const std::vector<double> n = through_gauss(in_row, mesh_.line.place(i));
    for (std::size_t j = 0; j < in_column_; ++j) {
      const std::vector<double> m = through_gauss(in_column_, mesh_.cross_line.place(j));
      for (std::size_t g = 0; g < per_; ++g)
        to_nodes_.push_back(n[g / in_column_] * m[g % in_column_]);
    }
  }
  raw_.resize(strip.elements() * per_);
  directions_.resize(mesh_.nodes.size());
  weights_.resize(mesh_.nodes.size(), 0.0);
  field_.columns = mesh_.columns;
  field_.rows = mesh_.rows;
  field_.order_along = mesh_.line.order();
  field_.order_across = mesh_.cross_line.order();
  field_.drawn = mesh_.nodes;
  field_.places = mesh_.nodes;
  for (std::size_t k = 0; k < moved.size(); ++k) field_.places[k] = field_.places[k] + moved[k];
  field_.stresses.resize(mesh_.nodes.size());
  field_.error_energies.resize(strip.elements(), 0.0);
}

Vec2 StressRecovery::along(std::size_t ex, std::size_t ey, const double* slopes) const {
  Vec2 sum;
  for (std::size_t a = 0; a < per_; ++a)
    sum = sum + slopes[a] * field_.places[mesh_.element_node(ex, ey, a)];
  return sum;
}

Vec2 StressRecovery::along_at_node(std::size_t ex, std::size_t ey, std::size_t a) const {
  const std::size_t in_row = mesh_.line.order() + 1;
  const double* slopes = column_slopes_.data() + a / in_column_ * in_row;
  Vec2 sum;
  for (std::size_t k = 0; k < in_row; ++k)
    sum = sum +
          slopes[k] * field_.places[mesh_.element_node(ex, ey, k * in_column_ + a % in_column_)];
  return (1.0 / norm(sum)) * sum;
}

template <class Density>
PlaneStress StressRecovery::point_stress(const Density& density, const double* strains,
                                         std::size_t ex, std::size_t ey, std::size_t g) const {
  const std::size_t at = mesh_.element(ex, ey) * per_ + g;
  const Vec2 by_xi = along(ex, ey, mesh_.by_xi.data() + g * per_);
  const Vec2 by_eta = along(ex, ey, mesh_.by_eta.data() + g * per_);
  const DeformationGradient f = deformation_gradient(by_xi, by_eta, mesh_.maps[at].inverse);
  const Vec2 rotation{f.f11 + f.f22, f.f21 - f.f12};  // of the polar decomposition
  const Vec2 r = (1.0 / norm(rotation)) * rotation;
  const Vec2 t = (1.0 / norm(by_xi)) * by_xi;
  return turned(dot(r, t), cross(t, r), rotated_stress(density, strains + 3 * at));
}

template <class Density>
void StressRecovery::add_element(const Density& density, const double* strains, std::size_t ex,
                                 std::size_t ey) {
  PlaneStress* raw = raw_.data() + mesh_.element(ex, ey) * per_;
  double volume = 0.0;
  for (std::size_t g = 0; g < per_; ++g) {
    raw[g] = point_stress(density, strains, ex, ey, g);
    volume += mesh_.maps[mesh_.element(ex, ey) * per_ + g].volume;
  }
  for (std::size_t a = 0; a < per_; ++a) {
    const std::size_t node = mesh_.element_node(ex, ey, a);
    PlaneStress sum;
    for (std::size_t g = 0; g < per_; ++g) sum = sum + to_nodes_[a * per_ + g] * raw[g];
    field_.stresses[node] = field_.stresses[node] + volume * sum;
    directions_[node] = directions_[node] + volume * along_at_node(ex, ey, a);
    weights_[node] += volume;
  }
}

void StressRecovery::average() {
  for (std::size_t c = 0; c < mesh_.columns; ++c) {
    for (std::size_t r = 0; r < mesh_.rows; ++r) {
      const std::size_t node = mesh_.node(c, r);
      PlaneStress& stress = field_.stresses[node];
      stress = (1.0 / weights_[node]) * stress;
      directions_[node] = (1.0 / norm(directions_[node])) * directions_[node];
      const bool on_face = c == 0 || c + 1 == mesh_.columns;
      if (!on_face && (r == 0 || r + 1 == mesh_.rows)) stress.yy = stress.xy = 0.0;
    }
  }
}

void StressRecovery::measure(std::size_t ex, std::size_t ey) {
  const std::size_t element = mesh_.element(ex, ey);
  for (std::size_t g = 0; g < per_; ++g) {
    PlaneStress smooth;
    for (std::size_t a = 0; a < per_; ++a)
      smooth = smooth + mesh_.values[g * per_ + a] * field_.stresses[mesh_.element_node(ex, ey, a)];
    const std::size_t at = element * per_ + g;
    field_.energy += mesh_.maps[at].volume * energy(smooth);
    field_.error_energies[element] += mesh_.maps[at].volume * energy(smooth - raw_[at]);
  }
}

void StressRecovery::turn_to_axes() {
  for (std::size_t k = 0; k < field_.stresses.size(); ++k)
    field_.stresses[k] = turned(directions_[k].x, directions_[k].y, field_.stresses[k]);
}

template <class Density>
StressField StressRecovery::run(const Density& density, const double* strains) {
  const auto for_elements = [this](const auto& task) {
    for (std::size_t ex = 0; ex < mesh_.along; ++ex)
      for (std::size_t ey = 0; ey < mesh_.across; ++ey) task(ex, ey);
  };
  for_elements([&](std::size_t ex, std::size_t ey) { add_element(density, strains, ex, ey); });
  average();
  for_elements([&](std::size_t ex, std::size_t ey) { measure(ex, ey); });
  turn_to_axes();
  return std::move(field_);
}

}  // namespace

StressField recover_stress(const ContinuumStrip& strip, const std::vector<Vec2>& moved,
                           const double* strains) {
  StressRecovery recovery(strip, moved);
  return with_density(strip.material, strip.settings,
                      [&](const auto& density) { return recovery.run(density, strains); });
}

std::optional<StressField> ContinuumPort::stress_field(std::span<const double> internal) const {
  const double* y = internal.data();
  const ContinuumUnknowns& unknowns = strip_->unknowns;
  return recover_stress(
      *strip_, strip_displacements(*strip_, y, y + unknowns.base_face, y + unknowns.action_face),
      y + unknowns.strains);
}

}  // namespace flexura

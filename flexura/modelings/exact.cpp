#include "flexura/modelings/exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flexura/assembly/loaded_angle_field.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/exact_field.hpp"
#include "flexura/modelings/point_compliances.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

constexpr int most_modes = 20;  // per piece; beyond, pieces are halved instead
constexpr int halved_modes = 12;
constexpr std::size_t storable_modes = 40;  // what a user may ask for, and then some

class ExactPort final : public TwoPort {
 public:
  ExactPort(const FlexureProperties& flexure, ExactPieces pieces);

  std::size_t internal_size() const override { return field_.unknowns; }
  std::size_t scratch_size() const override {
    return field_.scratch_size() + (feels_surroundings() ? 8 * field_.unknowns : 0);
  }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  bool feels_surroundings() const override { return flexure_.field.acts(); }
  TipResponse linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                           const double* internal, double* scratch,
                           FieldResponse& field) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return sections_in({}, load, internal);
  }
  std::vector<SectionState> sections_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load,
                                        std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override;
  void prolong(std::span<const double> internal, std::span<double> refined) const override;

 private:
  template <class Call>
  auto with_potential(const Call& call) const;
  std::size_t piece_at(double s) const;
  std::vector<double> turns_at_nodes(const StationGrid& grid,
                                     std::span<const double> internal) const;
  std::vector<Vec2> slopes_at_nodes(const StationGrid& grid, const std::vector<Vec2>& n,
                                    double strain, const std::vector<double>& turns) const;
  double moment_at(double s, std::span<const double> internal) const;
  ExactPieces refinement() const;

  FlexureProperties flexure_;
  ExactPieces pieces_;
  AngleField field_;
  PointCompliances compliances_;  // of varying sections
  FieldLoad acting_;
};

ExactPort::ExactPort(const FlexureProperties& flexure, ExactPieces pieces)
    : flexure_(flexure), pieces_(std::move(pieces)) {
  if (!flexure_.varying) {
    field_ = constant_section_field(flexure_, pieces_);
  } else {
    VaryingField varying = varying_section_field(flexure_, pieces_);
    field_ = std::move(varying.field);
    compliances_ = std::move(varying.compliances);
  }
  if (!feels_surroundings()) return;
  acting_.strain = flexure_.field.strain;
  for (const double s : field_.places) acting_.ahead.push_back(flexure_.load_ahead(s));
}

/// Calls with the mixed potential of the points.
template <class Call>
auto ExactPort::with_potential(const Call& call) const {
  if (flexure_.varying)
    return call([this](std::size_t g, const auto& theta, const auto& fx, const auto& fy) {
      return reissner_mixed_potential(theta, fx, fy, compliances_.axial(g), compliances_.shear(g));
    });
  return call([this](std::size_t, const auto& theta, const auto& fx, const auto& fy) {
    return reissner_mixed_potential(theta, fx, fy, flexure_.axial_compliance,
                                    flexure_.shear_compliance);
  });
}

TipResponse ExactPort::linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                                    const double* internal, double* scratch,
                                    FieldResponse& field) const {
  return with_potential([&](const auto& potential) {
    return linearize_loaded_angle_field(field_, acting_, surroundings, potential, load, internal,
                                        scratch, field);
  });
}

TipResponse ExactPort::linearize(const Eigen::Vector3d& load, const double* internal,
                                 double* scratch) const {
  return with_potential([&](const auto& potential) {
    return linearize_angle_field(field_, potential, load, internal, scratch);
  });
}

Eigen::MatrixXd ExactPort::hessian(const Eigen::Vector3d& load, const double* internal) const {
  return with_potential([&](const auto& potential) {
    return angle_field_hessian(field_, potential, load, internal);
  });
}

std::size_t ExactPort::piece_at(double s) const {
  const auto& ends = pieces_.ends;
  return static_cast<std::size_t>(std::upper_bound(ends.begin() + 1, ends.end() - 1, s) -
                                  ends.begin()) -
         1;
}

/// The turns that the modes' moment gives.
std::vector<double> ExactPort::turns_at_nodes(const StationGrid& grid,
                                              std::span<const double> internal) const {
  std::vector<double> curvatures;
  for (const StationGrid::Node& node : grid.nodes)
    curvatures.push_back(moment_at(node.s, internal) / flexure_.at(node.s).bending_stiffness);
  return grid.integrate(curvatures).at_nodes;
}

double ExactPort::moment_at(double s, std::span<const double> internal) const {
  const std::size_t piece = piece_at(s);
  const std::size_t m = pieces_.modes_per_piece();
  const double start = pieces_.ends[piece];
  const double length = pieces_.ends[piece + 1] - start;
  std::vector<double> legendre(m);
  evaluate_legendre(2.0 * (s - start) / length - 1.0, legendre);
  double moment = 0.0;
  for (std::size_t i = 0; i < m; ++i) moment += legendre[i] * internal[piece * m + i];
  return flexure_.bending_stiffness / flexure_.axis.length() * moment;
}

/// Slopes of the axis at the nodes, where sections turn by `turns` and carry the forces n.
std::vector<Vec2> ExactPort::slopes_at_nodes(const StationGrid& grid, const std::vector<Vec2>& n,
                                             double strain,
                                             const std::vector<double>& turns) const {
  std::vector<Vec2> slopes;
  for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
    const Vec2 t = unit(grid.nodes[k].angle + turns[k]);
    const FlexureProperties::Local local = flexure_.at(grid.nodes[k].s);
    slopes.push_back((1.0 + strain + local.axial_compliance * dot(n[k], t)) * t +
                     local.shear_compliance * dot(n[k], perp(t)) * perp(t));
  }
  return slopes;
}

/// The modes' moment is right in the mean: its error is as large as the last mode, while the tip's
/// is that squared. The moment that holds each part in equilibrium with the tip is as good as the
/// tip, and so are the turns that follow from it.
std::vector<SectionState> ExactPort::sections_in(const Surroundings& surroundings,
                                                 const Eigen::Vector3d& load,
                                                 std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  const Vec2 f{load[0], load[1]};
  const auto force_at = [&](double s) {
    if (!feels_surroundings()) return f;
    return f + surroundings.load_factor * rotate(-surroundings.turn, flexure_.load_ahead(s));
  };
  std::vector<Vec2> forces;
  for (const StationGrid::Node& node : grid.nodes) forces.push_back(force_at(node.s));
  const double strain = surroundings.load_factor * flexure_.field.strain;
  std::vector<double> turns = turns_at_nodes(grid, internal);
  StationGrid::Integral<double> turn;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const auto slopes = slopes_at_nodes(grid, forces, strain, turns);
    const StationGrid::Integral<double> moments = moments_ahead(grid, slopes, forces);
    std::vector<double> curvatures;
    for (std::size_t k = 0; k < grid.nodes.size(); ++k)
      curvatures.push_back((load[2] + moments.at_nodes[k]) /
                           flexure_.at(grid.nodes[k].s).bending_stiffness);
    turn = grid.integrate(curvatures);
    turns = turn.at_nodes;
  }
  const auto slopes = slopes_at_nodes(grid, forces, strain, turns);
  const StationGrid::Integral<Vec2> axis = grid.integrate(slopes);
  const StationGrid::Integral<double> moments = moments_ahead(grid, slopes, forces);
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const Vec2 t = unit(grid.angles[k] + turn.at_stations[k]);
    const Vec2 n = force_at(grid.s[k]);
    states.push_back({{axis.at_stations[k], turn.at_stations[k]},
                      dot(n, t),
                      dot(n, perp(t)),
                      load[2] + moments.at_stations[k]});
  }
  return states;
}

/// More modes while that converges geometrically; halves of the pieces when they get too many.
ExactPieces ExactPort::refinement() const {
  if (pieces_.modes + more_modes <= most_modes) return {pieces_.ends, pieces_.modes + more_modes};
  ExactPieces finer{{0.0}, halved_modes};
  for (std::size_t p = 0; p < pieces_.pieces(); ++p) {
    const double a = pieces_.ends[p];
    const double b = pieces_.ends[p + 1];
    finer.ends.push_back(0.5 * (a + b));
    finer.ends.push_back(b);
  }
  return finer;
}

std::shared_ptr<const TwoPort> ExactPort::refined() const {
  return std::make_shared<ExactPort>(flexure_, refinement());
}

void ExactPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const ExactPieces finer = refinement();
  const std::size_t m = pieces_.modes_per_piece();
  const std::size_t fine = finer.modes_per_piece();
  std::fill(refined.begin(), refined.end(), 0.0);
  if (finer.pieces() == pieces_.pieces()) {
    for (std::size_t p = 0; p < finer.pieces(); ++p)
      std::copy_n(internal.begin() + static_cast<std::ptrdiff_t>(p * m), m,
                  refined.begin() + static_cast<std::ptrdiff_t>(p * fine));
    return;
  }
  // Legendre coefficients of the same moment on each half.
  const QuadratureRule& rule = gauss_legendre(pieces_.modes + finer.modes);
  const double unit_moment = flexure_.bending_stiffness / flexure_.axis.length();
  std::vector<double> legendre(fine);
  for (std::size_t p = 0; p < finer.pieces(); ++p) {
    const double half = 0.5 * (finer.ends[p + 1] - finer.ends[p]);
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      evaluate_legendre(rule.nodes[g], legendre);
      const double s = finer.ends[p] + half * (1.0 + rule.nodes[g]);
      const double value = rule.weights[g] * moment_at(s, internal) / unit_moment;
      for (std::size_t i = 0; i < fine; ++i)
        refined[p * fine + i] += (static_cast<double>(i) + 0.5) * value * legendre[i];
    }
  }
}

}  // namespace

/// The moment of a nearly undeformed flexure is a sine of its tangent angle, which turns by g to
/// either side of the middle; its m-th Legendre coefficient is about g^m/(2m + 1)!!, and the tip's
/// error is the square of that, since the tip makes a potential stationary.
int likely_exact_modes(double turning, double tolerance) {
  const double g = std::max(0.5 * turning + 0.4, 1.2);  // loads bend a straight one, too
  double coefficient = g / 3.0;
  int m = 1;
  while (m < most_modes - more_modes && coefficient * coefficient > 0.1 * tolerance) {
    ++m;
    coefficient *= g / (2.0 * m + 1.0);
  }
  return std::max(m, 4);
}

std::shared_ptr<const TwoPort> make_exact_port(const FlexureProperties& flexure,
                                               const ExactSettings& settings, double tolerance) {
  const AxisCurve& axis = flexure.axis;
  const auto pieces = static_cast<double>(axis.breaks().size() - 1);
  const int modes = settings.modes.value_or(likely_exact_modes(axis.turning() / pieces, tolerance));
  return std::make_shared<ExactPort>(flexure, ExactPieces{axis.breaks(), modes});
}

}  // namespace flexura

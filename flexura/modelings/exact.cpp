#include "flexura/modelings/exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flexura/assembly/angle_field.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

constexpr int more_modes = 4;  // by which the estimate's flexure is finer
// Gauss points beyond one per mode: products of two modes and a smooth function of the angle.
constexpr int more_points = 6;
constexpr int most_modes = 20;  // per piece; beyond, pieces are halved instead
constexpr int halved_modes = 12;
constexpr std::size_t storable_modes = 40;  // what a user may ask for, and then some

/// Pieces [ends[p], ends[p+1]] of the arc length with `modes` Legendre modes each.
struct Discretization {
  std::vector<double> ends;
  int modes = 0;

  std::size_t pieces() const { return ends.size() - 1; }
  std::size_t modes_per_piece() const { return static_cast<std::size_t>(modes); }
  std::size_t unknowns() const { return pieces() * modes_per_piece(); }
};

class ExactPort final : public TwoPort {
 public:
  ExactPort(const FlexureProperties& flexure, Discretization discretization);

  std::size_t internal_size() const override { return field_.unknowns; }
  std::size_t scratch_size() const override { return field_.scratch_size(); }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override;
  void prolong(std::span<const double> internal, std::span<double> refined) const override;

 private:
  std::size_t piece_at(double s) const;
  double turn_at(double s, std::span<const double> internal) const;
  StationGrid::Integral<Vec2> place_axis(const StationGrid& grid, Vec2 f,
                                         const std::vector<double>& turns) const;
  double moment_at(double s, std::span<const double> internal) const;
  /// P_i and integrals of P_i/L from the piece's start, at s in the piece.
  void fill_turns(std::size_t piece, double x, double* row) const;
  Discretization refinement() const;

  FlexureProperties flexure_;
  Discretization discretization_;
  AngleField field_;
};

ExactPort::ExactPort(const FlexureProperties& flexure, Discretization discretization)
    : flexure_(flexure), discretization_(std::move(discretization)) {
  const AxisCurve& axis = flexure_.axis;
  const double length = axis.length();
  const std::size_t m = discretization_.modes_per_piece();
  const std::size_t n = discretization_.unknowns();
  const QuadratureRule& rule = gauss_legendre(discretization_.modes + more_points);

  field_.unknowns = n;
  field_.stiffness.assign(n * n, 0.0);
  field_.tip_turn.assign(n, 0.0);
  const std::size_t points = discretization_.pieces() * rule.nodes.size();
  field_.weights.reserve(points);
  field_.angles.reserve(points);
  field_.turns.assign(points * n, 0.0);
  Vec2 drawn;
  for (std::size_t piece = 0; piece < discretization_.pieces(); ++piece) {
    const double start = discretization_.ends[piece];
    const double half = 0.5 * (discretization_.ends[piece + 1] - start);
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t k = piece * m + i;
      field_.stiffness[k * n + k] = flexure_.bending_stiffness / length * (2.0 * half / length) /
                                    (2.0 * static_cast<double>(i) + 1.0);
    }
    field_.tip_turn[piece * m] = 2.0 * half / length;
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double angle = axis.tangent_angle(start + half * (1.0 + rule.nodes[g]));
      fill_turns(piece, rule.nodes[g], field_.turns.data() + field_.weights.size() * n);
      field_.weights.push_back(half * rule.weights[g]);
      field_.angles.push_back(angle);
      drawn = drawn + field_.weights.back() * unit(angle);
    }
  }
  field_.offset = axis.position(length) - axis.position(0.0) - drawn;
  field_.complete_pairs();
}

void ExactPort::fill_turns(std::size_t piece, double x, double* row) const {
  const std::size_t m = discretization_.modes_per_piece();
  const double length = flexure_.axis.length();
  const auto share = [&](std::size_t p) {
    return (discretization_.ends[p + 1] - discretization_.ends[p]) / length;
  };
  for (std::size_t p = 0; p < piece; ++p) row[p * m] = share(p);
  integrate_legendre(x, std::span(row + piece * m, m));
  for (std::size_t i = 0; i < m; ++i) row[piece * m + i] *= 0.5 * share(piece);
}

TipResponse ExactPort::linearize(const Eigen::Vector3d& load, const double* internal,
                                 double* scratch) const {
  const auto potential = [this](std::size_t, const auto& theta, const auto& fx, const auto& fy) {
    return reissner_mixed_potential(theta, fx, fy, flexure_.axial_compliance,
                                    flexure_.shear_compliance);
  };
  return linearize_angle_field(field_, potential, load, internal, scratch);
}

std::size_t ExactPort::piece_at(double s) const {
  const auto& ends = discretization_.ends;
  return static_cast<std::size_t>(std::upper_bound(ends.begin() + 1, ends.end() - 1, s) -
                                  ends.begin()) -
         1;
}

double ExactPort::turn_at(double s, std::span<const double> internal) const {
  const std::size_t piece = piece_at(s);
  const std::size_t m = discretization_.modes_per_piece();
  const double start = discretization_.ends[piece];
  const double end = discretization_.ends[piece + 1];
  const double length = flexure_.axis.length();
  double turn = 0.0;
  for (std::size_t p = 0; p < piece; ++p)  // only mode 0 has an integral over the whole piece
    turn += (discretization_.ends[p + 1] - discretization_.ends[p]) / length * internal[p * m];
  std::array<double, storable_modes> row{};
  const std::span<double> modes(row.data(), m);
  integrate_legendre(2.0 * (s - start) / (end - start) - 1.0, modes);
  for (std::size_t i = 0; i < modes.size(); ++i)
    turn += 0.5 * (end - start) / length * modes[i] * internal[piece * m + i];
  return turn;
}

double ExactPort::moment_at(double s, std::span<const double> internal) const {
  const std::size_t piece = piece_at(s);
  const std::size_t m = discretization_.modes_per_piece();
  const double start = discretization_.ends[piece];
  const double length = discretization_.ends[piece + 1] - start;
  std::vector<double> legendre(m);
  evaluate_legendre(2.0 * (s - start) / length - 1.0, legendre);
  double moment = 0.0;
  for (std::size_t i = 0; i < m; ++i) moment += legendre[i] * internal[piece * m + i];
  return flexure_.bending_stiffness / flexure_.axis.length() * moment;
}

/// The axis of sections that turn by `turns`, with the strains of a constant force f.
StationGrid::Integral<Vec2> ExactPort::place_axis(const StationGrid& grid, Vec2 f,
                                                  const std::vector<double>& turns) const {
  std::vector<Vec2> slopes;
  for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
    const Vec2 t = unit(grid.nodes[k].angle + turns[k]);
    slopes.push_back((1.0 + flexure_.axial_compliance * dot(f, t)) * t +
                     flexure_.shear_compliance * dot(f, perp(t)) * perp(t));
  }
  return grid.integrate(slopes);
}

/// The modes' moment is right in the mean: its error is as large as the last mode, while the tip's
/// is that squared. The moment that holds each part in equilibrium with the tip is as good as the
/// tip, and so are the turns that follow from it.
std::vector<SectionState> ExactPort::sections(const Eigen::Vector3d& load,
                                              std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis);
  const Vec2 f{load[0], load[1]};
  std::vector<double> turns;
  for (const StationGrid::Node& node : grid.nodes) turns.push_back(turn_at(node.s, internal));
  StationGrid::Integral<double> turn;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const StationGrid::Integral<Vec2> axis = place_axis(grid, f, turns);
    std::vector<double> curvatures;
    for (const Vec2 place : axis.at_nodes)
      curvatures.push_back((load[2] + cross(axis.at_stations.back() - place, f)) /
                           flexure_.bending_stiffness);
    turn = grid.integrate(curvatures);
    turns = turn.at_nodes;
  }
  const StationGrid::Integral<Vec2> axis = place_axis(grid, f, turns);
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const Vec2 t = unit(grid.angles[k] + turn.at_stations[k]);
    states.push_back({{axis.at_stations[k], turn.at_stations[k]},
                      dot(f, t),
                      dot(f, perp(t)),
                      load[2] + cross(axis.at_stations.back() - axis.at_stations[k], f)});
  }
  return states;
}

/// More modes while that converges geometrically; halves of the pieces when they get too many.
Discretization ExactPort::refinement() const {
  if (discretization_.modes + more_modes <= most_modes)
    return {discretization_.ends, discretization_.modes + more_modes};
  Discretization finer{{0.0}, halved_modes};
  for (std::size_t p = 0; p < discretization_.pieces(); ++p) {
    const double a = discretization_.ends[p];
    const double b = discretization_.ends[p + 1];
    finer.ends.push_back(0.5 * (a + b));
    finer.ends.push_back(b);
  }
  return finer;
}

std::shared_ptr<const TwoPort> ExactPort::refined() const {
  return std::make_shared<ExactPort>(flexure_, refinement());
}

void ExactPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const Discretization finer = refinement();
  const std::size_t m = discretization_.modes_per_piece();
  const std::size_t fine = finer.modes_per_piece();
  std::fill(refined.begin(), refined.end(), 0.0);
  if (finer.pieces() == discretization_.pieces()) {
    for (std::size_t p = 0; p < finer.pieces(); ++p)
      std::copy_n(internal.begin() + static_cast<std::ptrdiff_t>(p * m), m,
                  refined.begin() + static_cast<std::ptrdiff_t>(p * fine));
    return;
  }
  // Legendre coefficients of the same moment on each half.
  const QuadratureRule& rule = gauss_legendre(discretization_.modes + finer.modes);
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

/// The moment of a nearly undeformed flexure is a sine of its tangent angle, which turns by g to
/// either side of the middle; its m-th Legendre coefficient is about g^m/(2m + 1)!!, and the tip's
/// error is the square of that, since the tip makes a potential stationary.
int likely_modes(double turning, double tolerance) {
  const double g = std::max(0.5 * turning + 0.4, 1.2);  // loads bend a straight one, too
  double coefficient = g / 3.0;
  int m = 1;
  while (m < most_modes - more_modes && coefficient * coefficient > 0.1 * tolerance) {
    ++m;
    coefficient *= g / (2.0 * m + 1.0);
  }
  return std::max(m, 4);
}

}  // namespace

std::shared_ptr<const TwoPort> make_exact_port(const FlexureProperties& flexure,
                                               const ExactSettings& settings, double tolerance) {
  const AxisCurve& axis = flexure.axis;
  const auto pieces = static_cast<double>(axis.breaks().size() - 1);
  const int modes = settings.modes.value_or(likely_modes(axis.turning() / pieces, tolerance));
  return std::make_shared<ExactPort>(flexure, Discretization{axis.breaks(), modes});
}

}  // namespace flexura

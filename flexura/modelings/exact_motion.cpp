#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/angle_chain.hpp"
#include "flexura/modelings/exact.hpp"
#include "flexura/modelings/exact_field.hpp"
#include "flexura/modelings/motion_ports.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// As many modes of axial and shear force: they follow the moment's slope.
int force_modes(int modes) { return std::max(2, modes - 1); }

/// Moment, axial and shear force in Legendre modes; in units of EI_0/L and EI_0/L^2.
class ExactMotionPort final : public MotionPort {
 public:
  ExactMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                  ExactPieces pieces)
      : flexure_(flexure), inertia_(inertia), pieces_(std::move(pieces)), motion_(make_chain()) {}

  std::size_t internal_size() const override { return motion_.chain().unknowns; }
  BandLayout layout() const override { return dense_layout(internal_size()); }
  const std::vector<MassPoint>& points() const override { return motion_.chain().points; }
  std::size_t scratch_size() const override { return motion_.scratch_size(); }
  std::vector<double> weights() const override { return motion_.chain().weights; }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override {
    return motion_.evaluate(load, y, v, a, work);
  }
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override {
    motion_.add_forces(forces, work, residual);
  }
  void linearize(const Eigen::Vector3d& load, const double* /*y*/, const Vec2* weights,
                 MemberWork& work) const override {
    motion_.linearize(load, weights, work);
  }
  void linearize_energy(const double* /*y*/, MemberWork& work) const override {
    motion_.linearize_energy(work);
  }
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;
  std::shared_ptr<const MotionPort> refined() const override {
    return std::make_shared<ExactMotionPort>(flexure_, inertia_,
                                             ExactPieces{pieces_.ends, pieces_.modes + more_modes});
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;

 private:
  bool stretches() const { return flexure_.axial_compliance > 0.0; }
  bool shears() const { return flexure_.shear_compliance > 0.0; }
  std::size_t forces_per_piece() const {
    return static_cast<std::size_t>(force_modes(pieces_.modes));
  }
  double unit_moment() const { return flexure_.bending_stiffness / flexure_.axis.length(); }
  double unit_force() const { return unit_moment() / flexure_.axis.length(); }
  std::size_t piece_at(double s) const;
  /// Place of s in its piece, in [-1, 1].
  double place_in(std::size_t piece, double s) const {
    return 2.0 * (s - pieces_.ends[piece]) / (pieces_.ends[piece + 1] - pieces_.ends[piece]) - 1.0;
  }
  AngleChain make_chain() const;
  void add_forces(AngleChain& chain) const;
  void add_force_rows(AngleChain& chain, AngleChain::Rows& rows, std::size_t first,
                      bool axial) const;
  void add_mass_points(AngleChain& chain, std::size_t per_interval) const;
  /// Moment, axial and shear force at s.
  struct Resultants {
    double moment = 0.0;
    double axial = 0.0;
    double shear = 0.0;
  };
  Resultants resultants(double s, const double* y) const;

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  ExactPieces pieces_;
  AngleChainMotion motion_;
};

std::size_t ExactMotionPort::piece_at(double s) const {
  const auto& ends = pieces_.ends;
  return static_cast<std::size_t>(std::upper_bound(ends.begin() + 1, ends.end() - 1, s) -
                                  ends.begin()) -
         1;
}

/// The static flexure's angles, with strains as modes of their own.
AngleChain ExactMotionPort::make_chain() const {
  const AngleField field = flexure_.varying ? varying_section_field(flexure_, pieces_).field
                                            : constant_section_field(flexure_, pieces_);
  const auto per_interval = static_cast<std::size_t>(
      flexure_.varying ? varying_exact_points(pieces_) : exact_points(pieces_));
  const std::size_t arms = field.weights.size() / per_interval * per_interval;
  const std::size_t n = field.unknowns;
  const std::size_t forces = pieces_.pieces() * forces_per_piece();
  AngleChain chain;
  chain.unknowns = n + (stretches() ? forces : 0) + (shears() ? forces : 0);
  const std::size_t m = chain.unknowns;
  chain.turns = {0, n, {}};
  for (std::size_t h = 0; h < arms; ++h) {
    chain.arms.push_back(
        {field.weights[h], field.angles[h], 1.0 + flexure_.field.strain, field.places[h]});
  }
  chain.turns.values.assign(field.turns.begin(),
                            field.turns.begin() + static_cast<std::ptrdiff_t>(arms * n));
  for (std::size_t h = 0; h <= arms; h += per_interval) chain.intervals.push_back(h);
  chain.stiffness.assign(m * m, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(field.stiffness.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                chain.stiffness.begin() + static_cast<std::ptrdiff_t>(i * m));
  chain.tip_turn = field.tip_turn;
  chain.tip_turn.resize(m, 0.0);
  chain.tip_offset = field.offset;
  for (std::size_t i = 0; i < n; ++i)
    chain.weights.push_back(1.0 / (2.0 * static_cast<double>(i % pieces_.modes_per_piece()) + 1.0));
  add_forces(chain);
  add_mass_points(chain, per_interval);
  return chain;
}

void ExactMotionPort::add_forces(AngleChain& chain) const {
  std::size_t first = pieces_.unknowns();
  if (stretches()) {
    add_force_rows(chain, chain.axial, first, true);
    first += pieces_.pieces() * forces_per_piece();
  }
  if (shears()) add_force_rows(chain, chain.shear, first, false);
}

/// Strains by the modes of a force, and the modes' energies.
void ExactMotionPort::add_force_rows(AngleChain& chain, AngleChain::Rows& rows, std::size_t first,
                                     bool axial) const {
  const std::size_t m = chain.unknowns;
  const std::size_t per = forces_per_piece();
  const std::size_t count = pieces_.pieces() * per;
  rows = {first, count, std::vector<double>(chain.arms.size() * count, 0.0)};
  std::vector<double> legendre(per);
  for (std::size_t h = 0; h < chain.arms.size(); ++h) {
    const std::size_t piece = piece_at(chain.arms[h].s);
    const FlexureProperties::Local local = flexure_.at(chain.arms[h].s);
    const double compliance = axial ? local.axial_compliance : local.shear_compliance;
    evaluate_legendre(place_in(piece, chain.arms[h].s), legendre);
    const std::size_t own = first + piece * per;
    for (std::size_t i = 0; i < per; ++i) {
      const double strain = compliance * unit_force() * legendre[i];
      rows.values[h * count + piece * per + i] = strain;
      for (std::size_t j = 0; j < per; ++j)
        chain.stiffness[(own + i) * m + own + j] +=
            chain.arms[h].weight * strain * unit_force() * legendre[j];
    }
  }
  const double mean =
      unit_force() * (axial ? flexure_.axial_compliance : flexure_.shear_compliance);
  for (std::size_t i = 0; i < pieces_.pieces() * per; ++i)
    chain.weights.push_back(mean / (2.0 * static_cast<double>(i % per) + 1.0));
}

void ExactMotionPort::add_mass_points(AngleChain& chain, std::size_t per_interval) const {
  const std::vector<double>& partial = gauss_partial_integrals(static_cast<int>(per_interval));
  const Vec2 start = flexure_.axis.position(0.0);
  Vec2 sum;
  for (std::size_t k = 0; k + 1 < chain.intervals.size(); ++k) {
    const std::size_t first = chain.intervals[k];
    double length = 0.0;
    for (std::size_t h = 0; h < per_interval; ++h) length += chain.arms[first + h].weight;
    for (std::size_t g = 0; g < per_interval; ++g) {
      const AngleChain::Arm& here = chain.arms[first + g];
      AngleChain::Place place{k, {}, first, flexure_.axis.position(here.s) - start - sum};
      for (std::size_t h = 0; h < per_interval; ++h) {
        place.parts.push_back(length * partial[g * per_interval + h]);
        place.offset = place.offset - place.parts.back() * unit(chain.arms[first + h].angle);
      }
      chain.places.push_back(std::move(place));
      chain.points.push_back({here.s, here.weight * inertia_.at(here.s).mass, false, 0,
                              chain.unknowns, here.weight * flexure_.field.per_length});
    }
    for (std::size_t h = 0; h < per_interval; ++h)
      sum = sum + chain.arms[first + h].weight * unit(chain.arms[first + h].angle);
  }
  if (!inertia_.rotary) return;
  for (std::size_t h = 0; h < chain.arms.size(); ++h) {
    const AngleChain::Arm& here = chain.arms[h];
    chain.directions.push_back({h, !inertia_.shear_rotary});
    chain.points.push_back(
        {here.s, here.weight * inertia_.at(here.s).rotary, true, 0, chain.unknowns, {}});
  }
}

auto ExactMotionPort::resultants(double s, const double* y) const -> Resultants {
  const std::size_t piece = piece_at(s);
  const double x = place_in(piece, s);
  std::vector<double> legendre(std::max(pieces_.modes_per_piece(), forces_per_piece()));
  evaluate_legendre(x, legendre);
  Resultants sum;
  const std::size_t m = pieces_.modes_per_piece();
  for (std::size_t i = 0; i < m; ++i) sum.moment += unit_moment() * legendre[i] * y[piece * m + i];
  const std::size_t per = forces_per_piece();
  const double* axial = y + pieces_.unknowns() + piece * per;
  const double* shear = axial + (stretches() ? pieces_.pieces() * per : 0);
  for (std::size_t i = 0; i < per; ++i) {
    if (stretches()) sum.axial += unit_force() * legendre[i] * axial[i];
    if (shears()) sum.shear += unit_force() * legendre[i] * shear[i];
  }
  return sum;
}

std::vector<SectionState> ExactMotionPort::sections(const Eigen::Vector3d& load,
                                                    const double* y) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  std::vector<Resultants> inner;
  std::vector<double> curvatures;
  for (const StationGrid::Node& node : grid.nodes) {
    inner.push_back(resultants(node.s, y));
    curvatures.push_back(inner.back().moment / flexure_.at(node.s).bending_stiffness);
  }
  const StationGrid::Integral<double> turn = grid.integrate(curvatures);
  std::vector<Vec2> slopes;
  for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
    const Vec2 t = unit(grid.nodes[k].angle + turn.at_nodes[k]);
    const FlexureProperties::Local local = flexure_.at(grid.nodes[k].s);
    slopes.push_back((1.0 + flexure_.field.strain + local.axial_compliance * inner[k].axial) * t +
                     local.shear_compliance * inner[k].shear * perp(t));
  }
  const StationGrid::Integral<Vec2> axis = grid.integrate(slopes);
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    Resultants r = resultants(grid.s[k], y);
    const Vec2 t = unit(grid.angles[k] + turn.at_stations[k]);
    if (!stretches()) r.axial = dot({load[0], load[1]}, t);
    if (!shears()) r.shear = dot({load[0], load[1]}, perp(t));
    states.push_back({{axis.at_stations[k], turn.at_stations[k]}, r.axial, r.shear, r.moment});
  }
  return states;
}

/// Resultants at the stations, joined by straight lines, projected onto the modes.
std::vector<double> ExactMotionPort::adopt(std::span<const SectionState> sections,
                                           std::span<const double> /*internal*/) const {
  std::vector<double> y(internal_size(), 0.0);
  const QuadratureRule& rule = gauss_legendre(24);
  const double length = flexure_.axis.length();
  const auto at = [&](double s, double SectionState::*quantity) {
    const double place = s / length * static_cast<double>(sections.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(place), sections.size() - 2);
    const double share = place - static_cast<double>(k);
    return (1.0 - share) * sections[k].*quantity + share * sections[k + 1].*quantity;
  };
  const auto project = [&](std::size_t first, std::size_t per, double unit_size,
                           double SectionState::*quantity) {
    std::vector<double> legendre(per);
    for (std::size_t p = 0; p < pieces_.pieces(); ++p)
      for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
        const double half = 0.5 * (pieces_.ends[p + 1] - pieces_.ends[p]);
        const double s = pieces_.ends[p] + half * (1.0 + rule.nodes[g]);
        evaluate_legendre(rule.nodes[g], legendre);
        for (std::size_t i = 0; i < per; ++i)
          y[first + p * per + i] += (static_cast<double>(i) + 0.5) * rule.weights[g] * legendre[i] *
                                    at(s, quantity) / unit_size;
      }
  };
  project(0, pieces_.modes_per_piece(), unit_moment(), &SectionState::bending_moment);
  std::size_t first = pieces_.unknowns();
  if (stretches()) {
    project(first, forces_per_piece(), unit_force(), &SectionState::axial_force);
    first += pieces_.pieces() * forces_per_piece();
  }
  if (shears()) project(first, forces_per_piece(), unit_force(), &SectionState::shear_force);
  return y;
}

void ExactMotionPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  std::fill(refined.begin(), refined.end(), 0.0);
  const int fine_modes = pieces_.modes + more_modes;
  const auto fine = static_cast<std::size_t>(fine_modes);
  const auto fine_forces = static_cast<std::size_t>(force_modes(fine_modes));
  std::size_t from = 0, to = 0;
  const auto copy = [&](std::size_t coarse, std::size_t finer) {
    for (std::size_t p = 0; p < pieces_.pieces(); ++p, from += coarse, to += finer)
      std::copy_n(internal.begin() + static_cast<std::ptrdiff_t>(from), coarse,
                  refined.begin() + static_cast<std::ptrdiff_t>(to));
  };
  copy(pieces_.modes_per_piece(), fine);
  if (stretches()) copy(forces_per_piece(), fine_forces);
  if (shears()) copy(forces_per_piece(), fine_forces);
}

}  // namespace

std::shared_ptr<const MotionPort> make_exact_motion_port(const FlexureProperties& flexure,
                                                         const FlexureInertia& inertia,
                                                         const ExactSettings& settings,
                                                         double tolerance) {
  const AxisCurve& axis = flexure.axis;
  const auto pieces = static_cast<double>(axis.breaks().size() - 1);
  const int modes =
      settings.modes.value_or(likely_exact_modes(axis.turning() / pieces, tolerance) + 2);
  return std::make_shared<ExactMotionPort>(flexure, inertia, ExactPieces{axis.breaks(), modes});
}

}  // namespace flexura

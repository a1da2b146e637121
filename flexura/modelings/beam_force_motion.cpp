#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/angle_chain.hpp"
#include "flexura/modelings/beam_common.hpp"

namespace flexura {
namespace {

/// Exact beam elements without axial or shear strain, in motion: nodal rotations turn the Gauss
/// points' tangents, whose sum is the axis; a strain that is left has a force per Gauss point.
class ForceBeamMotionPort final : public MotionPort {
 public:
  ForceBeamMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                      BeamSettings settings)
      : flexure_(flexure),
        inertia_(inertia),
        settings_(settings),
        mesh_(flexure.axis, settings.elements, settings.order),
        still_(make_force_beam_port(flexure, settings)),
        motion_(make_chain()) {}

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
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override {
    return still_->sections(load, {y, rotations()});
  }
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;
  std::shared_ptr<const MotionPort> refined() const override {
    return std::make_shared<ForceBeamMotionPort>(
        flexure_, inertia_, BeamSettings{2 * settings_.elements, settings_.order, {}});
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return halving_error_ratio(mesh_); }

 private:
  std::size_t rotations() const { return mesh_.nodes() - 1; }
  double unit_force() const { return flexure_.bending_stiffness / (mesh_.length * mesh_.length); }
  AngleChain make_chain() const;
  void add_forces(AngleChain& chain) const;
  void add_mass_points(AngleChain& chain) const;
  void add_nodes(AngleChain& chain) const;
  void add_node_arms(AngleChain& chain) const;

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  BeamSettings settings_;
  BeamMesh mesh_;
  std::shared_ptr<const TwoPort> still_;
  AngleChainMotion motion_;
};

AngleChain ForceBeamMotionPort::make_chain() const {
  const std::size_t n = rotations();
  const std::size_t points = mesh_.points.size();
  const std::size_t per = mesh_.order + 1;
  AngleChain chain;
  chain.unknowns = n + (flexure_.axial_compliance > 0.0 ? points : 0) +
                   (flexure_.shear_compliance > 0.0 ? points : 0);
  const std::size_t m = chain.unknowns;
  chain.turns = {0, n, std::vector<double>(points * n, 0.0)};
  chain.stiffness.assign(m * m, 0.0);
  chain.tip_turn.assign(m, 0.0);
  chain.tip_turn[n - 1] = 1.0;
  chain.weights.assign(m, 1.0);
  const Vec2 start = flexure_.axis.position(0.0);
  chain.tip_offset = flexure_.axis.position(mesh_.length) - start;
  for (std::size_t p = 0; p < points; ++p) {
    const BeamMesh::GaussPoint& point = mesh_.points[p];
    const std::size_t first = p / mesh_.order * mesh_.order;
    if (p % mesh_.order == 0) chain.intervals.push_back(p);
    const double* shape = mesh_.shape.data() + p % mesh_.order * per;
    const double* slope = mesh_.slope.data() + p % mesh_.order * per;
    const double bending = point.weight * flexure_.at(point.s).bending_stiffness;
    for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
      const std::size_t i = first + a - 1;
      chain.turns.values[p * n + i] = shape[a];
      for (std::size_t b = first == 0 ? 1 : 0; b < per; ++b)
        chain.stiffness[i * m + first + b - 1] += bending * slope[a] * slope[b];
    }
    chain.arms.push_back(
        {point.weight, point.angle, point.stretch + flexure_.field.strain, point.s});
    chain.tip_offset = chain.tip_offset - point.weight * point.tangent;
  }
  chain.intervals.push_back(points);
  add_forces(chain);
  if (inertia_.lumped)
    add_nodes(chain);
  else
    add_mass_points(chain);
  return chain;
}

void ForceBeamMotionPort::add_forces(AngleChain& chain) const {
  const std::size_t m = chain.unknowns;
  std::size_t first = rotations();
  const auto add = [&](AngleChain::Rows& rows, bool axial) {
    const std::size_t count = chain.arms.size();
    rows = {first, count, std::vector<double>(count * count, 0.0)};
    for (std::size_t p = 0; p < chain.arms.size(); ++p) {
      const FlexureProperties::Local local = flexure_.at(chain.arms[p].s);
      const double strain =
          unit_force() * (axial ? local.axial_compliance : local.shear_compliance);
      rows.values[p * count + p] = strain;
      chain.stiffness[(first + p) * m + first + p] = chain.arms[p].weight * strain * unit_force();
      chain.weights[first + p] = strain;
    }
    first += chain.arms.size();
  };
  if (flexure_.axial_compliance > 0.0) add(chain.axial, true);
  if (flexure_.shear_compliance > 0.0) add(chain.shear, false);
}

/// At the Gauss points, which lie where the tangents before them lead; consistent as far as their
/// rule reaches.
void ForceBeamMotionPort::add_mass_points(AngleChain& chain) const {
  const int order = static_cast<int>(mesh_.order);
  const std::vector<double>& partial = gauss_partial_integrals(order);
  const double h = mesh_.length / static_cast<double>(mesh_.elements);
  const Vec2 start = flexure_.axis.position(0.0);
  Vec2 sum;
  for (std::size_t e = 0; e < mesh_.elements; ++e) {
    const std::size_t first = e * mesh_.order;
    for (std::size_t g = 0; g < mesh_.order; ++g) {
      const AngleChain::Arm& here = chain.arms[first + g];
      AngleChain::Place place{e, {}, first, flexure_.axis.position(here.s) - start - sum};
      for (std::size_t k = 0; k < mesh_.order; ++k) {
        place.parts.push_back(h * partial[g * mesh_.order + k]);
        place.offset = place.offset - place.parts.back() * mesh_.points[first + k].tangent;
      }
      chain.places.push_back(std::move(place));
      chain.points.push_back({here.s, here.weight * inertia_.at(here.s).mass, false, 0,
                              chain.unknowns, here.weight * flexure_.field.per_length});
    }
    for (std::size_t k = 0; k < mesh_.order; ++k)
      sum = sum + chain.arms[first + k].weight * mesh_.points[first + k].tangent;
  }
  if (!inertia_.rotary) return;
  for (std::size_t p = 0; p < chain.arms.size(); ++p) {
    const AngleChain::Arm& here = chain.arms[p];
    chain.directions.push_back({p, !inertia_.shear_rotary});
    chain.points.push_back(
        {here.s, here.weight * inertia_.at(here.s).rotary, true, 0, chain.unknowns, {}});
  }
}

/// At every element's nodes, by the Gauss-Lobatto rule; the flexure's first moves with its base.
void ForceBeamMotionPort::add_nodes(AngleChain& chain) const {
  const QuadratureRule& rule = gauss_lobatto(static_cast<int>(mesh_.order) + 1);
  const std::vector<double> leading = mesh_.antiderivative();
  const double h = mesh_.length / static_cast<double>(mesh_.elements);
  const Vec2 start = flexure_.axis.position(0.0);
  std::vector<MassPoint> sections;
  Vec2 sum;
  for (std::size_t e = 0; e < mesh_.elements; ++e) {
    const std::size_t first = e * mesh_.order;
    for (std::size_t a = 0; a <= mesh_.order; ++a) {
      const double s = std::min(mesh_.length, h * (static_cast<double>(e) + mesh_.node_place(a)));
      const double weight = 0.5 * h * rule.weights[a];
      AngleChain::Place place{e, {}, first, flexure_.axis.position(s) - start - sum};
      for (std::size_t k = 0; k < mesh_.order; ++k) {
        place.parts.push_back(leading[a * mesh_.order + k]);
        place.offset = place.offset - place.parts.back() * mesh_.points[first + k].tangent;
      }
      chain.places.push_back(std::move(place));
      chain.points.push_back({s, weight * inertia_.at(s).mass, false, 0, chain.unknowns,
                              weight * flexure_.field.per_length});
      sections.push_back({s, weight * inertia_.at(s).rotary, true, 0, chain.unknowns, {}});
    }
    for (std::size_t k = 0; k < mesh_.order; ++k)
      sum = sum + chain.arms[first + k].weight * mesh_.points[first + k].tangent;
  }
  if (!inertia_.rotary) return;
  chain.points.insert(chain.points.end(), sections.begin(), sections.end());
  add_node_arms(chain);
}

/// Sections at nodes are arms without length, whose shear is that of the element's Gauss points.
void ForceBeamMotionPort::add_node_arms(AngleChain& chain) const {
  const std::size_t n = rotations();
  const std::vector<double> nodes = gauss_lobatto(static_cast<int>(mesh_.order) + 1).nodes;
  const std::vector<double>& places = gauss_legendre(static_cast<int>(mesh_.order)).nodes;
  for (std::size_t e = 0; e < mesh_.elements; ++e)
    for (std::size_t a = 0; a <= mesh_.order; ++a) {
      const std::size_t node = e * mesh_.order + a;
      const double s = mesh_.length * (static_cast<double>(e) + mesh_.node_place(a)) /
                       static_cast<double>(mesh_.elements);
      chain.directions.push_back({chain.arms.size(), !inertia_.shear_rotary});
      chain.arms.push_back({0.0, flexure_.axis.tangent_angle(std::min(s, mesh_.length)), 1.0, s});
      chain.turns.values.resize(chain.arms.size() * n, 0.0);
      if (node > 0) chain.turns.values[(chain.arms.size() - 1) * n + node - 1] = 1.0;
      for (AngleChain::Rows* rows : {&chain.axial, &chain.shear}) {
        if (rows->count == 0) continue;
        rows->values.resize(chain.arms.size() * rows->count, 0.0);
        double* row = rows->values.data() + (chain.arms.size() - 1) * rows->count;
        for (std::size_t g = 0; g < mesh_.order; ++g) {
          const std::size_t own = e * mesh_.order + g;
          row[own] = rows->values[own * rows->count + own];
          for (std::size_t k = 0; k < mesh_.order; ++k)
            if (k != g) row[own] *= (nodes[a] - places[k]) / (places[g] - places[k]);
        }
      }
    }
}

std::vector<double> ForceBeamMotionPort::adopt(std::span<const SectionState> sections,
                                               std::span<const double> internal) const {
  std::vector<double> y(internal.begin(), internal.end());
  const auto add = [&](double SectionState::*force) {
    for (const BeamMesh::GaussPoint& point : mesh_.points) {
      const double at = point.s / mesh_.length * static_cast<double>(sections.size() - 1);
      y.push_back(sections[static_cast<std::size_t>(std::lround(at))].*force / unit_force());
    }
  };
  if (flexure_.axial_compliance > 0.0) add(&SectionState::axial_force);
  if (flexure_.shear_compliance > 0.0) add(&SectionState::shear_force);
  return y;
}

/// Rotations are interpolated; every Gauss point takes the force of the nearest.
void ForceBeamMotionPort::prolong(std::span<const double> internal,
                                  std::span<double> refined) const {
  const BeamMesh fine(flexure_.axis, 2 * settings_.elements, settings_.order);
  const std::size_t turns = fine.nodes() - 1;
  prolong_nodes(mesh_, fine, 1, internal.first(rotations()), refined.first(turns));
  const std::size_t coarse_points = mesh_.points.size();
  const std::size_t forces = (internal.size() - rotations()) / coarse_points;
  for (std::size_t f = 0; f < forces; ++f)
    for (std::size_t p = 0; p < fine.points.size(); ++p)
      refined[turns + f * fine.points.size() + p] =
          internal[rotations() + f * coarse_points + p / 2];
}

}  // namespace

std::shared_ptr<const MotionPort> make_force_beam_motion_port(const FlexureProperties& flexure,
                                                              const FlexureInertia& inertia,
                                                              const BeamSettings& settings) {
  return std::make_shared<ForceBeamMotionPort>(flexure, inertia, settings);
}

}  // namespace flexura

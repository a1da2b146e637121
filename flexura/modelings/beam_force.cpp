#include <cmath>

#include "flexura/assembly/angle_field.hpp"
#include "flexura/energy/reissner.hpp"
#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/point_compliances.hpp"

namespace flexura {
namespace {

/// The same elements with the forces as unknowns. At p Gauss points the displacement elements'
/// nodal equilibrium makes the force constant along the flexure, so nodal rotations are all that is
/// left inside.
class ForceBeamPort final : public TwoPort {
  auto potential() const {
    return [this](std::size_t g, const auto& theta, const auto& fx, const auto& fy) {
      // an interpolated axis is a little shorter than the true one: less for the force to displace
      const Pack2 shorter{mesh_stretch(g) - 1.0, mesh_stretch(g + 1) - 1.0};
      auto along = fx * cos(theta) + fy * sin(theta);
      along *= shorter;
      return reissner_mixed_potential(theta, fx, fy, compliances_.axial(g), compliances_.shear(g)) -
             along;
    };
  }

 public:
  ForceBeamPort(const FlexureProperties& flexure, BeamSettings settings);

  std::size_t internal_size() const override { return field_.unknowns; }
  std::size_t scratch_size() const override { return field_.scratch_size(); }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override {
    return linearize_angle_field(field_, potential(), load, internal, scratch);
  }
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override {
    return angle_field_hessian(field_, potential(), load, internal);
  }
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override {
    return std::make_shared<ForceBeamPort>(
        flexure_, BeamSettings{2 * settings_.elements, settings_.order, {}});
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override {
    prolong_nodes(mesh_, BeamMesh(flexure_.axis, 2 * settings_.elements, settings_.order), 1,
                  internal, refined);
  }
  double error_ratio() const override { return halving_error_ratio(mesh_); }

 private:
  double mesh_stretch(std::size_t point) const {
    return point < mesh_.points.size() ? mesh_.points[point].stretch : 1.0;
  }

  FlexureProperties flexure_;
  BeamSettings settings_;
  BeamMesh mesh_;
  AngleField field_;
  PointCompliances compliances_;
};

ForceBeamPort::ForceBeamPort(const FlexureProperties& flexure, BeamSettings settings)
    : flexure_(flexure),
      settings_(settings),
      mesh_(flexure.axis, settings.elements, settings.order) {
  const std::size_t n = mesh_.nodes() - 1;
  const std::size_t per = mesh_.order + 1;
  field_.unknowns = n;
  field_.stiffness.assign(n * n, 0.0);
  field_.tip_turn.assign(n, 0.0);
  field_.tip_turn.back() = 1.0;
  field_.turns.assign(mesh_.points.size() * n, 0.0);
  Vec2 drawn;
  for (std::size_t p = 0; p < mesh_.points.size(); ++p) {
    const std::size_t first = p / mesh_.order * mesh_.order;
    const double* shape = mesh_.shape.data() + p % mesh_.order * per;
    const double* slope = mesh_.slope.data() + p % mesh_.order * per;
    const double weight = mesh_.points[p].weight;
    for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
      const std::size_t i = first + a - 1;
      field_.turns[p * n + i] = shape[a];
      for (std::size_t b = first == 0 ? 1 : 0; b < per; ++b)
        field_.stiffness[i * n + first + b - 1] +=
            weight * flexure.at(mesh_.points[p].s).bending_stiffness * slope[a] * slope[b];
    }
    field_.weights.push_back(weight);
    compliances_.add(flexure.at(mesh_.points[p].s));
    field_.angles.push_back(mesh_.points[p].angle);
    drawn = drawn + weight * mesh_.points[p].tangent;
  }
  field_.offset = flexure.axis.position(mesh_.length) - flexure.axis.position(0.0) - drawn;
  field_.complete_pairs();
}

std::vector<SectionState> ForceBeamPort::sections(const Eigen::Vector3d& load,
                                                  std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  std::vector<double> nodal(1, 0.0);
  nodal.insert(nodal.end(), internal.begin(), internal.end());
  const Vec2 f{load[0], load[1]};
  const auto turn_at = [&](double s) {
    double turn = 0.0;
    mesh_.interpolate(s, nodal, std::span(&turn, 1));
    return turn;
  };
  std::vector<Pose> poses;
  Vec2 moved;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    poses.push_back({moved, turn_at(grid.s[k])});
    if (k + 1 == grid.s.size()) break;
    for (std::size_t g = grid.first[k]; g < grid.first[k + 1]; ++g) {
      const FlexureProperties::Local local = flexure_.at(grid.nodes[g].s);
      const Vec2 e = unit(grid.nodes[g].angle + turn_at(grid.nodes[g].s));
      moved = moved + grid.nodes[g].weight * ((1.0 + local.axial_compliance * dot(f, e)) * e +
                                              local.shear_compliance * dot(f, perp(e)) * perp(e));
    }
  }
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < poses.size(); ++k)
    states.push_back(section_at(grid, k, poses[k], poses.back().position, load));
  return states;
}

}  // namespace

std::shared_ptr<const TwoPort> make_force_beam_port(const FlexureProperties& flexure,
                                                    const BeamSettings& settings) {
  return std::make_shared<ForceBeamPort>(flexure, settings);
}

}  // namespace flexura

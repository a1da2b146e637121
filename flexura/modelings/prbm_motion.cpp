#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/angle_chain.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {
namespace {

constexpr int points_per_joint = 8;

/// A joint stands for the bending of its share of the flexure: a section inside that share turns
/// with the part of the joint's rotation that lies before it, about the joint, and carries its mass
/// along.
class PrbmMotionPort final : public MotionPort {
 public:
  PrbmMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                 const PseudoRigidChain& chain)
      : flexure_(flexure),
        inertia_(inertia),
        still_(make_prbm_port(flexure, chain)),
        motion_(make_chain(chain)) {}

  std::size_t internal_size() const override { return motion_.chain().unknowns; }
  BandLayout layout() const override { return dense_layout(internal_size()); }
  const std::vector<MassPoint>& points() const override { return motion_.chain().points; }
  std::size_t scratch_size() const override { return motion_.scratch_size(); }
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
    return still_->sections(load, {y, internal_size()});
  }
  std::vector<Vec2> drawn_axis(std::span<const SectionState> sections,
                               const double* y) const override {
    return still_->drawn_axis(sections, {y, internal_size()});
  }
  std::vector<double> adopt(std::span<const SectionState> /*sections*/,
                            std::span<const double> internal) const override {
    return {internal.begin(), internal.end()};
  }

 private:
  AngleChain make_chain(const PseudoRigidChain& rigid) const;
  void add_points(AngleChain& chain, std::size_t joint, Vec2 pivot, double from, double to) const;

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  std::shared_ptr<const TwoPort> still_;
  AngleChainMotion motion_;
};

AngleChain PrbmMotionPort::make_chain(const PseudoRigidChain& rigid) const {
  const Vec2 start = flexure_.axis.position(0.0);
  const double length = flexure_.axis.length();
  const Vec2 chord = flexure_.axis.position(length) - start;
  const std::size_t n = rigid.joints.size();
  std::vector<Vec2> vertices{{}};
  for (const Vec2 joint : rigid.joints) vertices.push_back(joint - start);
  vertices.push_back(chord);
  double compliance = 0.0;
  for (const double k : rigid.stiffness) compliance += 1.0 / k;

  AngleChain chain;
  chain.unknowns = n;
  chain.turns = {0, n, {}};
  chain.stiffness.assign(n * n, 0.0);
  chain.tip_turn.assign(n, 1.0);
  chain.tip_offset = chord;
  double share = 0.0;
  for (std::size_t segment = 0; segment <= n; ++segment) {
    const Vec2 link = vertices[segment + 1] - vertices[segment];
    chain.intervals.push_back(chain.arms.size());
    chain.arms.push_back({norm(link), std::atan2(link.y, link.x), 1.0, 0.0});
    for (std::size_t i = 0; i < n; ++i) chain.turns.values.push_back(i < segment ? 1.0 : 0.0);
    chain.tip_offset = chain.tip_offset - chain.arms.back().weight * unit(chain.arms.back().angle);
    if (segment == 0) continue;
    const std::size_t joint = segment - 1;
    const double own = 1.0 / rigid.stiffness[joint] / compliance;
    add_points(chain, joint, vertices[segment], length * share, length * (share + own));
    share += own;
    chain.stiffness[joint * n + joint] = rigid.stiffness[joint];
  }
  chain.intervals.push_back(chain.arms.size());
  const std::size_t places = chain.points.size();
  for (std::size_t g = 0; g < places && inertia_.rotary; ++g) {
    const double s = chain.points[g].s;
    const double weight = chain.arms[chain.places[g].first_arm].s;
    chain.directions.push_back({chain.places[g].first_arm, false});
    chain.points.push_back({s, weight * inertia_.at(s).rotary, true, 0, n, {}});
  }
  return chain;
}

/// Mass points of a joint's share, each on an arm of its own without weight in the chain.
void PrbmMotionPort::add_points(AngleChain& chain, std::size_t joint, Vec2 pivot, double from,
                                double to) const {
  const QuadratureRule& rule = gauss_legendre(points_per_joint);
  const Vec2 start = flexure_.axis.position(0.0);
  for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
    const double part = 0.5 * (1.0 + rule.nodes[g]);
    const double s = from + part * (to - from);
    const double weight = 0.5 * rule.weights[g] * (to - from);
    const Vec2 arm = flexure_.axis.position(s) - start - pivot;
    chain.places.push_back({joint + 1, {norm(arm)}, chain.arms.size(), {}});
    chain.arms.push_back({0.0, std::atan2(arm.y, arm.x), 1.0, weight});
    for (std::size_t i = 0; i < chain.unknowns; ++i)
      chain.turns.values.push_back(i < joint ? 1.0 : (i == joint ? part : 0.0));
    chain.points.push_back({s, weight * inertia_.at(s).mass, false, 0, chain.unknowns,
                            weight * flexure_.field.per_length});
  }
}

}  // namespace

std::shared_ptr<const MotionPort> make_prbm_motion_port(const FlexureProperties& flexure,
                                                        const FlexureInertia& inertia,
                                                        const PseudoRigidChain& chain) {
  return std::make_shared<PrbmMotionPort>(flexure, inertia, chain);
}

}  // namespace flexura

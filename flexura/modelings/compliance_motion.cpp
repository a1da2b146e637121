#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {
namespace {

constexpr int points_per_piece = 12;
constexpr double vanishing = 1e-14;  // compliance against the largest

/// The flexures of `linear` and `scmbm`. Unknowns are the displacements of the tip's point along
/// the principal directions of its compliance (in lengths of the flexure), those that have none
/// left out: nothing moves along them.
class CompliantMotionPort final : public MotionPort {
 public:
  CompliantMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia, Vec2 at);

  std::size_t internal_size() const override { return stiffness_.size(); }
  BandLayout layout() const override { return dense_layout(internal_size()); }
  const std::vector<MassPoint>& points() const override { return points_; }
  std::size_t scratch_size() const override { return 0; }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;

 private:
  Eigen::Matrix3d motion_per_load(double s) const;
  void add_point(double s, double weight);

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  Vec2 at_;                                          // drawn
  Vec2 from_base_;                                   // of it
  double strain_ = 0.0;                              // of the temperature
  Eigen::Matrix<double, 3, Eigen::Dynamic> shapes_;  // displacement of the point per unknown
  Eigen::Matrix<double, 3, Eigen::Dynamic> loads_;   // load per unknown
  std::vector<double> stiffness_;
  std::vector<MassPoint> points_;
  std::vector<Vec2> drawn_;
  std::vector<Vec2> slopes_;
  std::shared_ptr<const CompliantPort> still_;
  std::vector<double> heat_;  // force of heat on every unknown
};

CompliantMotionPort::CompliantMotionPort(const FlexureProperties& flexure,
                                         const FlexureInertia& inertia, Vec2 at)
    : flexure_(flexure),
      inertia_(inertia),
      at_(at),
      from_base_(at - flexure.axis.position(0.0)),
      strain_(flexure.field.strain),
      still_(std::make_shared<CompliantPort>(flexure, at)) {
  const double length = flexure_.axis.length();
  const Eigen::Vector3d scale(1.0 / length, 1.0 / length, 1.0);
  const Eigen::Matrix3d compliance =
      scale.asDiagonal() * compliance_matrix(flexure_, at_) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(compliance);
  const Eigen::Vector3d& values = principal.eigenvalues();
  for (int i = 0; i < 3; ++i) {
    if (!(values[i] > vanishing * values[2])) continue;
    const auto column = shapes_.cols();
    shapes_.conservativeResize(3, column + 1);
    loads_.conservativeResize(3, column + 1);
    shapes_.col(column) = principal.eigenvectors().col(i).cwiseQuotient(scale);
    loads_.col(column) = principal.eigenvectors().col(i).cwiseProduct(scale) / values[i];
    stiffness_.push_back(1.0 / values[i]);
  }
  const std::vector<double> breaks = flexure_.smooth_breaks();
  const QuadratureRule& rule = gauss_legendre(points_per_piece);
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double half = 0.5 * (breaks[k + 1] - breaks[k]);
    for (std::size_t g = 0; g < rule.nodes.size(); ++g)
      add_point(breaks[k] + half * (1.0 + rule.nodes[g]), half * rule.weights[g]);
  }
}

/// Displacement and rotation of the section at s per load on the tip's point.
Eigen::Matrix3d CompliantMotionPort::motion_per_load(double s) const {
  const AxisCurve& axis = flexure_.axis;
  const Vec2 here = axis.position(s);
  Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();
  std::vector<double> cuts{0.0};
  for (const double b : flexure_.smooth_breaks())
    if (b > 0.0 && b < s) cuts.push_back(b);
  cuts.push_back(s);
  const QuadratureRule& rule =
      gauss_legendre(points_per_piece + 2 * static_cast<int>(std::ceil(axis.turning())));
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double half = 0.5 * (cuts[k + 1] - cuts[k]);
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double at = cuts[k] + half * (1.0 + rule.nodes[g]);
      const double ds = half * rule.weights[g];
      const Vec2 place = axis.position(at);
      const Vec2 t = unit(axis.tangent_angle(at));
      const Vec2 ahead = at_ - place;
      const Vec2 back = here - place;
      const FlexureProperties::Local local = flexure_.at(at);
      const Eigen::Vector3d moved(-back.y, back.x, 1.0);
      const Eigen::Vector3d bent(-ahead.y, ahead.x, 1.0);
      const Eigen::Vector3d axial(t.x, t.y, 0.0);
      const Eigen::Vector3d normal(-t.y, t.x, 0.0);
      motion += ds / local.bending_stiffness * moved * bent.transpose() +
                ds * local.axial_compliance * axial * axial.transpose() +
                ds * local.shear_compliance * normal * normal.transpose();
    }
  }
  return motion;
}

void CompliantMotionPort::add_point(double s, double weight) {
  const Eigen::Matrix<double, 3, Eigen::Dynamic> motion = motion_per_load(s) * loads_;
  const std::size_t m = internal_size();
  const SectionInertia section = inertia_.at(s);
  const double angle = flexure_.axis.tangent_angle(s);
  const auto add = [&](double inertia, bool direction, Vec2 drawn, Vec2 force) {
    points_.push_back({s, weight * inertia, direction, 0, m, force});
    drawn_.push_back(drawn);
    for (std::size_t i = 0; i < m; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      slopes_.push_back(direction ? motion(2, column) * perp(drawn)
                                  : Vec2{motion(0, column), motion(1, column)});
    }
  };
  add(section.mass, false, flexure_.axis.position(s) - flexure_.axis.position(0.0),
      weight * flexure_.field.per_length);
  if (heat_.empty()) heat_.assign(m, 0.0);
  // what heat lengthens works against the axial force that goes with each unknown
  for (std::size_t i = 0; i < m; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    heat_[i] += weight * strain_ * dot(unit(angle), {loads_(0, column), loads_(1, column)});
  }
  if (inertia_.rotary) add(section.rotary, true, unit(angle), {});
}

/// 1/2 sum k y^2 less the tip's load times displacement; heat displaces the tip without energy.
MotionPort::Answer CompliantMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                                 const double* v, const double* a,
                                                 MemberWork& work) const {
  const std::size_t m = internal_size();
  Answer answer{0.0, {from_base_.x, from_base_.y, 0.0}};
  for (std::size_t i = 0; i < m; ++i) {
    const Eigen::Vector3d shape = shapes_.col(static_cast<Eigen::Index>(i));
    const double elastic = y[i] - heat_[i] / stiffness_[i];
    answer.energy += 0.5 * stiffness_[i] * elastic * elastic;
    answer.tip += y[i] * shape;
    double* column = work.columns.data() + 4 * i;
    column[0] = stiffness_[i] * elastic - load.dot(shape);
    for (int c = 0; c < 3; ++c) column[c + 1] = -shape[c];
  }
  const Vec2* slope = slopes_.data();
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Vec2 place = drawn_[g], rate, second;
    for (std::size_t i = 0; i < m; ++i, ++slope) {
      place = place + y[i] * *slope;
      rate = rate + v[i] * *slope;
      second = second + a[i] * *slope;
    }
    work.places[g] = place;
    work.rates[g] = rate;
    work.seconds[g] = second;
  }
  return answer;
}

void CompliantMotionPort::add_forces(const Vec2* forces, MemberWork& /*work*/,
                                     double* residual) const {
  const Vec2* slope = slopes_.data();
  for (std::size_t g = 0; g < points_.size(); ++g)
    for (std::size_t i = 0; i < internal_size(); ++i, ++slope)
      residual[i] += dot(forces[g], *slope);
}

void CompliantMotionPort::linearize(const Eigen::Vector3d& /*load*/, const double* /*y*/,
                                    const Vec2* /*weights*/, MemberWork& work) const {
  const std::size_t m = internal_size();
  std::fill(work.tangent.begin(), work.tangent.end(), 0.0);
  for (std::size_t i = 0; i < m; ++i) work.tangent[i * m + i] = stiffness_[i];
  work.slopes = slopes_;
}

/// As a load on the tip alone would bend it.
std::vector<SectionState> CompliantMotionPort::sections(const Eigen::Vector3d& /*load*/,
                                                        const double* y) const {
  Eigen::Vector3d load = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < internal_size(); ++i)
    load += (y[i] - heat_[i] / stiffness_[i]) * loads_.col(static_cast<Eigen::Index>(i));
  Surroundings surroundings;
  surroundings.load_factor = 1.0;
  FlexureProperties heated = flexure_;
  heated.field.per_length = {};
  return CompliantPort(heated, at_).sections_in(surroundings, load, {});
}

std::vector<double> CompliantMotionPort::adopt(std::span<const SectionState> sections,
                                               std::span<const double> /*internal*/) const {
  const Pose& tip = sections.back().pose;
  const Vec2 start = flexure_.axis.position(0.0);
  const Vec2 end = flexure_.axis.position(flexure_.axis.length());
  const Vec2 moved = tip.position - (end - start) + rotate(tip.rotation, at_ - end) - (at_ - end);
  const Eigen::Vector3d displacement(moved.x, moved.y, tip.rotation);
  std::vector<double> y;
  for (std::size_t i = 0; i < internal_size(); ++i)
    y.push_back(loads_.col(static_cast<Eigen::Index>(i)).dot(displacement) / stiffness_[i]);
  return y;
}

}  // namespace

std::shared_ptr<const MotionPort> make_compliant_motion_port(const FlexureProperties& flexure,
                                                             const FlexureInertia& inertia,
                                                             Vec2 at) {
  return std::make_shared<CompliantMotionPort>(flexure, inertia, at);
}

}  // namespace flexura

#include "flexura/modelings/bcm.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/symmetric_factor.hpp"
#include "flexura/energy/beam_constraint.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// Unknowns y of element k: transverse displacement y[2k] of its end over its length, and rotation
/// y[2k + 1] of its end, both in the frame of its start. That frame is at the angle
/// Theta_k = drawn angle + sum of rotations before, so with l the elements' length,
///     W = sum_k [ EI/l H(delta_k, theta_k, p_k) - l f.(t_k + delta_k n_k) ] - mu sum_k theta_k,
///     p_k = f.t_k l^2/EI.
class BcmPort final : public TwoPort {
 public:
  BcmPort(const FlexureProperties& flexure, BcmSettings settings)
      : flexure_(flexure),
        count_(static_cast<std::size_t>(settings.elements)),
        length_(flexure.axis.length() / settings.elements),
        angle_(flexure.axis.tangent_angle(0.0)) {
    Vec2 drawn;
    for (std::size_t k = 0; k < count_; ++k) drawn = drawn + length_ * unit(angle_);
    offset_ = flexure.axis.position(flexure.axis.length()) - flexure.axis.position(0.0) - drawn;
  }

  std::size_t internal_size() const override { return 2 * count_; }
  std::size_t scratch_size() const override {
    const std::size_t m = internal_size();
    return m * (8 + 2 * m + 1);
  }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override;
  /// One element is a model of its own, not a discretization.
  std::shared_ptr<const TwoPort> refined() const override {
    if (count_ == 1) return nullptr;
    return std::make_shared<BcmPort>(flexure_, BcmSettings{2 * static_cast<int>(count_)});
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return 8.0 / 7.0; }

 private:
  using Jet = Jet2<5>;  // frame's angle, delta, theta, fx, fy

  struct Sums {
    Jet potential;
    double turn = 0.0;
  };

  Sums assemble(const Eigen::Vector3d& load, const double* y, double* columns,
                double* tangent) const;
  Jet element_potential(double angle, const double* y, const Eigen::Vector3d& load) const;
  void add_element(std::size_t element, const Jet& w, double* columns, double* tangent) const;
  Vec2 element_end(const Eigen::Vector3d& load, double angle, const double* y) const;

  FlexureProperties flexure_;
  std::size_t count_;
  double length_;  // of an element
  double angle_;   // as drawn
  Vec2 offset_;    // rounding: free of stress as drawn
};

BcmPort::Jet BcmPort::element_potential(double angle, const double* y,
                                        const Eigen::Vector3d& load) const {
  const double ei = flexure_.bending_stiffness;
  const Jet turn = Jet::variable(0, angle);
  const Jet delta = Jet::variable(1, y[0]);
  const Jet theta = Jet::variable(2, y[1]);
  const Jet fx = Jet::variable(3, load[0]);
  const Jet fy = Jet::variable(4, load[1]);
  const Jet c = cos(turn);
  const Jet s = sin(turn);
  const Jet along = fx * c + fy * s;
  const Jet across = fy * c - fx * s;
  const double axial = flexure_.axial_compliance * ei / (length_ * length_);
  const Jet h = beam_constraint_potential(delta, theta, along * (length_ * length_ / ei), axial);
  return (ei / length_) * h - length_ * (along + across * delta);
}

/// By y, the frame's angle is the sum of all rotations before the element's.
void BcmPort::add_element(std::size_t element, const Jet& w, double* columns,
                          double* tangent) const {
  const std::size_t m = internal_size();
  const std::size_t own = 2 * element;
  const auto variable = [&](std::size_t i) { return i < own ? 0 : i - own + 1; };
  for (std::size_t i = 0; i < own + 2; ++i) {
    if (i < own && i % 2 == 0) continue;  // displacements do not turn what follows
    const std::size_t a = variable(i);
    columns[4 * i] += w.gradient[a];
    columns[4 * i + 1] += w.second(a, 3);
    columns[4 * i + 2] += w.second(a, 4);
    for (std::size_t j = 0; j <= i; ++j) {
      if (j < own && j % 2 == 0) continue;
      tangent[i * m + j] += w.second(a, variable(j));
    }
  }
}

auto BcmPort::assemble(const Eigen::Vector3d& load, const double* y, double* columns,
                       double* tangent) const -> Sums {
  Sums sums;
  for (std::size_t k = 0; k < count_; ++k) {
    const Jet w = element_potential(angle_ + sums.turn, y + 2 * k, load);
    add_element(k, w, columns, tangent);
    sums.potential += w;
    sums.turn += y[2 * k + 1];
    columns[4 * (2 * k + 1)] -= load[2];
    columns[4 * (2 * k + 1) + 3] = -1.0;
  }
  return sums;
}

TipResponse BcmPort::linearize(const Eigen::Vector3d& load, const double* y,
                               double* scratch) const {
  const std::size_t m = internal_size();
  double* columns = scratch;  // per unknown: W_y, W_yfx, W_yfy, W_ymu
  double* coupling = scratch + 4 * m;
  double* tangent = scratch + 8 * m;
  std::fill_n(scratch, scratch_size(), 0.0);
  const Sums sums = assemble(load, y, columns, tangent);
  std::copy_n(columns, 4 * m, coupling);

  const Jet& sum = sums.potential;
  TipResponse response;
  response.singular = !solve_symmetric(tangent, dense_layout(m), tangent + m * m,
                                       tangent + 2 * m * m, columns, response.negative);
  response.tip = {offset_.x - sum.gradient[3], offset_.y - sum.gradient[4], sums.turn};
  response.strain_energy = sum.value - load[0] * sum.gradient[3] - load[1] * sum.gradient[4];
  response.flexibility << -sum.second(3, 3), -sum.second(3, 4), 0.0,  //
      -sum.second(4, 3), -sum.second(4, 4), 0.0,                      //
      0.0, 0.0, 0.0;
  add_eliminated(m, coupling, columns, response);
  return response;
}

Eigen::MatrixXd BcmPort::hessian(const Eigen::Vector3d& load, const double* y) const {
  const std::size_t m = internal_size();
  std::vector<double> columns(4 * m), tangent(m * m);
  const Jet sum = assemble(load, y, columns.data(), tangent.data()).potential;
  Eigen::Matrix3d by_load = Eigen::Matrix3d::Zero();
  by_load.topLeftCorner<2, 2>() << sum.second(3, 3), sum.second(3, 4), sum.second(4, 3),
      sum.second(4, 4);
  return port_hessian(columns.data(), dense_layout(m), tangent.data(), by_load);
}

/// From the element's start, in axes fixed to the flexure's base body.
Vec2 BcmPort::element_end(const Eigen::Vector3d& load, double angle, const double* y) const {
  const Jet w = element_potential(angle, y, load);
  return {-w.gradient[3], -w.gradient[4]};
}

/// Between an element's ends the deflection is the cubic that its ends determine, and shortens the
/// element as its slope's square does, scaled to end where the element ends.
std::vector<SectionState> BcmPort::sections(const Eigen::Vector3d& load,
                                            std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.axis.breaks());
  std::vector<Pose> starts{{{}, 0.0}};
  for (std::size_t k = 0; k < count_; ++k) {
    const Pose& start = starts.back();
    const double* y = internal.data() + 2 * k;
    starts.push_back(
        {start.position + element_end(load, angle_ + start.rotation, y), start.rotation + y[1]});
  }
  const Vec2 f{load[0], load[1]};
  std::vector<SectionState> states;
  for (const double s : grid.s) {
    const std::size_t e = std::min(static_cast<std::size_t>(s / length_), count_ - 1);
    const double x = s / length_ - static_cast<double>(e);
    const double d = internal[2 * e];
    const double t = internal[2 * e + 1];
    // w = (3d - t) x^2 + (t - 2d) x^3 = a x^2 + b x^3, in element lengths
    const double a = 3.0 * d - t;
    const double b = t - 2.0 * d;
    const auto shortening = [&](double at) {
      return at * at * at * (4.0 / 3.0 * a * a + at * (3.0 * a * b + at * 1.8 * b * b));
    };
    const double frame = angle_ + starts[e].rotation;
    const Vec2 end = rotate(-frame, starts[e + 1].position - starts[e].position);
    const double axial = flexure_.axial_compliance * dot(f, unit(frame));
    const double whole = shortening(1.0);
    const double share = whole > 0.0 ? shortening(x) / whole : x;
    const double along = length_ * x * (1.0 + axial) + share * (end.x - length_ * (1.0 + axial));
    const double across = length_ * x * x * (a + b * x);
    const Pose moved{starts[e].position + rotate(frame, {along, across}),
                     starts[e].rotation + x * (2.0 * a + 3.0 * b * x)};
    const Vec2 tangent = unit(angle_ + moved.rotation);
    states.push_back({moved, dot(f, tangent), dot(f, perp(tangent)),
                      load[2] + cross(starts.back().position - moved.position, f)});
  }
  return states;
}

/// Cuts every element in the middle of its cubic.
void BcmPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  for (std::size_t k = 0; k < count_; ++k) {
    const double d = internal[2 * k];
    const double t = internal[2 * k + 1];
    const double middle = 0.5 * d - 0.125 * t;
    const double slope = 1.5 * d - 0.25 * t;
    refined[4 * k] = 2.0 * middle;
    refined[4 * k + 1] = slope;
    refined[4 * k + 2] = 2.0 * (d - middle) * std::cos(slope) - std::sin(slope);
    refined[4 * k + 3] = t - slope;
  }
}

}  // namespace

std::shared_ptr<const TwoPort> make_bcm_port(const FlexureProperties& flexure,
                                             const BcmSettings& settings) {
  return std::make_shared<BcmPort>(flexure, settings);
}

}  // namespace flexura

#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "flexura/core/jet2.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/flexure_inertia.hpp"
#include "flexura/modelings/lagrange_beam.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {

/// Beam elements from an energy density, in motion: a LagrangeBeamPort with masses at the Gauss
/// points of one more than the order (consistent) or at the nodes (lumped).
template <class Density>
class LagrangeMotionPort final : public MotionPort {
 public:
  LagrangeMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                     BeamSettings settings, Density density)
      : flexure_(flexure),
        inertia_(inertia),
        settings_(settings),
        still_(flexure, settings, std::move(density)),
        chord_(flexure.axis.position(mesh().length) - flexure.axis.position(0.0)) {
    if (inertia_.lumped)
      add_nodes();
    else
      add_gauss_points();
  }

  std::size_t internal_size() const override { return still_.internal_size(); }
  BandLayout layout() const override { return band_layout(internal_size(), still_.width()); }
  const std::vector<MassPoint>& points() const override { return points_; }
  /// The energy's second derivatives, and what the axis' derivative measures at every point.
  std::size_t scratch_size() const override { return tangent_size() + shapes_.size(); }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> /*sections*/,
                            std::span<const double> internal) const override {
    return {internal.begin(), internal.end()};
  }
  std::shared_ptr<const MotionPort> refined() const override {
    return std::make_shared<LagrangeMotionPort>(flexure_, inertia_, finer(), still_.density());
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override {
    still_.prolong(internal, refined);
  }
  double error_ratio() const override { return still_.error_ratio(); }

 private:
  /// What a mass point takes of the nodes of its element: shape values, or slopes for a direction
  /// along the axis.
  struct Shape {
    std::size_t first_node = 0;  // moving: the flexure's first node does not count
    std::vector<double> values;
    Vec2 drawn;          // place, or direction
    double angle = 0.0;  // of a direction that turns with the section
    bool turns = false;
    bool along_axis = false;
  };

  const BeamMesh& mesh() const { return still_.mesh(); }
  std::size_t tangent_size() const { return internal_size() * (still_.width() + 1); }
  /// Of a direction along the axis: derivatives of its angle by the axis' derivative.
  static Vec2 angle_slope(Vec2 here, double size) { return (1.0 / size) * perp(here); }
  void linearize_axis(const Shape& shape, Vec2 here, double size, Vec2 weight,
                      double* tangent) const;
  BeamSettings finer() const { return {2 * settings_.elements, settings_.order, {}}; }
  void add_nodes();
  void add_gauss_points();
  void add_points(std::size_t element, double x, double weight, bool node);

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  BeamSettings settings_;
  LagrangeBeamPort<Density> still_;
  Vec2 chord_;
  std::vector<Shape> shapes_;
  std::vector<MassPoint> points_;
};

template <class Density>
void LagrangeMotionPort<Density>::add_gauss_points() {
  const QuadratureRule& rule = gauss_legendre(static_cast<int>(mesh().order) + 1);
  for (std::size_t e = 0; e < mesh().elements; ++e)
    for (std::size_t g = 0; g < rule.nodes.size(); ++g)
      add_points(e, rule.nodes[g], rule.weights[g], false);
}

/// Every element's nodes by the Gauss-Lobatto rule; the flexure's first moves with its base.
template <class Density>
void LagrangeMotionPort<Density>::add_nodes() {
  const QuadratureRule& rule = gauss_lobatto(static_cast<int>(mesh().order) + 1);
  for (std::size_t e = 0; e < mesh().elements; ++e)
    for (std::size_t g = 0; g < rule.nodes.size(); ++g)
      add_points(e, rule.nodes[g], rule.weights[g], true);
}

/// The place and, with rotary inertia, the direction at x in [-1, 1] of an element.
template <class Density>
void LagrangeMotionPort<Density>::add_points(std::size_t element, double x, double weight,
                                             bool node) {
  const double half = 0.5 * mesh().length / static_cast<double>(mesh().elements);
  const double s = std::min(mesh().length, half * (2.0 * static_cast<double>(element) + 1.0 + x));
  const SectionInertia section = inertia_.at(s);
  std::vector<double> values = mesh().shape_at(x);
  std::size_t first = element * mesh().order;  // node
  if (node) {                                  // of one node alone
    const auto own =
        static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    first += own;
    values.assign(1, 1.0);
  }
  if (first == 0)
    values.erase(values.begin());
  else
    --first;
  const auto add = [&](double inertia, bool direction, Vec2 drawn, double angle, Vec2 force) {
    points_.push_back({s, half * weight * inertia, direction, 3 * first, 3 * values.size(), force});
    shapes_.push_back({first, values, drawn, angle, direction});
  };
  add(section.mass, false, flexure_.axis.position(s) - flexure_.axis.position(0.0), 0.0,
      half * weight * flexure_.field.per_length);
  if (!inertia_.rotary) return;
  const double angle = flexure_.axis.tangent_angle(s);
  add(section.rotary, true, unit(angle), angle, {});
  if (inertia_.shear_rotary) return;
  // along the axis: its derivative, but for the length, which no section turns by
  Shape& shape = shapes_.back();
  shape.turns = false;
  shape.along_axis = true;
  shape.values = mesh().slope_at(x);
  shape.first_node = element * mesh().order;
  if (shape.first_node == 0)
    shape.values.erase(shape.values.begin());
  else
    --shape.first_node;
  points_.back().first = 3 * shape.first_node;
  points_.back().count = 3 * shape.values.size();
}

template <class Density>
MotionPort::Answer LagrangeMotionPort<Density>::evaluate(const Eigen::Vector3d& load,
                                                         const double* y, const double* v,
                                                         const double* a, MemberWork& work) const {
  const std::size_t m = internal_size();
  const double length = mesh().length;
  Answer answer;
  answer.energy =
      still_.assemble(y, work.columns.data(), work.scratch.data(), flexure_.field.strain);
  const double* tip = y + m - 3;
  answer.tip = {chord_.x + length * tip[0], chord_.y + length * tip[1], tip[2]};
  const double lever[3] = {length, length, 1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    work.columns[4 * (m - 3 + c)] -= lever[c] * load[static_cast<Eigen::Index>(c)];
    work.columns[4 * (m - 3 + c) + c + 1] = -lever[c];
  }
  for (std::size_t g = 0; g < shapes_.size(); ++g) {
    const Shape& shape = shapes_[g];
    const std::size_t first = 3 * shape.first_node;
    const auto moved = [&](const double* x) {
      Vec2 sum;
      for (std::size_t k = 0; k < shape.values.size(); ++k)
        sum = sum + length * shape.values[k] * Vec2{x[first + 3 * k], x[first + 3 * k + 1]};
      return sum;
    };
    const auto turned = [&](const double* x) {
      double sum = 0.0;
      for (std::size_t k = 0; k < shape.values.size(); ++k)
        sum += shape.values[k] * x[first + 3 * k + 2];
      return sum;
    };
    if (shape.turns) {
      const Vec2 here = unit(shape.angle + turned(y));
      const double spin = turned(v);
      work.places[g] = here;
      work.rates[g] = spin * perp(here);
      work.seconds[g] = turned(a) * perp(here) - spin * spin * here;
    } else if (shape.along_axis) {
      const Vec2 along = shape.drawn + moved(y);
      const double size = norm(along);
      const Vec2 here = (1.0 / size) * along;
      const Vec2 by = angle_slope(here, size);
      const double spin = dot(by, moved(v));
      const double longer = dot(here, moved(v)) / size;
      work.scratch[tangent_size() + g] = size;
      work.places[g] = here;
      work.rates[g] = spin * perp(here);
      work.seconds[g] = (dot(by, moved(a)) - 2.0 * spin * longer) * perp(here) - spin * spin * here;
    } else {
      work.places[g] = shape.drawn + moved(y);
      work.rates[g] = moved(v);
      work.seconds[g] = moved(a);
    }
  }
  return answer;
}

template <class Density>
void LagrangeMotionPort<Density>::add_forces(const Vec2* forces, MemberWork& work,
                                             double* residual) const {
  for (std::size_t g = 0; g < shapes_.size(); ++g) {
    const Shape& shape = shapes_[g];
    double* node = residual + 3 * shape.first_node;
    const double torque = cross(work.places[g], forces[g]);
    const Vec2 force = shape.along_axis
                           ? torque * angle_slope(work.places[g], work.scratch[tangent_size() + g])
                           : forces[g];
    for (const double value : shape.values) {
      if (shape.turns) {
        node[2] += value * torque;
      } else {
        node[0] += mesh().length * value * force.x;
        node[1] += mesh().length * value * force.y;
      }
      node += 3;
    }
  }
}

template <class Density>
void LagrangeMotionPort<Density>::linearize(const Eigen::Vector3d& /*load*/, const double* /*y*/,
                                            const Vec2* weights, MemberWork& work) const {
  std::copy_n(work.scratch.begin(), tangent_size(), work.tangent.begin());
  const BandLayout rows = layout();
  Vec2* slope = work.slopes.data();
  for (std::size_t g = 0; g < shapes_.size(); ++g) {
    const Shape& shape = shapes_[g];
    const Vec2 across = perp(work.places[g]);
    const double size = work.scratch[tangent_size() + g];
    const Vec2 by = shape.along_axis ? angle_slope(work.places[g], size) : Vec2{};
    for (const double value : shape.values) {
      const double along = shape.turns ? 0.0 : mesh().length * value;
      *slope++ = shape.along_axis ? along * by.x * across : Vec2{along, 0.0};
      *slope++ = shape.along_axis ? along * by.y * across : Vec2{0.0, along};
      *slope++ = shape.turns ? value * across : Vec2{};
    }
    if (shape.along_axis && weights)
      linearize_axis(shape, work.places[g], size, weights[g], work.tangent.data());
    if (!shape.turns || !weights) continue;
    const double factor = -dot(weights[g], work.places[g]);
    for (std::size_t a = 0; a < shape.values.size(); ++a) {
      const std::size_t i = 3 * (shape.first_node + a) + 2;
      for (std::size_t b = 0; b <= a; ++b)
        rows.row(work.tangent.data(), i)[3 * (shape.first_node + b) + 2] +=
            factor * shape.values[a] * shape.values[b];
    }
  }
}

/// weight . (second derivatives of the direction): the angle of a vector d has those of the
/// imaginary part of log d, -Im(1/d^2).
template <class Density>
void LagrangeMotionPort<Density>::linearize_axis(const Shape& shape, Vec2 here, double size,
                                                 Vec2 weight, double* tangent) const {
  const BandLayout rows = layout();
  const Vec2 by = angle_slope(here, size);
  const double torque = cross(here, weight) / (size * size);
  const double pull = -dot(here, weight);
  const double twice = 2.0 * here.x * here.y, cosine = here.x * here.x - here.y * here.y;
  const double second[2][2] = {
      {torque * twice + pull * by.x * by.x, -torque * cosine + pull * by.x * by.y},
      {-torque * cosine + pull * by.x * by.y, -torque * twice + pull * by.y * by.y}};
  for (std::size_t a = 0; a < shape.values.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const double share = mesh().length * mesh().length * shape.values[a] * shape.values[b];
      for (std::size_t i = 0; i < 2; ++i) {
        double* row = rows.row(tangent, 3 * (shape.first_node + a) + i);
        for (std::size_t j = 0; j < (a == b ? i + 1 : 2); ++j)
          row[3 * (shape.first_node + b) + j] += share * second[i][j];
      }
    }
}

/// Forces at the Gauss points are superconvergent; stations take them from straight lines between
/// those.
template <class Density>
std::vector<SectionState> LagrangeMotionPort<Density>::sections(const Eigen::Vector3d& /*load*/,
                                                                const double* y) const {
  using Jet = Jet2<4>;
  const StationGrid grid(flexure_.axis, flexure_.smooth_breaks());
  std::vector<double> nodal(3, 0.0);
  nodal.insert(nodal.end(), y, y + internal_size());
  struct Resultants {
    double s, axial, shear, moment;
  };
  std::vector<Resultants> inner;
  const std::size_t per = mesh().order + 1;
  for (std::size_t p = 0; p < mesh().points.size(); ++p) {
    const BeamMesh::GaussPoint& point = mesh().points[p];
    const double* shape = mesh().shape.data() + p % mesh().order * per;
    const double* slope = mesh().slope.data() + p % mesh().order * per;
    const double* node = nodal.data() + 3 * (p / mesh().order * mesh().order);
    double dx = point.tangent.x, dy = point.tangent.y, theta = point.angle, kappa = 0.0;
    for (std::size_t a = 0; a < per; ++a) {
      dx += mesh().length * slope[a] * node[3 * a];
      dy += mesh().length * slope[a] * node[3 * a + 1];
      theta += shape[a] * node[3 * a + 2];
      kappa += slope[a] * node[3 * a + 2];
    }
    const auto energy_of = [&](const auto& density) {
      return density(Jet::variable(0, dx), Jet::variable(1, dy), Jet::variable(2, theta),
                     Jet::variable(3, kappa), point.stretch + flexure_.field.strain);
    };
    const Jet energy = [&] {
      if constexpr (requires { still_.density().at(point.s); })
        return energy_of(still_.density().at(point.s));
      else
        return energy_of(still_.density());
    }();
    const Vec2 force{energy.gradient[0], energy.gradient[1]};
    inner.push_back(
        {point.s, dot(force, unit(theta)), dot(force, perp(unit(theta))), energy.gradient[3]});
  }
  std::vector<SectionState> states;
  std::size_t k = 0;
  for (std::size_t i = 0; i < grid.s.size(); ++i) {
    double u[3];
    mesh().interpolate(grid.s[i], nodal, u);
    while (k + 2 < inner.size() && grid.s[i] > inner[k + 1].s) ++k;
    const Resultants& a = inner[k];
    const Resultants& b = inner[std::min(k + 1, inner.size() - 1)];
    const double share = b.s > a.s ? (grid.s[i] - a.s) / (b.s - a.s) : 0.0;
    const auto between = [&](double Resultants::*r) { return a.*r + share * (b.*r - a.*r); };
    states.push_back({{grid.positions[i] + mesh().length * Vec2{u[0], u[1]}, u[2]},
                      between(&Resultants::axial),
                      between(&Resultants::shear),
                      between(&Resultants::moment)});
  }
  return states;
}

}  // namespace flexura

#include <algorithm>
#include <array>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/core/symmetric_factor.hpp"
#include "flexura/energy/von_karman.hpp"
#include "flexura/modelings/beam_common.hpp"
#include "flexura/modelings/quintic_shape.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

/// Of degree 15: all but the last power of the stretch energy.
constexpr int gauss_points = 8;
/// Displacement u along the member, deflection w, slope w' and w'' of the near node, then of the
/// far one. The turn of the base section is the near slope of the first element.
constexpr std::size_t element_unknowns = 8;
constexpr std::size_t near_slope = 2;
constexpr std::size_t half_width = 7;

/// The elements of the first source as it prints them (eqs. 14 to 19, 27, 30 to 38): von Karman's
/// strains in axes that stay as the member was drawn, linear u, quintic w, sections that turn by
/// w'. Its shear angle occurs in the shear energy alone, which therefore vanishes at the minimum
/// whatever factor it bears; it is left out. Nothing but the member's drawn axes being fixed makes
/// the port feel the turn of its base section.
class PrintedBeamPort final : public TwoPort {
 public:
  PrintedBeamPort(const FlexureProperties& flexure, int elements)
      : flexure_(flexure), elements_(static_cast<std::size_t>(elements)) {
    const AxisCurve& axis = flexure_.axis;
    length_ = axis.length();
    element_length_ = length_ / elements;
    direction_ = (1.0 / length_) * (axis.position(length_) - axis.position(0.0));
  }

  std::size_t internal_size() const override { return 1 + 4 * elements_; }
  std::size_t scratch_size() const override {
    return internal_size() * (12 + 2 * (half_width + 1) + 1);
  }
  bool feels_surroundings() const override { return true; }
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override {
    FieldResponse field;
    return linearize_in({}, load, internal, scratch, field);
  }
  TipResponse linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                           const double* internal, double* scratch,
                           FieldResponse& field) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return sections_in({}, load, internal);
  }
  std::vector<SectionState> sections_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load,
                                        std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override {
    return std::make_shared<PrintedBeamPort>(flexure_, 2 * static_cast<int>(elements_));
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return 4.0 / 3.0; }

 private:
  using Nodal = std::array<double, element_unknowns>;
  struct Energy {
    double value = 0.0;
    Nodal gradient{};
    std::array<Nodal, element_unknowns> hessian{};
  };
  /// What the unknowns of an element make of the place x in [0, 1]: rows of u, w, u', w', w''.
  struct Shape {
    Nodal u, w, du, dw, ddw;
  };

  BandLayout layout() const { return band_layout(internal_size(), half_width); }
  Shape shape(double x) const;
  /// Places of an element's unknowns in the flexure's; -1 for those of the base.
  std::array<int, element_unknowns> places(std::size_t element) const;
  Nodal gather(std::size_t element, const double* y, double turn) const;
  Energy energy(const Nodal& nodal) const;
  /// Derivative of the tip by its unknowns, in axes that have turned.
  Eigen::Matrix3d tip_by_unknowns(double turn) const;
  Eigen::Vector3d tip(const double* y, double turn) const;

  FlexureProperties flexure_;
  std::size_t elements_;
  double length_ = 0.0;
  double element_length_ = 0.0;
  Vec2 direction_;
};

double product(const std::array<double, element_unknowns>& row,
               const std::array<double, element_unknowns>& nodal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < element_unknowns; ++i) sum += row[i] * nodal[i];
  return sum;
}

/// Displacements and w'' are unknowns in units of the flexure's length. The quintic bends from the
/// chord between the nodes.
auto PrintedBeamPort::shape(double x) const -> Shape {
  const QuinticShape n = quintic_shape(x);
  const double h = element_length_, l = length_, r = l / h;
  const auto deflection = [&](const std::array<double, 4>& f, double near, double far,
                              double unit) -> Nodal {
    const double chord = unit * r * (f[0] + f[1]);
    return {0.0, near + chord, unit * f[0], unit * h * f[2] / l,
            0.0, far - chord,  unit * f[1], unit * h * f[3] / l};
  };
  return {{l * (1.0 - x), 0.0, 0.0, 0.0, l * x, 0.0, 0.0, 0.0},
          deflection(n.value, l * (1.0 - x), l * x, h),
          {-r, 0.0, 0.0, 0.0, r, 0.0, 0.0, 0.0},
          deflection(n.slope, -r, r, 1.0),
          deflection(n.bend, 0.0, 0.0, 1.0 / h)};
}

/// [w'' of node 0], then u, w, w', w'' of every other node.
std::array<int, element_unknowns> PrintedBeamPort::places(std::size_t element) const {
  const int far = 1 + 4 * static_cast<int>(element);
  if (element == 0) return {-1, -1, -1, 0, far, far + 1, far + 2, far + 3};
  return {far - 4, far - 3, far - 2, far - 1, far, far + 1, far + 2, far + 3};
}

auto PrintedBeamPort::gather(std::size_t element, const double* y, double turn) const -> Nodal {
  Nodal nodal{};
  const auto at = places(element);
  for (std::size_t i = 0; i < element_unknowns; ++i)
    if (at[i] >= 0) nodal[i] = y[at[i]];
  if (element == 0) nodal[near_slope] = turn;
  return nodal;
}

auto PrintedBeamPort::energy(const Nodal& nodal) const -> Energy {
  using Point = Jet2<3>;  // u', w', w''
  const QuadratureRule& rule = gauss_legendre(gauss_points);
  Energy sum;
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const Shape at = shape(0.5 * (1.0 + rule.nodes[q]));
    const std::array<const Nodal*, 3> by{&at.du, &at.dw, &at.ddw};
    const Point dw = Point::variable(1, product(at.dw, nodal));
    const Point strain = von_karman_axial_strain(Point::variable(0, product(at.du, nodal)), dw);
    const Point kappa = graph_curvature(dw, Point::variable(2, product(at.ddw, nodal)));
    Point density = (0.5 / flexure_.axial_compliance) * (strain * strain) +
                    (0.5 * flexure_.bending_stiffness) * (kappa * kappa);
    density *= 0.5 * element_length_ * rule.weights[q];
    sum.value += density.value;
    for (std::size_t i = 0; i < element_unknowns; ++i) {
      for (std::size_t v = 0; v < 3; ++v) {
        const double row = (*by[v])[i];
        if (row == 0.0) continue;
        sum.gradient[i] += density.gradient[v] * row;
        for (std::size_t w = 0; w < 3; ++w)
          for (std::size_t j = 0; j < element_unknowns; ++j)
            sum.hessian[i][j] += density.second(v, w) * row * (*by[w])[j];
      }
    }
  }
  return sum;
}

Eigen::Matrix3d PrintedBeamPort::tip_by_unknowns(double turn) const {
  const Vec2 along = length_ * rotate(-turn, direction_);
  const Vec2 across = perp(along);
  Eigen::Matrix3d by;
  by << along.x, across.x, 0.0, along.y, across.y, 0.0, 0.0, 0.0, 1.0;
  return by;
}

/// The tip's slope is counted from that of the base.
Eigen::Vector3d PrintedBeamPort::tip(const double* y, double turn) const {
  const double* last = y + internal_size() - 4;
  return tip_by_unknowns(turn) * Eigen::Vector3d(1.0 + last[0], last[1], last[2]) -
         Eigen::Vector3d(0.0, 0.0, turn);
}

TipResponse PrintedBeamPort::linearize_in(const Surroundings& surroundings,
                                          const Eigen::Vector3d& load, const double* y,
                                          double* scratch, FieldResponse& field) const {
  const std::size_t m = internal_size();
  double* field_solved = scratch + 4 * m;
  double* field_coupling = scratch + 8 * m;
  double* band = scratch + 12 * m;
  const std::size_t size = m * (half_width + 1);
  std::fill_n(scratch, 12 * m + size, 0.0);

  TipResponse response;
  field = {};
  for (std::size_t e = 0; e < elements_; ++e) {
    const Energy part = energy(gather(e, y, surroundings.turn));
    response.strain_energy += part.value;
    const auto at = places(e);
    if (e == 0) {
      field.by_turn = part.gradient[near_slope];
      field.turn_turn = part.hessian[near_slope][near_slope];
    }
    for (std::size_t i = 0; i < element_unknowns; ++i) {
      if (at[i] < 0) continue;
      const auto row = static_cast<std::size_t>(at[i]);
      scratch[4 * row] += part.gradient[i];
      if (e == 0) field_coupling[4 * row] = part.hessian[i][near_slope];
      for (std::size_t j = 0; j < element_unknowns; ++j)
        if (at[j] >= 0 && at[j] <= at[i])
          band[row * (half_width + 1) + half_width - row + static_cast<std::size_t>(at[j])] +=
              part.hessian[i][j];
    }
  }
  // -load . tip, in axes that turn with the base section
  const Eigen::Matrix3d by = tip_by_unknowns(surroundings.turn);
  response.flexibility.setZero();
  response.tip = tip(y, surroundings.turn);
  const Vec2 place{response.tip[0], response.tip[1]};
  const Vec2 force{load[0], load[1]};
  field.by_turn += cross(place, force) + load[2];
  field.turn_turn += dot(force, place);
  field.tip_by_turn << place.y, -place.x, -1.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t row = m - 4 + c;
    const Eigen::Vector3d column = by.col(static_cast<Eigen::Index>(c));
    scratch[4 * row] -= load.dot(column);
    field_coupling[4 * row] += cross(Vec2{column[0], column[1]}, force);
    for (std::size_t k = 0; k < 3; ++k)
      scratch[4 * row + k + 1] = -column[static_cast<Eigen::Index>(k)];
  }
  double coupling[4 * 3];  // only the tip's unknowns meet the load
  std::copy_n(scratch + 4 * (m - 4), 12, coupling);
  std::copy_n(field_coupling, 4 * m, field_solved);
  response.singular =
      !solve_symmetric(band, layout(), band + size, band + 2 * size, scratch, response.negative);
  int negative = 0;
  response.singular =
      response.singular ||
      !solve_symmetric(band, layout(), band + size, band + 2 * size, field_solved, negative);
  add_eliminated(3, coupling, scratch + 4 * (m - 4), response);
  for (std::size_t i = 0; i < m; ++i) {
    const double by_turn = field_coupling[4 * i];
    field.by_turn -= by_turn * scratch[4 * i];
    field.turn_turn -= by_turn * field_solved[4 * i];
  }
  for (std::size_t c = 0; c < 3; ++c)
    field.tip_by_turn -= by.col(static_cast<Eigen::Index>(c)) * field_solved[4 * (m - 4 + c)];
  return response;
}

/// About a base section that has not turned.
Eigen::MatrixXd PrintedBeamPort::hessian(const Eigen::Vector3d& /*load*/, const double* y) const {
  const auto m = static_cast<Eigen::Index>(internal_size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(m + 3, m + 3);
  for (std::size_t e = 0; e < elements_; ++e) {
    const Energy part = energy(gather(e, y, 0.0));
    const auto at = places(e);
    for (std::size_t i = 0; i < element_unknowns; ++i)
      for (std::size_t j = 0; j < element_unknowns; ++j)
        if (at[i] >= 0 && at[j] >= 0) h(at[i], at[j]) += part.hessian[i][j];
  }
  const Eigen::Matrix3d by = tip_by_unknowns(0.0);
  h.block<3, 3>(m, m - 4) = -by;
  h.block<3, 3>(m - 4, m) = -by.transpose();
  return h;
}

/// Their forces hold the sections in equilibrium with the tip, as they have moved: the element's
/// own stresses are in equilibrium only about the drawn axis.
std::vector<SectionState> PrintedBeamPort::sections_in(const Surroundings& surroundings,
                                                       const Eigen::Vector3d& load,
                                                       std::span<const double> internal) const {
  const StationGrid grid(flexure_.axis, flexure_.axis.breaks());
  const Eigen::Vector3d end = tip(internal.data(), surroundings.turn);
  std::vector<SectionState> states;
  for (std::size_t k = 0; k < grid.s.size(); ++k) {
    const double place = grid.s[k] / element_length_;
    const std::size_t e = std::min(elements_ - 1, static_cast<std::size_t>(place));
    const Nodal nodal = gather(e, internal.data(), surroundings.turn);
    const Shape at = shape(place - static_cast<double>(e));
    const Vec2 moved = grid.positions[k] + product(at.u, nodal) * direction_ +
                       product(at.w, nodal) * perp(direction_);
    const Pose pose{rotate(-surroundings.turn, moved), product(at.dw, nodal) - surroundings.turn};
    states.push_back(section_at(grid, k, pose, {end[0], end[1]}, load));
  }
  return states;
}

/// The slope at the base is not among the unknowns: the quartic through the others of the first
/// element stands in for it.
void PrintedBeamPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  const PrintedBeamPort fine(flexure_, 2 * static_cast<int>(elements_));
  refined[0] = internal[0];
  const double r = element_length_ / length_;
  for (std::size_t e = 0; e < elements_; ++e) {
    Nodal nodal = gather(e, internal.data(), 0.0);
    if (e == 0) {
      const double half_bend = 0.5 * r * r * nodal[3];  // of x^2
      const double value = nodal[5] - half_bend;
      const double slope = r * nodal[6] - 2.0 * half_bend;
      const double bend = r * r * nodal[7] - 2.0 * half_bend;
      const double a4 = bend / 3.0 - (slope - value);
      const double a3 = 0.5 * (slope - value - 3.0 * a4);
      nodal[near_slope] = (value - a3 - a4) / r;
    }
    const Shape at = shape(0.5);
    const double middle[4] = {product(at.u, nodal) / length_, product(at.w, nodal) / length_,
                              product(at.dw, nodal), product(at.ddw, nodal) * length_};
    const auto first = fine.places(2 * e);
    const auto second = fine.places(2 * e + 1);
    for (std::size_t i = 0; i < 4; ++i) {
      refined[static_cast<std::size_t>(first[4 + i])] = middle[i];
      refined[static_cast<std::size_t>(second[4 + i])] = nodal[4 + i];
    }
  }
}

}  // namespace

std::shared_ptr<const TwoPort> make_printed_beam_port(const FlexureProperties& flexure,
                                                      int elements) {
  return std::make_shared<PrintedBeamPort>(flexure, elements);
}

}  // namespace flexura

#include <array>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/core/quadrature.hpp"
#include "flexura/energy/beam_constraint.hpp"
#include "flexura/modelings/bcm.hpp"
#include "flexura/modelings/motion_ports.hpp"
#include "flexura/modelings/station_grid.hpp"

namespace flexura {
namespace {

constexpr int points_per_element = 6;

/// Elements of the beam constraint model in motion. Unknowns of each: its axial force p (in
/// EI/l^2), whose only part is to make H's axial displacement, then the displacement of its end
/// along and across the frame of its start (over its length) and the rotation of its end:
///     W = sum_k EI/l [ H(delta_k, theta_k, p_k) + p_k u_k ] - load . tip,
/// and a place at x of an element lies at l (x (1 + u), (3 delta - theta) x^2 + (theta - 2 delta)
/// x^3) of its frame.
class BcmMotionPort final : public MotionPort {
 public:
  BcmMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                BcmSettings settings);

  std::size_t internal_size() const override { return per * count_; }
  BandLayout layout() const override { return dense_layout(internal_size()); }
  const std::vector<MassPoint>& points() const override { return points_; }
  std::size_t scratch_size() const override {
    return (count_ + points_.size()) * sizeof(PlaceJet) / sizeof(double) + 3 * internal_size();
  }
  std::vector<double> weights() const override {
    std::vector<double> weights(internal_size(), 1.0 / static_cast<double>(count_));
    for (std::size_t k = 0; k < count_; ++k) weights[per * k] = axial_;
    return weights;
  }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;
  std::shared_ptr<const MotionPort> refined() const override {
    if (count_ == 1) return nullptr;
    return std::make_shared<BcmMotionPort>(flexure_, inertia_,
                                           BcmSettings{2 * static_cast<int>(count_)});
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return 8.0 / 7.0; }

 private:
  static constexpr std::size_t per = 4;
  enum Unknown { force, along, across, turn };
  /// Variables of a place in an element: the frame's angle, then along, across and turn.
  using Jet = Jet2<4>;
  struct PlaceJet {
    Jet x, y;
  };

  PlaceJet* jets(MemberWork& work) const {
    return reinterpret_cast<PlaceJet*>(work.scratch.data());
  }
  PlaceJet place_jet(double frame, const double* element, double x) const;
  PlaceJet direction_jet(double frame, const double* element, double x) const;
  /// Slopes of an element's place by all unknowns up to the element's, added.
  void add_slopes(std::size_t element, const PlaceJet& jet, Vec2* slope) const;
  void add_hessian(std::size_t element, const PlaceJet& jet, Vec2 weight, double* tangent) const;
  Vec2 curvature_of(std::size_t element, const PlaceJet& jet, const double* rate) const;
  /// Slopes of the point g by the unknowns it depends on, from those of its element's start.
  void fill_slopes(std::size_t g, std::size_t element, const PlaceJet& jet, const Vec2* start,
                   Vec2* slopes) const;

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  std::size_t count_;
  double length_;  // of an element
  double angle_;
  double axial_;                // compliance in the elements' units
  std::vector<double> places_;  // of the points in their element
  std::vector<MassPoint> points_;
};

BcmMotionPort::BcmMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                             BcmSettings settings)
    : flexure_(flexure),
      inertia_(inertia),
      count_(static_cast<std::size_t>(settings.elements)),
      length_(flexure.axis.length() / settings.elements),
      angle_(flexure.axis.tangent_angle(0.0)),
      axial_(flexure.axial_compliance * flexure.bending_stiffness / (length_ * length_)) {
  const QuadratureRule& rule = gauss_legendre(points_per_element);
  for (std::size_t k = 0; k < count_; ++k)
    for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
      const double x = 0.5 * (1.0 + rule.nodes[g]);
      const double s = length_ * (static_cast<double>(k) + x);
      const double weight = 0.5 * length_ * rule.weights[g];
      const std::size_t depends = per * (k + 1);
      points_.push_back(
          {s, weight * inertia_.at(s).mass, false, 0, depends, weight * flexure_.field.per_length});
      places_.push_back(x);
      if (!inertia_.rotary) continue;
      points_.push_back({s, weight * inertia_.at(s).rotary, true, 0, depends, {}});
      places_.push_back(x);
    }
}

auto BcmMotionPort::place_jet(double frame, const double* element, double x) const -> PlaceJet {
  const Jet angle = Jet::variable(0, frame);
  const Jet u = Jet::variable(1, element[along]);
  const Jet d = Jet::variable(2, element[across]);
  const Jet t = Jet::variable(3, element[turn]);
  const Jet forward = (length_ * x) * (1.0 + u);
  const Jet sideways = (length_ * x * x) * ((3.0 - 2.0 * x) * d + (x - 1.0) * t);
  const Jet c = cos(angle), s = sin(angle);
  return {forward * c - sideways * s, forward * s + sideways * c};
}

auto BcmMotionPort::direction_jet(double frame, const double* element, double x) const -> PlaceJet {
  const Jet slope = (6.0 * x * (1.0 - x)) * Jet::variable(2, element[across]) +
                    (x * (3.0 * x - 2.0)) * Jet::variable(3, element[turn]);
  const Jet angle = Jet::variable(0, frame) + slope;
  return {cos(angle), sin(angle)};
}

/// The frame turns by all rotations before it.
void BcmMotionPort::add_slopes(std::size_t element, const PlaceJet& jet, Vec2* slope) const {
  const auto by = [&](std::size_t i) { return Vec2{jet.x.gradient[i], jet.y.gradient[i]}; };
  for (std::size_t k = 0; k < element; ++k) slope[per * k + turn] = slope[per * k + turn] + by(0);
  for (std::size_t i = 1; i < per; ++i) slope[per * element + i] = slope[per * element + i] + by(i);
}

void BcmMotionPort::add_hessian(std::size_t element, const PlaceJet& jet, Vec2 weight,
                                double* tangent) const {
  const std::size_t m = internal_size();
  const auto variable = [&](std::size_t i) -> int {
    if (i / per == element) return i % per == force ? -1 : static_cast<int>(i % per);
    return i / per < element && i % per == turn ? 0 : -1;
  };
  for (std::size_t i = 0; i < per * (element + 1); ++i) {
    const int a = variable(i);
    if (a < 0) continue;
    for (std::size_t j = 0; j <= i; ++j) {
      const int b = variable(j);
      if (b < 0) continue;
      const auto p = static_cast<std::size_t>(a), q = static_cast<std::size_t>(b);
      tangent[i * m + j] += weight.x * jet.x.second(p, q) + weight.y * jet.y.second(p, q);
    }
  }
}

Vec2 BcmMotionPort::curvature_of(std::size_t element, const PlaceJet& jet,
                                 const double* rate) const {
  double r[per] = {0.0, rate[per * element + along], rate[per * element + across],
                   rate[per * element + turn]};
  for (std::size_t k = 0; k < element; ++k) r[0] += rate[per * k + turn];
  Vec2 sum;
  for (std::size_t i = 0; i < per; ++i)
    for (std::size_t j = 0; j < per; ++j)
      sum = sum + r[i] * r[j] * Vec2{jet.x.second(i, j), jet.y.second(i, j)};
  return sum;
}

MotionPort::Answer BcmMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                           const double* v, const double* a,
                                           MemberWork& work) const {
  using Energy = Jet2<3>;  // across, turn, force
  const std::size_t m = internal_size();
  const double unit_energy = flexure_.bending_stiffness / length_;
  std::fill(work.columns.begin(), work.columns.end(), 0.0);
  PlaceJet* ends = jets(work);
  PlaceJet* inner = ends + count_;
  Vec2* sums = reinterpret_cast<Vec2*>(inner + points_.size());  // slopes of the element's start
  std::fill_n(sums, m, Vec2{});
  Answer answer{0.0, Eigen::Vector3d::Zero()};
  Vec2 start, start_curvature;
  Vec2* slope = work.slopes.data();
  std::size_t g = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const double* element = y + per * k;
    const double frame = angle_ + answer.tip[2];
    const Energy h = beam_constraint_potential(Energy::variable(0, element[across]),
                                               Energy::variable(1, element[turn]),
                                               Energy::variable(2, element[force]), axial_);
    const double stretch = element[along] - flexure_.field.strain;
    answer.energy += unit_energy * (h.value + element[force] * stretch);
    double* columns = work.columns.data() + 4 * per * k;
    columns[4 * force] += unit_energy * (h.gradient[2] + stretch);
    columns[4 * along] += unit_energy * element[force];
    columns[4 * across] += unit_energy * h.gradient[0];
    columns[4 * turn] += unit_energy * h.gradient[1] - load[2];
    columns[4 * turn + 3] = -1.0;
    for (; g < points_.size() && points_[g].count == per * (k + 1); ++g) {
      inner[g] = points_[g].direction ? direction_jet(frame, element, places_[g])
                                      : place_jet(frame, element, places_[g]);
      work.places[g] = Vec2{inner[g].x.value, inner[g].y.value};
      work.seconds[g] = curvature_of(k, inner[g], v);
      if (!points_[g].direction) {
        work.places[g] = work.places[g] + start;
        work.seconds[g] = work.seconds[g] + start_curvature;
      }
      fill_slopes(g, k, inner[g], sums, slope);
      work.rates[g] = {};
      for (std::size_t j = 0; j < points_[g].count; ++j) {
        work.rates[g] = work.rates[g] + v[j] * slope[j];
        work.seconds[g] = work.seconds[g] + a[j] * slope[j];
      }
      slope += points_[g].count;
    }
    ends[k] = place_jet(frame, element, 1.0);
    start = start + Vec2{ends[k].x.value, ends[k].y.value};
    start_curvature = start_curvature + curvature_of(k, ends[k], v);
    add_slopes(k, ends[k], sums);
    answer.tip[2] += element[turn];
  }
  answer.tip.head<2>() = Eigen::Vector2d(start.x, start.y);
  for (std::size_t i = 0; i < m; ++i) {
    work.columns[4 * i] -= load[0] * sums[i].x + load[1] * sums[i].y;
    work.columns[4 * i + 1] = -sums[i].x;
    work.columns[4 * i + 2] = -sums[i].y;
  }
  return answer;
}

void BcmMotionPort::fill_slopes(std::size_t g, std::size_t element, const PlaceJet& jet,
                                const Vec2* start, Vec2* slopes) const {
  if (points_[g].direction)
    std::fill_n(slopes, points_[g].count, Vec2{});
  else
    std::copy_n(start, points_[g].count, slopes);
  add_slopes(element, jet, slopes);
}

void BcmMotionPort::add_forces(const Vec2* forces, MemberWork& work, double* residual) const {
  const Vec2* slope = work.slopes.data();
  for (std::size_t g = 0; g < points_.size(); ++g)
    for (std::size_t j = 0; j < points_[g].count; ++j, ++slope)
      residual[j] += dot(forces[g], *slope);
}

void BcmMotionPort::linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                              MemberWork& work) const {
  using Energy = Jet2<3>;
  const std::size_t m = internal_size();
  const double unit_energy = flexure_.bending_stiffness / length_;
  const PlaceJet* ends = jets(work);
  const PlaceJet* inner = ends + count_;
  double* tangent = work.tangent.data();
  std::fill(work.tangent.begin(), work.tangent.end(), 0.0);
  Vec2 ahead{-load[0], -load[1]};  // on the end of an element: the tip and all places behind it
  std::size_t g = points_.size();
  for (std::size_t k = count_; k-- > 0;) {
    const double* element = y + per * k;
    const Energy h = beam_constraint_potential(Energy::variable(0, element[across]),
                                               Energy::variable(1, element[turn]),
                                               Energy::variable(2, element[force]), axial_);
    constexpr std::size_t own[3] = {across, turn, force};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        if (own[b] <= own[a])
          tangent[(per * k + own[a]) * m + per * k + own[b]] += unit_energy * h.second(a, b);
    tangent[(per * k + along) * m + per * k + force] += unit_energy;
    add_hessian(k, ends[k], ahead, tangent);
    for (; weights && g > 0 && points_[g - 1].count == per * (k + 1); --g) {
      add_hessian(k, inner[g - 1], weights[g - 1], tangent);
      if (!points_[g - 1].direction) ahead = ahead + weights[g - 1];
    }
  }
}

/// The moment of the cubic, corrected for nothing: H's own moments at both ends, joined by a
/// straight line.
std::vector<SectionState> BcmMotionPort::sections(const Eigen::Vector3d& /*load*/,
                                                  const double* y) const {
  using Energy = Jet2<3>;
  const StationGrid grid(flexure_.axis, flexure_.axis.breaks());
  const double ei = flexure_.bending_stiffness;
  std::vector<SectionState> states;
  std::size_t element = 0;
  Pose start;
  for (const double s : grid.s) {
    while (element + 1 < count_ && s > length_ * static_cast<double>(element + 1)) {
      const PlaceJet end = place_jet(angle_ + start.rotation, y + per * element, 1.0);
      start.position = start.position + Vec2{end.x.value, end.y.value};
      start.rotation += y[per * element + turn];
      ++element;
    }
    const double* own = y + per * element;
    const double x = s / length_ - static_cast<double>(element);
    const Energy h =
        beam_constraint_potential(Energy::variable(0, own[across]), Energy::variable(1, own[turn]),
                                  Energy::variable(2, own[force]), axial_);
    const double shear = h.gradient[0] * ei / (length_ * length_);
    const double moment = h.gradient[1] * ei / length_;  // at the element's end
    const double axial = own[force] * ei / (length_ * length_);
    const PlaceJet place = place_jet(angle_ + start.rotation, own, x);
    const double slope = 6.0 * x * (1.0 - x) * own[across] + x * (3.0 * x - 2.0) * own[turn];
    const double sideways =
        length_ * (own[across] - x * x * ((3.0 - 2.0 * x) * own[across] + (x - 1.0) * own[turn]));
    states.push_back({{start.position + Vec2{place.x.value, place.y.value}, start.rotation + slope},
                      axial,
                      shear,
                      moment + shear * length_ * (1.0 - x) - axial * sideways});
  }
  return states;
}

/// The static unknowns, with the axial displacement and force that go with them.
std::vector<double> BcmMotionPort::adopt(std::span<const SectionState> sections,
                                         std::span<const double> internal) const {
  using Energy = Jet2<3>;
  std::vector<double> y;
  for (std::size_t k = 0; k < count_; ++k) {
    const double middle = (static_cast<double>(k) + 0.5) / static_cast<double>(count_) *
                          static_cast<double>(sections.size() - 1);
    const double p = sections[static_cast<std::size_t>(std::lround(middle))].axial_force * length_ *
                     length_ / flexure_.bending_stiffness;
    const Energy h = beam_constraint_potential(Energy::variable(0, internal[2 * k]),
                                               Energy::variable(1, internal[2 * k + 1]),
                                               Energy::variable(2, p), axial_);
    y.insert(y.end(),
             {p, flexure_.field.strain - h.gradient[2], internal[2 * k], internal[2 * k + 1]});
  }
  return y;
}

/// Cuts every element in the middle of its cubic.
void BcmMotionPort::prolong(std::span<const double> internal, std::span<double> refined) const {
  for (std::size_t k = 0; k < count_; ++k) {
    const double* own = internal.data() + per * k;
    double* half = refined.data() + 2 * per * k;
    const double d = own[across], t = own[turn];
    const double middle = 0.5 * d - 0.125 * t;
    const double slope = 1.5 * d - 0.25 * t;
    const double values[8] = {0.25 * own[force],
                              own[along],
                              2.0 * middle,
                              slope,
                              0.25 * own[force],
                              own[along],
                              2.0 * (d - middle) * std::cos(slope) - std::sin(slope),
                              t - slope};
    std::copy_n(values, 2 * per, half);
  }
}

}  // namespace

std::shared_ptr<const MotionPort> make_bcm_motion_port(const FlexureProperties& flexure,
                                                       const FlexureInertia& inertia,
                                                       const BcmSettings& settings) {
  return std::make_shared<BcmMotionPort>(flexure, inertia, settings);
}

}  // namespace flexura

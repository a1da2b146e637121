#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/beam_hermite.hpp"
#include "flexura/modelings/quintic_shape.hpp"

namespace flexura {
namespace {

constexpr int mass_points = 6;  // per element: degree 10 of the deflection squared

/// Von Karman's and the linear elements in motion: places and directions are functions of the
/// element's nine unknowns.
class HermiteMotionPort final : public MotionPort {
 public:
  HermiteMotionPort(const FlexureProperties& flexure, const FlexureInertia& inertia,
                    BeamSettings settings);

  std::size_t internal_size() const override { return still_.internal_size(); }
  BandLayout layout() const override { return band_layout(internal_size(), still_.width()); }
  const std::vector<MassPoint>& points() const override { return points_; }
  std::size_t scratch_size() const override {
    return internal_size() * (still_.width() + 1) +
           points_.size() * 2 * sizeof(Unknowns) / sizeof(double);
  }
  std::vector<double> weights() const override { return still_.weights(); }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& /*load*/,
                                     const double* y) const override {
    return still_.strained_sections({y, internal_size()});
  }
  std::vector<double> adopt(std::span<const SectionState> /*sections*/,
                            std::span<const double> internal) const override {
    return {internal.begin(), internal.end()};
  }
  std::shared_ptr<const MotionPort> refined() const override {
    BeamSettings finer = settings_;
    finer.elements *= 2;
    return std::make_shared<HermiteMotionPort>(flexure_, inertia_, finer);
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override {
    still_.prolong(internal, refined);
  }
  double error_ratio() const override { return still_.error_ratio(); }

 private:
  using Unknowns = HermiteBeamPort::Unknowns;
  struct Place {
    std::size_t element = 0;
    double x = 0.0;  // in [0, 1]
  };
  /// The two components of point g, in the scratch.
  Unknowns* jets(MemberWork& work, std::size_t g) const {
    return reinterpret_cast<Unknowns*>(work.scratch.data() +
                                       internal_size() * (still_.width() + 1)) +
           2 * g;
  }
  void add_points(std::size_t element, double x, double weight);
  /// By the linear theory all matrices are those of the drawn state.
  struct Drawn {
    double energy = 0.0;
    std::vector<double> gradient;
    std::vector<double> band;
    std::vector<Vec2> places;
    std::vector<Vec2> slopes;
  };
  void keep_drawn();
  Answer evaluate_linear(const Eigen::Vector3d& load, const double* y, const double* v,
                         const double* a, MemberWork& work) const;
  Answer evaluate_jets(const Eigen::Vector3d& load, const double* y, const double* v,
                       const double* a, MemberWork& work) const;
  void copy_slopes(MemberWork& work) const;
  void move_point(std::size_t g, const double* v, const double* a, MemberWork& work) const;

  FlexureProperties flexure_;
  FlexureInertia inertia_;
  BeamSettings settings_;
  HermiteBeamPort still_;
  std::vector<Place> places_;
  std::vector<MassPoint> points_;
  Drawn drawn_;
};

HermiteMotionPort::HermiteMotionPort(const FlexureProperties& flexure,
                                     const FlexureInertia& inertia, BeamSettings settings)
    : flexure_(flexure), inertia_(inertia), settings_(settings), still_(flexure, settings) {
  const auto elements = static_cast<std::size_t>(settings.elements);
  const QuadratureRule& rule = inertia_.lumped ? gauss_lobatto(2) : gauss_legendre(mass_points);
  for (std::size_t e = 0; e < elements; ++e)
    for (std::size_t g = 0; g < rule.nodes.size(); ++g)
      add_points(e, 0.5 * (1.0 + rule.nodes[g]), 0.5 * rule.weights[g]);
  if (still_.is_linear()) keep_drawn();
}

void HermiteMotionPort::keep_drawn() {
  MemberWork work = sized_work(*this);
  const std::vector<double> rest(internal_size(), 0.0);
  drawn_.energy =
      evaluate_jets(Eigen::Vector3d::Zero(), rest.data(), rest.data(), rest.data(), work).energy;
  for (std::size_t i = 0; i < internal_size(); ++i) drawn_.gradient.push_back(work.columns[4 * i]);
  copy_slopes(work);
  drawn_.band.assign(work.scratch.begin(),
                     work.scratch.begin() + static_cast<std::ptrdiff_t>(work.tangent.size()));
  drawn_.places = work.places;
  drawn_.slopes = work.slopes;
}

MotionPort::Answer HermiteMotionPort::evaluate_linear(const Eigen::Vector3d& load, const double* y,
                                                      const double* v, const double* a,
                                                      MemberWork& work) const {
  Answer answer{drawn_.energy};
  std::fill(work.columns.begin(), work.columns.end(), 0.0);
  double* product = work.scratch.data();
  multiply_symmetric(drawn_.band.data(), layout(), y, product);
  for (std::size_t i = 0; i < internal_size(); ++i) {
    answer.energy += (0.5 * product[i] + drawn_.gradient[i]) * y[i];
    work.columns[4 * i] = product[i] + drawn_.gradient[i];
  }
  answer.tip = still_.add_tip_load(load, y, work.columns.data());
  const Vec2* slope = drawn_.slopes.data();
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Vec2 place = drawn_.places[g], rate, second;
    for (std::size_t j = points_[g].first; j < points_[g].first + points_[g].count; ++j, ++slope) {
      place = place + y[j] * *slope;
      rate = rate + v[j] * *slope;
      second = second + a[j] * *slope;
    }
    work.places[g] = place;
    work.rates[g] = rate;
    work.seconds[g] = second;
  }
  return answer;
}

void HermiteMotionPort::add_points(std::size_t element, double x, double weight) {
  const double arc = flexure_.axis.length() / settings_.elements;
  const double s = std::min(flexure_.axis.length(), arc * (static_cast<double>(element) + x));
  const auto at = still_.places(element);
  std::size_t first = internal_size(), last = 0;
  for (const int place : at)
    if (place >= 0) {
      first = std::min(first, static_cast<std::size_t>(place));
      last = std::max(last, static_cast<std::size_t>(place));
    }
  const SectionInertia section = inertia_.at(s);
  const auto add = [&](double inertia, bool direction, Vec2 force) {
    places_.push_back({element, x});
    points_.push_back({s, weight * arc * inertia, direction, first, last - first + 1, force});
  };
  add(section.mass, false, weight * arc * flexure_.field.per_length);
  if (inertia_.rotary) add(section.rotary, true, {});
}

MotionPort::Answer HermiteMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                               const double* v, const double* a,
                                               MemberWork& work) const {
  return still_.is_linear() ? evaluate_linear(load, y, v, a, work)
                            : evaluate_jets(load, y, v, a, work);
}

MotionPort::Answer HermiteMotionPort::evaluate_jets(const Eigen::Vector3d& load, const double* y,
                                                    const double* v, const double* a,
                                                    MemberWork& work) const {
  Answer answer;
  answer.energy =
      still_.assemble(y, work.columns.data(), work.scratch.data(), flexure_.field.strain);
  answer.tip = still_.add_tip_load(load, y, work.columns.data());
  std::size_t g = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(settings_.elements); ++e) {
    const HermiteBeamPort::ElementJets element = still_.element_jets(e, y);
    for (; g < points_.size() && places_[g].element == e; ++g) {
      Unknowns* jet = jets(work, g);
      const auto both = points_[g].direction
                            ? still_.direction_at(element, places_[g].x, !inertia_.shear_rotary)
                            : still_.place_at(element, places_[g].x);
      jet[0] = both[0];
      jet[1] = both[1];
      move_point(g, v, a, work);
    }
  }
  return answer;
}

/// Rates of a place by the chain rule.
void HermiteMotionPort::move_point(std::size_t g, const double* v, const double* a,
                                   MemberWork& work) const {
  const Unknowns* jet = jets(work, g);
  const auto at = still_.places(places_[g].element);
  Vec2 rate, second;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] < 0) continue;
    const Vec2 slope{jet[0].gradient[i], jet[1].gradient[i]};
    rate = rate + v[at[i]] * slope;
    second = second + a[at[i]] * slope;
    if (still_.is_linear()) continue;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (at[j] >= 0)
        second = second + v[at[i]] * v[at[j]] * Vec2{jet[0].second(i, j), jet[1].second(i, j)};
  }
  work.places[g] = {jet[0].value, jet[1].value};
  work.rates[g] = rate;
  work.seconds[g] = second;
}

void HermiteMotionPort::add_forces(const Vec2* forces, MemberWork& work, double* residual) const {
  if (still_.is_linear()) {
    const Vec2* slope = drawn_.slopes.data();
    for (std::size_t g = 0; g < points_.size(); ++g)
      for (std::size_t j = 0; j < points_[g].count; ++j, ++slope)
        residual[points_[g].first + j] += dot(forces[g], *slope);
    return;
  }
  for (std::size_t g = 0; g < points_.size(); ++g) {
    const Unknowns* jet = jets(work, g);
    const auto at = still_.places(places_[g].element);
    for (std::size_t i = 0; i < at.size(); ++i)
      if (at[i] >= 0)
        residual[at[i]] += forces[g].x * jet[0].gradient[i] + forces[g].y * jet[1].gradient[i];
  }
}

void HermiteMotionPort::copy_slopes(MemberWork& work) const {
  Vec2* slope = work.slopes.data();
  for (std::size_t g = 0; g < points_.size(); slope += points_[g].count, ++g) {
    const Unknowns* jet = jets(work, g);
    const auto at = still_.places(places_[g].element);
    std::fill_n(slope, points_[g].count, Vec2{});
    for (std::size_t i = 0; i < at.size(); ++i)
      if (at[i] >= 0)
        slope[static_cast<std::size_t>(at[i]) - points_[g].first] = {jet[0].gradient[i],
                                                                     jet[1].gradient[i]};
  }
}

void HermiteMotionPort::linearize(const Eigen::Vector3d& /*load*/, const double* /*y*/,
                                  const Vec2* weights, MemberWork& work) const {
  if (still_.is_linear()) {
    work.tangent = drawn_.band;
    work.slopes = drawn_.slopes;
    return;
  }
  const BandLayout rows = layout();
  const auto size = static_cast<std::ptrdiff_t>(work.tangent.size());
  std::copy(work.scratch.begin(), work.scratch.begin() + size, work.tangent.begin());
  copy_slopes(work);
  for (std::size_t g = 0; weights && g < points_.size(); ++g) {
    const Unknowns* jet = jets(work, g);
    const auto at = still_.places(places_[g].element);
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = 0; j < at.size(); ++j)
        if (at[i] >= 0 && at[j] >= 0 && at[j] <= at[i])
          rows.row(work.tangent.data(), static_cast<std::size_t>(at[i]))[at[j]] +=
              weights[g].x * jet[0].second(i, j) + weights[g].y * jet[1].second(i, j);
  }
}

}  // namespace

std::shared_ptr<const MotionPort> make_hermite_motion_port(const FlexureProperties& flexure,
                                                           const FlexureInertia& inertia,
                                                           const BeamSettings& settings) {
  return std::make_shared<HermiteMotionPort>(flexure, inertia, settings);
}

}  // namespace flexura

#include "flexura/modelings/angle_chain.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/energy/reissner.hpp"

namespace flexura {

AngleChainMotion::AngleChainMotion(AngleChain chain) : chain_(std::move(chain)) {}

std::size_t AngleChainMotion::scratch_size() const {
  const std::size_t arms = chain_.arms.size();
  const std::size_t m = chain_.unknowns;
  return (arms * (sizeof(ArmState) + sizeof(ArmSlopes) + sizeof(ArmMotion)) +
          sizeof(Vec2) * (arms + m + arms * m) + sizeof(double) * m) /
         sizeof(double);
}

auto AngleChainMotion::scratch(MemberWork& work) const -> Scratch {
  const std::size_t arms = chain_.arms.size();
  const std::size_t m = chain_.unknowns;
  Scratch s{};
  s.states = reinterpret_cast<ArmState*>(work.scratch.data());
  s.slopes = reinterpret_cast<ArmSlopes*>(s.states + arms);
  s.motions = reinterpret_cast<ArmMotion*>(s.slopes + arms);
  s.weights = reinterpret_cast<Vec2*>(s.motions + arms);
  s.sums = s.weights + arms;
  s.arm_slopes = s.sums + m;
  s.buffer = reinterpret_cast<double*>(s.arm_slopes + arms * m);
  return s;
}

/// The parts that the unknowns (or their rates) contribute.
auto AngleChainMotion::state_of(std::size_t arm, const double* y) const -> ArmState {
  return {chain_.turns.product(arm, y), chain_.axial.product(arm, y), chain_.shear.product(arm, y)};
}

/// The arm's vector and its rates: jets in time.
auto AngleChainMotion::motion_of(const ArmState& state, const ArmState& rate,
                                 const ArmState& second) const -> ArmMotion {
  using Jet = Jet2<1>;
  const auto in_time = [](double value, double first, double twice) {
    Jet jet(value);
    jet.gradient[0] = first;
    jet.hessian[0] = twice;
    return jet;
  };
  const auto slope = reissner_axis_slope(in_time(state.angle, rate.angle, second.angle),
                                         in_time(state.stretch, rate.stretch, second.stretch),
                                         in_time(state.shear, rate.shear, second.shear));
  return {{slope.x.value, slope.y.value},
          {slope.x.gradient[0], slope.y.gradient[0]},
          {slope.x.hessian[0], slope.y.hessian[0]}};
}

MotionPort::Answer AngleChainMotion::evaluate(const Eigen::Vector3d& load, const double* y,
                                              const double* v, const double* a,
                                              MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  const Scratch s = scratch(work);
  Vec2 tip = chain_.tip_offset;
  std::fill_n(s.sums, m, Vec2{});
  for (std::size_t h = 0; h < chain_.arms.size(); ++h) {
    const AngleChain::Arm& arm = chain_.arms[h];
    ArmState& state = s.states[h];
    state = state_of(h, y);
    state.angle += arm.angle;
    state.stretch += arm.stretch;
    s.motions[h] = motion_of(state, state_of(h, v), state_of(h, a));
    // with the vector's direction at hand, its derivatives are its own parts turned
    const auto by = reissner_slopes(state.angle, state.stretch, state.shear);
    s.slopes[h] = {s.motions[h].place, {by[0], by[1], by[2]}};
    if (arm.weight == 0.0) continue;
    tip = tip + arm.weight * s.motions[h].place;
    const AngleChain::Rows* rows[3] = {&chain_.turns, &chain_.axial, &chain_.shear};
    for (std::size_t k = 0; k < 3; ++k) {
      const double* row = rows[k]->row(h);
      const Vec2 part = arm.weight * by[k];
      Vec2* sum = s.sums + rows[k]->first;
      for (std::size_t i = 0; i < rows[k]->count; ++i) sum[i] = sum[i] + row[i] * part;
    }
  }
  place_points(s, work);
  turn_directions(s, v, a, work);

  MotionPort::Answer answer{0.0, {tip.x, tip.y, 0.0}};
  const Vec2 force{load[0], load[1]};
  for (std::size_t i = 0; i < m; ++i) {
    double stiff = 0.0;
    for (std::size_t k = 0; k < m; ++k) stiff += chain_.stiffness[i * m + k] * y[k];
    answer.energy += 0.5 * stiff * y[i];
    answer.tip[2] += chain_.tip_turn[i] * y[i];
    double* column = work.columns.data() + 4 * i;
    column[0] = stiff - dot(force, s.sums[i]) - load[2] * chain_.tip_turn[i];
    column[1] = -s.sums[i].x;
    column[2] = -s.sums[i].y;
    column[3] = -chain_.tip_turn[i];
  }
  return answer;
}

/// Mass points from the arms' vectors, likewise their rates.
void AngleChainMotion::place_points(const Scratch& s, MemberWork& work) const {
  ArmMotion sum;
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < chain_.intervals.size(); ++k) {
    for (; next < chain_.places.size() && chain_.places[next].interval == k; ++next) {
      const AngleChain::Place& place = chain_.places[next];
      ArmMotion at{sum.place + place.offset, sum.rate, sum.second};
      const ArmMotion* own = s.motions + place.first_arm;
      for (std::size_t p = 0; p < place.parts.size(); ++p) {
        at.place = at.place + place.parts[p] * own[p].place;
        at.rate = at.rate + place.parts[p] * own[p].rate;
        at.second = at.second + place.parts[p] * own[p].second;
      }
      work.places[next] = at.place;
      work.rates[next] = at.rate;
      work.seconds[next] = at.second;
    }
    for (std::size_t arm = chain_.intervals[k]; arm < chain_.intervals[k + 1]; ++arm) {
      const double weight = chain_.arms[arm].weight;
      sum.place = sum.place + weight * s.motions[arm].place;
      sum.rate = sum.rate + weight * s.motions[arm].rate;
      sum.second = sum.second + weight * s.motions[arm].second;
    }
  }
}

void AngleChainMotion::turn_directions(const Scratch& s, const double* v, const double* a,
                                       MemberWork& work) const {
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    const AngleChain::Direction& direction = chain_.directions[d];
    const std::size_t arm = direction.arm;
    double angle = s.states[arm].angle;
    double spin = chain_.turns.product(arm, v);
    double spin_rate = chain_.turns.product(arm, a);
    if (is_sheared(direction)) {
      angle += s.states[arm].shear;
      spin += chain_.shear.product(arm, v);
      spin_rate += chain_.shear.product(arm, a);
    }
    const Vec2 here = unit(angle);
    work.places[places + d] = here;
    work.rates[places + d] = spin * perp(here);
    work.seconds[places + d] = spin_rate * perp(here) - spin * spin * here;
  }
}

/// What hangs on an arm: the tip, places inside its interval, and all places of later ones.
void AngleChainMotion::gather_weights(const Vec2* weights, Vec2 on_tip, Vec2* on_arms) const {
  Vec2 ahead = on_tip;
  std::size_t next = chain_.places.size();
  std::fill(on_arms + chain_.intervals.back(), on_arms + chain_.arms.size(), Vec2{});
  for (std::size_t k = chain_.intervals.size() - 1; k-- > 0;) {
    for (std::size_t arm = chain_.intervals[k]; arm < chain_.intervals[k + 1]; ++arm)
      on_arms[arm] = chain_.arms[arm].weight * ahead;
    for (; weights && next > 0 && chain_.places[next - 1].interval == k; --next) {
      const AngleChain::Place& place = chain_.places[next - 1];
      const Vec2 weight = weights[next - 1];
      ahead = ahead + weight;
      Vec2* own = on_arms + place.first_arm;
      for (std::size_t p = 0; p < place.parts.size(); ++p)
        own[p] = own[p] + place.parts[p] * weight;
    }
  }
}

void AngleChainMotion::add_forces(const Vec2* forces, MemberWork& work, double* residual) const {
  const Scratch s = scratch(work);
  gather_weights(forces, {}, s.weights);
  const AngleChain::Rows* rows[3] = {&chain_.turns, &chain_.axial, &chain_.shear};
  for (std::size_t h = 0; h < chain_.arms.size(); ++h)
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = dot(s.weights[h], s.slopes[h].by[k]);
      const double* row = rows[k]->row(h);
      double* out = residual + rows[k]->first;
      for (std::size_t i = 0; i < rows[k]->count; ++i) out[i] += part * row[i];
    }
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    const AngleChain::Direction& direction = chain_.directions[d];
    const double torque = cross(work.places[places + d], forces[places + d]);
    for (std::size_t k = 0; k < 3; k += 2) {
      if (k == 2 && !is_sheared(direction)) continue;
      const double* row = rows[k]->row(direction.arm);
      double* out = residual + rows[k]->first;
      for (std::size_t i = 0; i < rows[k]->count; ++i) out[i] += torque * row[i];
    }
  }
}

/// Slopes of all mass points by all unknowns.
void AngleChainMotion::fill_slopes(const Scratch& s, MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  const AngleChain::Rows* rows[3] = {&chain_.turns, &chain_.axial, &chain_.shear};
  for (std::size_t h = 0; h < chain_.arms.size(); ++h)
    for (std::size_t k = 0; k < 3; ++k) {
      const double* row = rows[k]->row(h);
      Vec2* out = s.arm_slopes + h * m + rows[k]->first;
      for (std::size_t i = 0; i < rows[k]->count; ++i) out[i] = row[i] * s.slopes[h].by[k];
    }
  std::fill_n(s.sums, m, Vec2{});
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < chain_.intervals.size(); ++k) {
    for (; next < chain_.places.size() && chain_.places[next].interval == k; ++next) {
      const AngleChain::Place& place = chain_.places[next];
      Vec2* out = work.slopes.data() + next * m;
      std::copy_n(s.sums, m, out);
      for (std::size_t p = 0; p < place.parts.size(); ++p) {
        const Vec2* own = s.arm_slopes + (place.first_arm + p) * m;
        for (std::size_t j = 0; j < m; ++j) out[j] = out[j] + place.parts[p] * own[j];
      }
    }
    for (std::size_t h = chain_.intervals[k]; h < chain_.intervals[k + 1]; ++h) {
      const Vec2* own = s.arm_slopes + h * m;
      for (std::size_t j = 0; j < m; ++j) s.sums[j] = s.sums[j] + chain_.arms[h].weight * own[j];
    }
  }
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    const AngleChain::Direction& direction = chain_.directions[d];
    Vec2* out = work.slopes.data() + (places + d) * m;
    std::fill_n(out, m, Vec2{});
    const Vec2 across = perp(work.places[places + d]);
    for (std::size_t k = 0; k < 3; k += 2) {
      if (k == 2 && !is_sheared(direction)) continue;
      const double* row = rows[k]->row(direction.arm);
      for (std::size_t i = 0; i < rows[k]->count; ++i) out[rows[k]->first + i] = row[i] * across;
    }
  }
}

/// weight . (second derivatives of an arm's vector), by the chain rule.
void AngleChainMotion::add_arm_hessian(std::size_t arm, const ArmState& state, Vec2 weight,
                                       double* buffer, double* tangent) const {
  using Jet = Jet2<3>;
  const std::size_t m = chain_.unknowns;
  const auto slope =
      reissner_axis_slope(Jet::variable(0, state.angle), Jet::variable(1, state.stretch),
                          Jet::variable(2, state.shear));
  const Jet product = weight.x * slope.x + weight.y * slope.y;
  const AngleChain::Rows* rows[3] = {&chain_.turns, &chain_.axial, &chain_.shear};
  for (std::size_t a = 0; a < 3; ++a) {
    if (rows[a]->count == 0) continue;
    std::fill_n(buffer, m, 0.0);
    for (std::size_t b = 0; b < 3; ++b) {
      const double factor = product.second(a, b);
      if (factor == 0.0) continue;
      const double* row = rows[b]->row(arm);
      double* out = buffer + rows[b]->first;
      for (std::size_t j = 0; j < rows[b]->count; ++j) out[j] += factor * row[j];
    }
    const double* own = rows[a]->row(arm);
    for (std::size_t i = 0; i < rows[a]->count; ++i) {
      if (own[i] == 0.0) continue;
      const std::size_t r = rows[a]->first + i;
      double* row = tangent + r * m;
      for (std::size_t j = 0; j <= r; ++j) row[j] += own[i] * buffer[j];
    }
  }
}

void AngleChainMotion::linearize(const Eigen::Vector3d& load, const Vec2* weights,
                                 MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  const Scratch s = scratch(work);
  fill_slopes(s, work);
  std::copy(chain_.stiffness.begin(), chain_.stiffness.end(), work.tangent.begin());
  gather_weights(weights, {-load[0], -load[1]}, s.weights);
  for (std::size_t arm = 0; arm < chain_.arms.size(); ++arm)
    add_arm_hessian(arm, s.states[arm], s.weights[arm], s.buffer, work.tangent.data());
  if (!weights) return;
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    // the second derivative of a unit vector by its angle is minus the vector
    const double factor = -dot(weights[places + d], work.places[places + d]);
    const AngleChain::Direction& direction = chain_.directions[d];
    std::fill_n(s.buffer, m, 0.0);
    std::copy_n(chain_.turns.row(direction.arm), chain_.turns.count, s.buffer + chain_.turns.first);
    if (is_sheared(direction))
      std::copy_n(chain_.shear.row(direction.arm), chain_.shear.count,
                  s.buffer + chain_.shear.first);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        work.tangent[i * m + j] += factor * s.buffer[i] * s.buffer[j];
  }
}

/// Quadratic: nothing to evaluate, which damping by the rate of elastic forces asks for every time.
void AngleChainMotion::linearize_energy(MemberWork& work) const {
  std::copy(chain_.stiffness.begin(), chain_.stiffness.end(), work.tangent.begin());
}

}  // namespace flexura

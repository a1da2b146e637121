#include "flexura/modelings/angle_chain.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/jet2.hpp"
#include "flexura/energy/reissner.hpp"

namespace flexura {

// Scratch: the arms' jets, then the slopes of every arm's vector by the unknowns, then the sum of
// all arms before an interval and its slopes, then the weights of the arms.
std::size_t AngleChainMotion::scratch_size() const {
  const std::size_t arms = chain_.arms.size();
  const std::size_t m = chain_.unknowns;
  return (arms * sizeof(ArmJet) + 2 * sizeof(double) * (arms * m + m + 1 + arms + 2 * m)) /
         sizeof(double);
}

double AngleChainMotion::row_product(const std::vector<double>& rows, std::size_t arm,
                                     const double* y) const {
  if (rows.empty()) return 0.0;
  const double* row = rows.data() + arm * chain_.unknowns;
  double sum = 0.0;
  for (std::size_t i = 0; i < chain_.unknowns; ++i) sum += row[i] * y[i];
  return sum;
}

auto AngleChainMotion::arm_jet(std::size_t arm, const double* y) const -> ArmJet {
  using Jet = Jet2<3>;
  const AngleChain::Arm& a = chain_.arms[arm];
  const auto slope = reissner_axis_slope(Jet::variable(0, a.angle + turn(arm, y)),
                                         Jet::variable(1, a.stretch + axial_strain(arm, y)),
                                         Jet::variable(2, shear_strain(arm, y)));
  ArmJet jet;
  jet.value = {slope.x.value, slope.y.value};
  for (std::size_t i = 0; i < 3; ++i) jet.first[i] = {slope.x.gradient[i], slope.y.gradient[i]};
  for (std::size_t i = 0; i < 6; ++i) jet.second[i] = {slope.x.hessian[i], slope.y.hessian[i]};
  return jet;
}

void AngleChainMotion::fill_arm_slope(std::size_t arm, const ArmJet& jet, Vec2* slope) const {
  const std::size_t m = chain_.unknowns;
  const double* turns = chain_.turns.data() + arm * m;
  for (std::size_t j = 0; j < m; ++j) slope[j] = turns[j] * jet.first[0];
  const auto add = [&](const std::vector<double>& rows, Vec2 by) {
    if (rows.empty()) return;
    const double* row = rows.data() + arm * m;
    for (std::size_t j = 0; j < m; ++j) slope[j] = slope[j] + row[j] * by;
  };
  add(chain_.axial, jet.first[1]);
  add(chain_.shear, jet.first[2]);
}

/// Places and slopes of all mass points; afterwards the scratch's sums are those at the tip.
void AngleChainMotion::place_points(MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  const ArmJet* arm_jets = jets(work);
  Vec2* slopes = reinterpret_cast<Vec2*>(jets(work) + chain_.arms.size());
  Vec2* sum_slopes = slopes + chain_.arms.size() * m;
  Vec2& sum = sum_slopes[m];
  sum = {};
  std::fill_n(sum_slopes, m, Vec2{});
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < chain_.intervals.size(); ++k) {
    for (; next < chain_.places.size() && chain_.places[next].interval == k; ++next) {
      const AngleChain::Place& place = chain_.places[next];
      Vec2 at = sum + place.offset;
      Vec2* out = work.slopes.data() + next * m;
      std::copy_n(sum_slopes, m, out);
      for (std::size_t p = 0; p < place.parts.size(); ++p) {
        const std::size_t arm = place.first_arm + p;
        const double part = place.parts[p];
        at = at + part * arm_jets[arm].value;
        const Vec2* own = slopes + arm * m;
        for (std::size_t j = 0; j < m; ++j) out[j] = out[j] + part * own[j];
      }
      work.places[next] = at;
    }
    for (std::size_t arm = chain_.intervals[k]; arm < chain_.intervals[k + 1]; ++arm) {
      const double weight = chain_.arms[arm].weight;
      sum = sum + weight * arm_jets[arm].value;
      const Vec2* own = slopes + arm * m;
      for (std::size_t j = 0; j < m; ++j) sum_slopes[j] = sum_slopes[j] + weight * own[j];
    }
  }
}

MotionPort::Answer AngleChainMotion::evaluate(const Eigen::Vector3d& load, const double* y,
                                              MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  ArmJet* arm_jets = jets(work);
  Vec2* slopes = reinterpret_cast<Vec2*>(arm_jets + chain_.arms.size());
  for (std::size_t arm = 0; arm < chain_.arms.size(); ++arm) {
    arm_jets[arm] = arm_jet(arm, y);
    fill_arm_slope(arm, arm_jets[arm], slopes + arm * m);
  }
  place_points(work);
  const Vec2* tip_slopes = slopes + chain_.arms.size() * m;
  const Vec2 tip = tip_slopes[m] + chain_.tip_offset;
  MotionPort::Answer answer{0.0, {tip.x, tip.y, 0.0}};
  const Vec2 force{load[0], load[1]};
  for (std::size_t i = 0; i < m; ++i) {
    double stiff = 0.0;
    for (std::size_t k = 0; k < m; ++k) stiff += chain_.stiffness[i * m + k] * y[k];
    answer.energy += 0.5 * stiff * y[i];
    answer.tip[2] += chain_.tip_turn[i] * y[i];
    double* column = work.columns.data() + 4 * i;
    column[0] = stiff - dot(force, tip_slopes[i]) - load[2] * chain_.tip_turn[i];
    column[1] = -tip_slopes[i].x;
    column[2] = -tip_slopes[i].y;
    column[3] = -chain_.tip_turn[i];
  }
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    const AngleChain::Direction& direction = chain_.directions[d];
    const AngleChain::Arm& arm = chain_.arms[direction.arm];
    const bool sheared = direction.along_axis && !chain_.shear.empty();
    const Vec2 unit_vector =
        unit(arm.angle + turn(direction.arm, y) + (sheared ? shear_strain(direction.arm, y) : 0.0));
    work.places[places + d] = unit_vector;
    Vec2* out = work.slopes.data() + (places + d) * m;
    const double* turns = chain_.turns.data() + direction.arm * m;
    const double* shears = sheared ? chain_.shear.data() + direction.arm * m : nullptr;
    for (std::size_t j = 0; j < m; ++j)
      out[j] = (turns[j] + (shears ? shears[j] : 0.0)) * perp(unit_vector);
  }
  return answer;
}

/// weight . (second derivatives of an arm's vector), by the chain rule.
void AngleChainMotion::add_arm_hessian(std::size_t arm, const ArmJet& jet, Vec2 weight,
                                       double* buffer, double* tangent) const {
  const std::size_t m = chain_.unknowns;
  const double* rows[3] = {chain_.turns.data() + arm * m,
                           chain_.axial.empty() ? nullptr : chain_.axial.data() + arm * m,
                           chain_.shear.empty() ? nullptr : chain_.shear.data() + arm * m};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!rows[a]) continue;
    std::fill_n(buffer, m, 0.0);
    for (std::size_t b = 0; b < 3; ++b) {
      if (!rows[b]) continue;
      const std::size_t k = a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a;
      const double factor = dot(weight, jet.second[k]);
      if (factor == 0.0) continue;
      for (std::size_t j = 0; j < m; ++j) buffer[j] += factor * rows[b][j];
    }
    for (std::size_t i = 0; i < m; ++i) {
      const double scale = rows[a][i];
      if (scale == 0.0) continue;
      double* row = tangent + i * m;
      for (std::size_t j = 0; j <= i; ++j) row[j] += scale * buffer[j];
    }
  }
}

void AngleChainMotion::linearize(const Eigen::Vector3d& load, const Vec2* weights,
                                 MemberWork& work) const {
  const std::size_t m = chain_.unknowns;
  const ArmJet* arm_jets = jets(work);
  Vec2* slopes = reinterpret_cast<Vec2*>(jets(work) + chain_.arms.size());
  Vec2* arm_weights = slopes + chain_.arms.size() * m + m + 1;
  double* buffer = reinterpret_cast<double*>(arm_weights + chain_.arms.size());
  std::copy(chain_.stiffness.begin(), chain_.stiffness.end(), work.tangent.begin());
  // what hangs on an arm: the tip, places inside its interval, and all places of later ones
  Vec2 ahead{-load[0], -load[1]};
  std::size_t next = chain_.places.size();
  std::fill_n(arm_weights, chain_.arms.size(), Vec2{});
  for (std::size_t k = chain_.intervals.size() - 1; k-- > 0;) {
    for (std::size_t arm = chain_.intervals[k]; arm < chain_.intervals[k + 1]; ++arm)
      arm_weights[arm] = arm_weights[arm] + chain_.arms[arm].weight * ahead;
    for (; weights && next > 0 && chain_.places[next - 1].interval == k; --next) {
      const AngleChain::Place& place = chain_.places[next - 1];
      ahead = ahead + weights[next - 1];
      for (std::size_t p = 0; p < place.parts.size(); ++p)
        arm_weights[place.first_arm + p] =
            arm_weights[place.first_arm + p] + place.parts[p] * weights[next - 1];
    }
  }
  for (std::size_t arm = 0; arm < chain_.arms.size(); ++arm)
    add_arm_hessian(arm, arm_jets[arm], arm_weights[arm], buffer, work.tangent.data());
  if (!weights) return;
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    // the second derivative of a unit vector by its angle is minus the vector
    const double factor = -dot(weights[places + d], work.places[places + d]);
    const std::size_t arm = chain_.directions[d].arm;
    const bool sheared = chain_.directions[d].along_axis && !chain_.shear.empty();
    for (std::size_t i = 0; i < m; ++i)
      buffer[i] = chain_.turns[arm * m + i] + (sheared ? chain_.shear[arm * m + i] : 0.0);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        work.tangent[i * m + j] += factor * buffer[i] * buffer[j];
  }
}

/// Second derivative of an arm's vector along the rates.
Vec2 AngleChainMotion::arm_curvature(std::size_t arm, const ArmJet& jet, const double* rate) const {
  const double r[3] = {turn(arm, rate), axial_strain(arm, rate), shear_strain(arm, rate)};
  Vec2 sum;
  for (std::size_t a = 0, k = 0; a < 3; ++a)
    for (std::size_t b = 0; b <= a; ++b, ++k)
      sum = sum + ((a == b ? 1.0 : 2.0) * r[a] * r[b]) * jet.second[k];
  return sum;
}

void AngleChainMotion::add_curvature(const double* rate, MemberWork& work, Vec2* curvature) const {
  const std::size_t arms = chain_.arms.size();
  const ArmJet* arm_jets = jets(work);
  Vec2* bent = reinterpret_cast<Vec2*>(jets(work) + arms) + arms * chain_.unknowns +
               chain_.unknowns + 1;  // where the arms' weights are
  for (std::size_t arm = 0; arm < arms; ++arm) bent[arm] = arm_curvature(arm, arm_jets[arm], rate);
  Vec2 sum;
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < chain_.intervals.size(); ++k) {
    for (; next < chain_.places.size() && chain_.places[next].interval == k; ++next) {
      const AngleChain::Place& place = chain_.places[next];
      curvature[next] = curvature[next] + sum;
      for (std::size_t p = 0; p < place.parts.size(); ++p)
        curvature[next] = curvature[next] + place.parts[p] * bent[place.first_arm + p];
    }
    for (std::size_t arm = chain_.intervals[k]; arm < chain_.intervals[k + 1]; ++arm)
      sum = sum + chain_.arms[arm].weight * bent[arm];
  }
  const std::size_t places = chain_.places.size();
  for (std::size_t d = 0; d < chain_.directions.size(); ++d) {
    const std::size_t arm = chain_.directions[d].arm;
    const bool sheared = chain_.directions[d].along_axis && !chain_.shear.empty();
    const double spin = turn(arm, rate) + (sheared ? shear_strain(arm, rate) : 0.0);
    curvature[places + d] = curvature[places + d] - spin * spin * work.places[places + d];
  }
}

}  // namespace flexura

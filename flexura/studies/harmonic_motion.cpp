#include "flexura/studies/harmonic_motion.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/studies/modes_study.hpp"

namespace flexura {
namespace {

using Complex = std::complex<double>;

/// Mode by mode damping counts modes up to this number.
constexpr int most_damped_modes = 200;

/// Damping in proportion to mass leaves modes as they are; dampers do not, nor does damping by the
/// elastic forces, for springs and loads are among the stiffness.
bool leaves_modes_apart(const MotionLayout& layout) {
  const auto& springs = layout.mechanism.springs;
  return layout.stiffness_damping == 0.0 &&
         std::none_of(springs.begin(), springs.end(),
                      [](const auto& spring) { return spring.damping > 0.0; });
}

}  // namespace

HarmonicMotion::HarmonicMotion(MotionSystem& system, const Moment& moment, double modal)
    : system_(system), modes_stay_apart_(leaves_modes_apart(system.layout())) {
  if (modal > 0.0) {
    const int most =
        static_cast<int>(std::min<Eigen::Index>(system.coordinates(), most_damped_modes));
    const Vibrations modes = find_vibrations(system, moment, most, ModesStudy::Solver::automatic);
    const auto first = std::count_if(modes.squares.begin(), modes.squares.end(),
                                     [](double square) { return !(square > 0.0); });
    const Eigen::Index count = modes.squares.size() - first;
    squares_ = modes.squares.tail(count);
    shapes_ = modes.shapes.rightCols(count);
    losses_ = 2.0 * modal * squares_.cwiseSqrt();
    momenta_.resize(system.coordinates(), count);
    for (Eigen::Index i = 0; i < count; ++i) momenta_.col(i) = system.multiply_mass(shapes_.col(i));
  }
  Eigen::VectorXd r;
  system_.residual(moment, r);
  system_.linearize(moment);
}

Eigen::VectorXcd HarmonicMotion::apply(const Eigen::VectorXcd& load) const {
  Eigen::VectorXcd b = Eigen::VectorXcd::Zero(system_.size());
  b.head(load.size()) = load;
  system_.solve(factor_, b);
  return b.head(load.size());
}

Eigen::VectorXcd HarmonicMotion::solve(const Eigen::VectorXd& load, double w) {
  if (!system_.factorize(Complex(-w * w, 0.0), Complex(0.0, w), factor_)) {
    // damped modes have a limit, at the frequency of one of them as well: beside it by rounding
    if (losses_.size() == 0 ||
        !system_.factorize(Complex(-w * w * (1.0 + 1e-14), 0.0), Complex(0.0, w), factor_))
      return {};
  }
  if (losses_.size() == 0) return apply(load.cast<Complex>());
  return modes_stay_apart_ ? solve_by_modes(load, w) : solve_by_rank(load, w);
}

/// Damped modes one by one, and what the load leaves of them by the matrix: nothing is cut off.
Eigen::VectorXcd HarmonicMotion::solve_by_modes(const Eigen::VectorXd& load, double w) const {
  const Eigen::VectorXd shares = shapes_.transpose() * load;
  Eigen::VectorXcd u = apply((load - momenta_ * shares).cast<Complex>());
  // near a frequency the matrix returns what rounding left of its mode
  u -= shapes_ * (momenta_.transpose() * u);
  const double mass_loss = system_.layout().mass_damping;
  Eigen::VectorXcd sizes(shares.size());
  for (Eigen::Index i = 0; i < shares.size(); ++i)
    sizes[i] = shares[i] / Complex(squares_[i] - w * w, w * (losses_[i] + mass_loss));
  return u + shapes_ * sizes;
}

/// Woodbury: with A the matrix without modal damping and U the momenta, A u + i w U D U^T u = f.
Eigen::VectorXcd HarmonicMotion::solve_by_rank(const Eigen::VectorXd& load, double w) const {
  const Eigen::VectorXcd u = apply(load.cast<Complex>());
  const Eigen::Index count = losses_.size();
  Eigen::MatrixXcd moved(load.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) moved.col(i) = apply(momenta_.col(i).cast<Complex>());
  const Eigen::VectorXcd damping = Complex(0.0, w) * losses_.cast<Complex>();
  Eigen::MatrixXcd small = damping.asDiagonal() * (momenta_.transpose() * moved);
  small += Eigen::MatrixXcd::Identity(count, count);
  const Eigen::VectorXcd forces = damping.asDiagonal() * (momenta_.transpose() * u);
  return u - moved * small.partialPivLu().solve(forces);
}

}  // namespace flexura

// Periodic orbits of small equations against closed forms, harmonic balance and long integration.
#include "flexura/solvers/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/measured.hpp"

namespace flexura::testing {
namespace {

using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// Over a period by Runge and Kutta's classical method; f(t, x) is the rate of x.
template <class F>
VectorXd integrate_period(const F& f, VectorXd x, double period, int steps = 1000) {
  const double h = period / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = h * k;
    const VectorXd a = f(t, x);
    const VectorXd b = f(t + 0.5 * h, VectorXd(x + 0.5 * h * a));
    const VectorXd c = f(t + 0.5 * h, VectorXd(x + 0.5 * h * b));
    const VectorXd d = f(t + h, VectorXd(x + h * c));
    x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return x;
}

template <class F>
auto period_map(F f, double period) {
  return DifferencedMap([f, period](const VectorXd& x, VectorXd& end) {
    end = integrate_period(f, x, period);
    return end.allFinite();
  });
}

template <class Map>
PeriodicOrbitSummary solve(Map map, VectorXd& x, PeriodicOrbitOptions options = {}) {
  return PeriodicOrbit<Map>(map, std::move(options)).solve(x);
}

/// x_i'' + 2 z_i w_i x_i' + w_i^2 x_i = cos(W t), i = 1..n.
struct Oscillators {
  std::vector<double> frequencies;
  std::vector<double> dampings;  // shares of the critical one
  double driven = 1.0;

  VectorXd operator()(double t, const VectorXd& x) const {
    VectorXd rate(x.size());
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(2 * i);
      const double w = frequencies[i];
      rate[k] = x[k + 1];
      rate[k + 1] = std::cos(driven * t) - 2.0 * dampings[i] * w * x[k + 1] - w * w * x[k];
    }
    return rate;
  }
  /// x_i = Re(c e^{iWt}), c = 1/(w^2 - W^2 + 2 i z w W).
  VectorXd steady() const {
    VectorXd x(static_cast<Eigen::Index>(2 * frequencies.size()));
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const double w = frequencies[i];
      const std::complex<double> c =
          1.0 / std::complex<double>(w * w - driven * driven, 2.0 * dampings[i] * w * driven);
      x.segment<2>(static_cast<Eigen::Index>(2 * i)) << c.real(), -driven * c.imag();
    }
    return x;
  }
  /// e^{(-z w + i w sqrt(1 - z^2)) T}.
  std::complex<double> multiplier(std::size_t i) const {
    const double z = dampings[i];
    return std::exp(frequencies[i] * std::complex<double>(-z, std::sqrt(1.0 - z * z)) * 2.0 * pi /
                    driven);
  }
};

TEST(PeriodicOrbit, ADampedOscillatorHasItsClosedForm) {
  const Oscillators one{{1.7}, {0.01}, 1.0};
  VectorXd x = VectorXd::Zero(2);
  const PeriodicOrbitSummary summary = solve(period_map(one, 2.0 * pi), x);
  ASSERT_TRUE(summary.converged());
  note_measured("state", (x - one.steady()).norm());
  EXPECT_LT((x - one.steady()).norm(), 1e-9);
  EXPECT_LE(summary.turns, 3);
  EXPECT_EQ(summary.flows, 2);
  ASSERT_EQ(summary.multipliers.size(), 2u);
  // the one above the real axis comes first
  EXPECT_LT(std::abs(summary.multipliers[0] - std::conj(one.multiplier(0))), 1e-8);
  EXPECT_LT(std::abs(summary.multipliers[1] - one.multiplier(0)), 1e-8);
}

/// Fifteen of twenty die out in a turn: the space is that of the others, whose multipliers are
/// nearly 1.
TEST(PeriodicOrbit, TheSpaceIsThatOfWhatATurnLeaves) {
  Oscillators many;
  for (int i = 0; i < 20; ++i) {
    many.frequencies.push_back(1.3 + 0.37 * i);
    many.dampings.push_back(i % 4 == 0 ? 1e-4 : 0.8);
  }
  VectorXd x = VectorXd::Zero(40);
  const PeriodicOrbitSummary summary = solve(period_map(many, 2.0 * pi), x);
  ASSERT_TRUE(summary.converged());
  EXPECT_LT((x - many.steady()).norm(), 1e-8);
  EXPECT_LE(summary.flows, 14);
  ASSERT_GE(summary.multipliers.size(), 6u);
  double worst = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    double nearest = INFINITY;
    for (std::size_t i = 0; i < 20; ++i)
      nearest = std::min({nearest, std::abs(summary.multipliers[k] - many.multiplier(i)),
                          std::abs(std::conj(summary.multipliers[k]) - many.multiplier(i))});
    worst = std::max(worst, nearest);
    EXPECT_GT(std::abs(summary.multipliers[k]), 0.99);
  }
  note_measured("multipliers", worst);
  EXPECT_LT(worst, 1e-3);
}

/// x'' + 2 z x' + x + x^3 = f cos(W t).
struct Duffing {
  double damping = 0.0;
  double force = 0.0;
  double driven = 1.0;

  VectorXd operator()(double t, const VectorXd& x) const {
    return Eigen::Vector2d(
        x[1], force * std::cos(driven * t) - 2.0 * damping * x[1] - x[0] - x[0] * x[0] * x[0]);
  }
};

/// Harmonics 1, 3, .. of the steady motion: Galerkin's equations, by Newton's method from a first
/// harmonic c cos Wt + s sin Wt.
class HarmonicBalance {
 public:
  HarmonicBalance(const Duffing& duffing, double c, double s) : duffing_(duffing) {
    shares_.setZero(2 * harmonics);
    shares_.head<2>() << c, s;
    for (int k = 0; k < 30; ++k) {
      Eigen::MatrixXd slope(2 * harmonics, 2 * harmonics);
      const VectorXd r = residual(shares_);
      for (int j = 0; j < 2 * harmonics; ++j) {
        constexpr double h = 1e-6;
        VectorXd ahead = shares_, behind = shares_;
        ahead[j] += h;
        behind[j] -= h;
        slope.col(j) = (residual(ahead) - residual(behind)) / (2.0 * h);
      }
      shares_ -= slope.partialPivLu().solve(r);
    }
  }
  /// x and its rate at time 0.
  VectorXd start() const {
    Eigen::Vector2d x = Eigen::Vector2d::Zero();
    for (int h = 0; h < harmonics; ++h)
      x += Eigen::Vector2d(shares_[2 * h], (2 * h + 1) * duffing_.driven * shares_[2 * h + 1]);
    return x;
  }

 private:
  static constexpr int harmonics = 12;
  static constexpr int samples = 128;

  VectorXd residual(const VectorXd& shares) const {
    VectorXd r = VectorXd::Zero(2 * harmonics);
    for (int k = 0; k < samples; ++k) {
      const double phase = 2.0 * pi * k / samples;
      double x = 0.0, v = 0.0, a = 0.0;
      for (int h = 0; h < harmonics; ++h) {
        const double n = 2.0 * h + 1.0, w = n * duffing_.driven;
        const double c = std::cos(n * phase), s = std::sin(n * phase);
        x += shares[2 * h] * c + shares[2 * h + 1] * s;
        v += w * (shares[2 * h + 1] * c - shares[2 * h] * s);
        a -= w * w * (shares[2 * h] * c + shares[2 * h + 1] * s);
      }
      const double left =
          a + 2.0 * duffing_.damping * v + x + x * x * x - duffing_.force * std::cos(phase);
      for (int h = 0; h < harmonics; ++h) {
        r[2 * h] += left * std::cos((2 * h + 1) * phase) / samples;
        r[2 * h + 1] += left * std::sin((2 * h + 1) * phase) / samples;
      }
    }
    return r;
  }

  const Duffing duffing_;
  VectorXd shares_;
};

TEST(PeriodicOrbit, DuffingsEquationIsInHarmonicBalance) {
  const Duffing duffing{0.02, 0.3, 2.5};
  VectorXd x = VectorXd::Zero(2);
  const PeriodicOrbitSummary summary = solve(period_map(duffing, 2.0 * pi / 2.5), x);
  ASSERT_TRUE(summary.converged());
  const HarmonicBalance balance(duffing, -0.06, 0.0);
  note_measured("state", (x - balance.start()).norm());
  EXPECT_LT((x - balance.start()).norm(), 1e-8);
}

/// By waiting: turns until the orbit is as near as shooting leaves it.
TEST(PeriodicOrbit, ShootingTakesFewTurnsWhereWaitingTakesMany) {
  const Duffing duffing{0.002, 0.3, 2.5};
  auto map = period_map(duffing, 2.0 * pi / 2.5);
  VectorXd x = VectorXd::Zero(2);
  const PeriodicOrbitSummary summary = solve(map, x);
  ASSERT_TRUE(summary.converged());
  VectorXd waited = VectorXd::Zero(2), end;
  int turns = 0;
  while ((waited - x).norm() > 1e-6 && turns < 20000) {
    map.turn(waited, end);
    waited = end;
    ++turns;
  }
  ::testing::Test::RecordProperty("turns_by_shooting", summary.turns + summary.flows);
  ::testing::Test::RecordProperty("turns_by_waiting", turns);
  EXPECT_LT(summary.turns + summary.flows, 30);
  EXPECT_GT(turns, 1000);
  EXPECT_LT(turns, 20000);
  EXPECT_LT(std::abs(std::abs(summary.multipliers.front()) - std::exp(-0.002 * 2.0 * pi / 2.5)),
            1e-6);
}

/// Between the folds of its resonance there is an orbit that nothing stays on.
TEST(PeriodicOrbit, UnstableOrbitsAreFound) {
  const Duffing duffing{0.02, 0.3, 2.0};
  const double period = 2.0 * pi / 2.0;
  const HarmonicBalance balance(duffing, -1.668, 1.02);
  VectorXd x = balance.start() + Eigen::Vector2d(0.01, -0.01);
  const PeriodicOrbitSummary summary = solve(period_map(duffing, period), x);
  ASSERT_TRUE(summary.converged());
  EXPECT_LT((x - balance.start()).norm(), 1e-8);
  ASSERT_EQ(summary.multipliers.size(), 2u);
  note_measured("largest_multiplier", summary.multipliers[0].real());
  EXPECT_GT(summary.multipliers[0].real(), 1.0);
  EXPECT_NEAR((summary.multipliers[0] * summary.multipliers[1]).real(),
              std::exp(-2.0 * 0.02 * period), 1e-6);
}

/// A synchronous motor: th'' = -c (th' - W) + k sin(W t - th) - m; th = W t - asin(m/k). Its angle
/// is the same after a turn, but for the turn.
TEST(PeriodicOrbit, TurnsAreTakenOff) {
  const double speed = 3.0, period = 2.0 * pi / speed, pull = 2.0, load = 0.5, drag = 0.05;
  const auto motor = [=](double t, const VectorXd& x) {
    return Eigen::Vector2d(x[1], -drag * (x[1] - speed) + pull * std::sin(speed * t - x[0]) - load);
  };
  DifferencedMap map([=](const VectorXd& x, VectorXd& end) {
    end = integrate_period([&](double t, const VectorXd& y) { return VectorXd(motor(t, y)); }, x,
                           period);
    end[0] -= 2.0 * pi;
    return true;
  });
  VectorXd x = Eigen::Vector2d(0.2, 2.9);
  const PeriodicOrbitSummary summary = solve(map, x);
  ASSERT_TRUE(summary.converged());
  EXPECT_NEAR(x[0], -std::asin(load / pull), 1e-8);
  EXPECT_NEAR(x[1], speed, 1e-8);
}

TEST(PeriodicOrbit, WhatThereIsNotIsNotFound) {
  VectorXd x = VectorXd::Zero(2);
  const DifferencedMap drifts([](const VectorXd& from, VectorXd& end) {
    end = from + Eigen::Vector2d(1.0, std::exp(from[1]));
    return true;
  });
  EXPECT_EQ(solve(drifts, x).outcome, OrbitOutcome::stalled);
  const DifferencedMap breaks([](const VectorXd&, VectorXd&) { return false; });
  EXPECT_EQ(solve(breaks, x).outcome, OrbitOutcome::no_turn);
  PeriodicOrbitOptions impatient;
  impatient.keep_going = [] { return false; };
  EXPECT_EQ(solve(period_map(Oscillators{{1.7}, {0.01}, 1.0}, 2.0 * pi), x, impatient).outcome,
            OrbitOutcome::cancelled);
  EXPECT_EQ(PeriodicOrbitSummary{}.outcome, OrbitOutcome::not_run);
}

}  // namespace
}  // namespace flexura::testing

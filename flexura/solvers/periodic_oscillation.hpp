#pragma once

#include <Eigen/Dense>
#include <complex>
#include <functional>
#include <vector>

namespace flexura {

/// A linear oscillation over an angle:
///     mass u'' + damping u' + stiffness u = load,
/// primes by the angle.
struct OscillationMatrices {
  Eigen::MatrixXd mass, damping, stiffness;
  Eigen::VectorXd load;
};

/// u with its derivatives at an angle.
struct OscillationState {
  Eigen::VectorXd u, first, second;
};

/// A linear oscillation whose matrices and loads are periodic, by collocation at Radau's points
/// (order 2s - 1 for s stages; what the intervals do not resolve follows its load and dies out). A
/// turn is factorized once, interval by interval; every further turn is a back-substitution.
class PeriodicOscillation {
 public:
  using Matrices = std::function<OscillationMatrices(double angle)>;

  /// `ends`: of the intervals, ascending over one turn.
  PeriodicOscillation(std::vector<double> ends, int stages, const Matrices& at);

  Eigen::Index size() const { return size_; }
  /// Over the turn, from u and u' one upon the other.
  Eigen::VectorXd advance(Eigen::VectorXd start, bool loaded) const;
  /// The same, with the states at the ends of all intervals; the first has no second derivative
  /// (it is left zero).
  std::vector<OscillationState> states(const Eigen::VectorXd& start) const;
  /// u at the stages of all intervals.
  std::vector<Eigen::VectorXd> stage_displacements(const Eigen::VectorXd& start) const;

  /// The periodic motion, y(turn) = y(0), by GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7,
  /// 1986) on the map of one turn, for which only as many turns are needed as there are motions
  /// that do not die out within one. `multipliers`: those of Floquet that its Krylov space has
  /// found, largest first.
  struct Periodic {
    Eigen::VectorXd start;
    std::vector<std::complex<double>> multipliers;
    int turns = 0;
    double residual = 0.0;  ///< what is left of y(turn) - y(0), over the size of y
  };
  Periodic solve_periodic() const;

 private:
  struct Interval {
    double length = 0.0;
    std::vector<OscillationMatrices> stages;
    Eigen::PartialPivLU<Eigen::MatrixXd> factor;
  };
  /// Second derivatives at all stages, one upon the other.
  Eigen::VectorXd stage_rates(const Interval& interval, const Eigen::VectorXd& y,
                              bool loaded) const;
  void finish(const Interval& interval, const Eigen::VectorXd& rates, Eigen::VectorXd& y) const;

  Eigen::Index size_ = 0;
  Eigen::VectorXd nodes_;
  Eigen::MatrixXd once_, twice_;  // integrals
  std::vector<Interval> intervals_;
};

}  // namespace flexura

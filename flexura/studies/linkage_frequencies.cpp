#include <algorithm>
#include <cmath>
#include <numeric>

#include "flexura/solvers/vibration.hpp"
#include "flexura/studies/linkage_methods.hpp"

namespace flexura {
namespace {

/// Which mode each mode before goes over into: the pairing by the largest products of shapes with
/// the mass, one after the other.
std::vector<std::size_t> follow(const Eigen::MatrixXd& before, const Eigen::MatrixXd& mass,
                                const Eigen::MatrixXd& now) {
  Eigen::MatrixXd likeness = (before.transpose() * mass * now).cwiseAbs();
  std::vector<std::size_t> next(static_cast<std::size_t>(before.cols()));
  for (Eigen::Index count = 0; count < before.cols(); ++count) {
    Eigen::Index i = 0, j = 0;
    likeness.maxCoeff(&i, &j);
    next[static_cast<std::size_t>(i)] = static_cast<std::size_t>(j);
    likeness.row(i).setConstant(-1.0);
    likeness.col(j).setConstant(-1.0);
  }
  return next;
}

/// The largest x of -Kg v = x K v: the axial forces over those that buckle.
double buckling_share(const LinkageTurn& turn, double angle, double speed) {
  const Eigen::MatrixXd& elastic = turn.matrices(angle).stiffness;
  const Eigen::MatrixXd geometric =
      turn.system().stress_stiffness(turn.state(angle), turn.static_displacement(angle, speed));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(-geometric, elastic,
                                                                         Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace

void find_frequencies(const LinkageTurn& turn, const LinkageStudy& study, double speed,
                      LinkageResult& result) {
  const int count = std::min(std::max(4, study.modes), static_cast<int>(turn.system().size()));
  Eigen::MatrixXd before;
  std::vector<std::size_t> order;  // of the modes followed, among those of a position
  double worst = 0.0;
  for (const double angle : turn.positions()) {
    const LinkageMatrices& m = turn.matrices(angle);
    const Vibrations found = dense_vibrations(turn.stiffness(angle, speed), m.mass,
                                              Eigen::MatrixXd(0, m.mass.cols()), count);
    std::vector<double> frequencies;
    frequencies.reserve(static_cast<std::size_t>(found.squares.size()));
    for (Eigen::Index i = 0; i < found.squares.size(); ++i)
      frequencies.push_back(std::copysign(std::sqrt(std::abs(found.squares[i])), found.squares[i]));
    if (order.size() != frequencies.size()) {  // what has no mass has no frequency
      order.resize(frequencies.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
    } else if (before.cols() == found.shapes.cols()) {
      const std::vector<std::size_t> next = follow(before, m.mass, found.shapes);
      for (std::size_t& place : order) place = next[place];
    }
    before = found.shapes;
    std::vector<double> followed;
    followed.reserve(order.size());
    for (const std::size_t place : order) followed.push_back(frequencies[place]);
    result.frequencies.push_back(std::move(frequencies));
    result.followed.push_back(std::move(followed));
    if (!turn.system().stiffens()) continue;
    const double share = buckling_share(turn, angle, speed);
    if (share <= worst) continue;
    worst = share;
    result.buckling_angle = angle;
  }
  if (worst > 1e-9) result.buckling_factor = 1.0 / worst;
}

}  // namespace flexura

#include "flexura/studies/linkage_turn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/core/radau_rule.hpp"
#include "flexura/modelings/make_linkage.hpp"

namespace flexura {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double same_angle = 1e-12;

void sort_apart(std::vector<double>& angles) {
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end(),
                           [](double a, double b) { return b - a < same_angle; }),
               angles.end());
}

}  // namespace

LinkageTurn::LinkageTurn(const Model& model, const LinkageStudy& study, bool refined)
    : study_(study),
      sense_(std::copysign(1.0, model.drivers[study.driver].amount)),
      system_(make_linkage(model, study, refined)) {}

DriveRate LinkageTurn::drive(double angle) const {
  DriveRate drive;
  for (const SpeedHarmonic& harmonic : study_.fluctuation) {
    const double phase = harmonic.order * angle - harmonic.phase;
    drive.rate += harmonic.amplitude * std::cos(phase);
    drive.slope -= harmonic.amplitude * harmonic.order * std::sin(phase);
  }
  return drive;
}

bool LinkageTurn::visit(std::vector<double> angles) {
  std::erase_if(angles, [&](double angle) {
    return !visits_.empty() && std::abs(at(angle).angle - angle) < same_angle;
  });
  sort_apart(angles);
  std::vector<double> turns;
  turns.reserve(angles.size());
  for (const double angle : angles) turns.push_back(sense_ * angle);
  std::optional<RigidFailure> failure;
  std::vector<RigidState> states = system_.rigid().trace(turns, failure);
  for (std::size_t k = 0; k < states.size(); ++k) {
    RigidState& state = states[k];
    state.angle = angles[k];
    for (PartMotion& part : state.parts) {
      part.first = sense_ * part.first;
      part.first_turn *= sense_;
    }
    visits_.push_back(
        {angles[k], state, system_.matrices(state, drive(angles[k]), study_.coupling)});
  }
  std::sort(visits_.begin(), visits_.end(),
            [](const Visit& a, const Visit& b) { return a.angle < b.angle; });
  if (failure) failure_ = failure;
  return !failure;
}

const LinkageTurn::Visit& LinkageTurn::at(double angle) const {
  auto found = std::lower_bound(visits_.begin(), visits_.end(), angle,
                                [](const Visit& v, double a) { return v.angle < a; });
  if (found == visits_.end() ||
      (found != visits_.begin() && angle - (found - 1)->angle < found->angle - angle))
    --found;
  return *found;
}

Eigen::VectorXd LinkageTurn::static_displacement(double angle, double speed) const {
  const LinkageMatrices& m = matrices(angle);
  return m.stiffness.ldlt().solve(m.load + speed * speed * m.inertia_load);
}

Eigen::MatrixXd LinkageTurn::stiffness_of(double angle, const Eigen::VectorXd& u) const {
  if (study_.geometric_stiffness == LinkageStudy::GeometricStiffness::none)
    return matrices(angle).stiffness;
  return matrices(angle).stiffness + system_.stress_stiffness(state(angle), u);
}

Eigen::MatrixXd LinkageTurn::stiffness(double angle, double speed) const {
  if (study_.geometric_stiffness == LinkageStudy::GeometricStiffness::none)
    return matrices(angle).stiffness;
  return stiffness_of(angle, static_displacement(angle, speed));
}

/// Modal: sum of M shape 2 zeta w shape^T M over all modes, which is smooth where modes veer. With
/// K = L L^T it is 2 zeta L sqrt(L^-1 M L^-T) L^T.
std::optional<Eigen::MatrixXd> LinkageTurn::damping(double angle,
                                                    const Eigen::MatrixXd& stiffness) const {
  const LinkageMatrices& m = matrices(angle);
  const DampingSettings& settings = study_.damping;
  Eigen::MatrixXd sum = settings.mass * m.mass + settings.stiffness * m.stiffness;
  const Eigen::LLT<Eigen::MatrixXd> root(stiffness);
  if (root.info() != Eigen::Success) return {};
  if (settings.modal == 0.0 || sum.size() == 0) return sum;
  Eigen::MatrixXd scaled = root.matrixL().solve(m.mass);
  scaled = root.matrixL().solve(scaled.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (scaled + scaled.transpose()));
  const Eigen::MatrixXd shapes = root.matrixL() * modes.eigenvectors();
  const Eigen::VectorXd weights = modes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return sum + 2.0 * settings.modal * shapes * weights.asDiagonal() * shapes.transpose();
}

OscillationMatrices LinkageTurn::oscillation(double angle, double speed,
                                             const Eigen::MatrixXd& stiffness,
                                             const Eigen::MatrixXd& damped_by) const {
  const LinkageMatrices& m = matrices(angle);
  const DriveRate rate = drive(angle);
  const double w = speed * rate.rate;
  const auto damped = damping(angle, damped_by);
  if (!damped) throw Buckled{angle};
  OscillationMatrices over;
  over.mass = w * w * m.mass;
  over.damping = speed * w * rate.slope * m.mass + w * (speed * m.turning + *damped);
  over.stiffness = stiffness + speed * speed * m.carrying;
  if (study_.damping.stiffness > 0.0)
    over.stiffness += speed * study_.damping.stiffness * m.straining;
  over.load = m.load + speed * speed * m.inertia_load;
  return over;
}

std::vector<double> LinkageTurn::positions() const {
  std::vector<double> angles;
  for (int k = 0; k <= study_.positions; ++k)
    angles.push_back(k == study_.positions ? turn : turn * k / study_.positions);
  return angles;
}

std::vector<double> LinkageTurn::interval_ends(int parts) const {
  std::vector<double> ends = positions();
  for (const Load& load : study_.loads)
    for (const double at : history_breaks(load.history, 0.0, turn)) ends.push_back(at);
  sort_apart(ends);
  std::vector<double> cut;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (int i = 0; i < parts; ++i) cut.push_back(ends[k] + (ends[k + 1] - ends[k]) * i / parts);
  cut.push_back(ends.back());
  return cut;
}

std::vector<double> LinkageTurn::stage_angles(const std::vector<double>& ends, int stages) {
  const Eigen::VectorXd nodes = radau_rule(stages).nodes;
  std::vector<double> angles(ends.begin(), ends.begin() + 1);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (Eigen::Index i = 0; i < nodes.size(); ++i)
      angles.push_back(ends[k] + nodes[i] * (ends[k + 1] - ends[k]));
  return angles;
}

}  // namespace flexura

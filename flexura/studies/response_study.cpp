#include "flexura/studies/response_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/motion_start.hpp"

namespace flexura {
namespace {

using Complex = std::complex<double>;

/// Mode by mode damping counts modes up to this number.
constexpr int most_damped_modes = 200;

/// Amplitudes of coordinates about a state: solutions of
///     (K + i w C - w^2 M) u = f,
/// modal damping as a matrix of low rank.
class HarmonicMotion {
 public:
  HarmonicMotion(MotionSystem& system, const Moment& moment, const DampingSettings& damping);

  Eigen::VectorXcd solve(const Eigen::VectorXd& load, double w);

 private:
  MotionSystem& system_;
  Eigen::MatrixXd momenta_;  // M shape of every damped mode
  Eigen::VectorXd losses_;   // 2 share w of it
  MotionFactor<Complex> factor_;
};

HarmonicMotion::HarmonicMotion(MotionSystem& system, const Moment& moment,
                               const DampingSettings& damping)
    : system_(system) {
  if (damping.modal > 0.0) {
    const int count =
        static_cast<int>(std::min<Eigen::Index>(system.coordinates(), most_damped_modes));
    const Vibrations modes = find_vibrations(system, moment, count, ModesStudy::Solver::automatic);
    momenta_.resize(system.coordinates(), modes.squares.size());
    losses_.setZero(modes.squares.size());
    for (Eigen::Index i = 0; i < modes.squares.size(); ++i) {
      momenta_.col(i) = system.multiply_mass(modes.shapes.col(i));
      losses_[i] = 2.0 * damping.modal * std::sqrt(std::max(0.0, modes.squares[i]));
    }
  }
  Eigen::VectorXd r;
  system_.residual(moment, r);
  system_.linearize(moment);
}

/// Woodbury: with A the undamped matrix and U the momenta, A u + i w U D U^T u = f.
Eigen::VectorXcd HarmonicMotion::solve(const Eigen::VectorXd& load, double w) {
  const Eigen::Index n = system_.coordinates();
  if (!system_.factorize(Complex(-w * w, 0.0), Complex(0.0, w), factor_)) return {};
  const auto apply = [&](const Eigen::VectorXcd& rhs) {
    Eigen::VectorXcd b = Eigen::VectorXcd::Zero(system_.size());
    b.head(n) = rhs;
    system_.solve(factor_, b);
    return Eigen::VectorXcd(b.head(n));
  };
  Eigen::VectorXcd u = apply(load.cast<Complex>());
  if (losses_.size() == 0) return u;
  Eigen::MatrixXcd moved(n, losses_.size());
  for (Eigen::Index i = 0; i < losses_.size(); ++i)
    moved.col(i) = apply(momenta_.col(i).cast<Complex>());
  Eigen::MatrixXcd small = momenta_.transpose().cast<Complex>() * moved;
  for (Eigen::Index i = 0; i < losses_.size(); ++i) small.row(i) *= Complex(0.0, w) * losses_[i];
  small += Eigen::MatrixXcd::Identity(losses_.size(), losses_.size());
  Eigen::VectorXcd forces = momenta_.transpose().cast<Complex>() * u;
  for (Eigen::Index i = 0; i < losses_.size(); ++i) forces[i] *= Complex(0.0, w) * losses_[i];
  return u - moved * small.partialPivLu().solve(forces);
}

/// Rows of the response: displacements of bodies and points by the coordinates.
Eigen::MatrixXd place_rows(const Model& model, const MotionSystem& system, const Moment& moment) {
  std::vector<Eigen::RowVectorXd> rows;
  const auto row = [&](int unknown, double slope, int rotation, double by_rotation) {
    rows.push_back(Eigen::RowVectorXd::Zero(system.coordinates()));
    if (unknown >= 0) rows.back()[unknown] += slope;
    if (rotation >= 0) rows.back()[rotation] += by_rotation;
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Numbering::Body& index = system.numbering().bodies[b];
    row(index.position, 1.0, -1, 0.0);
    row(index.position + 1, 1.0, -1, 0.0);
    row(index.rotation, 1.0, -1, 0.0);
    const double turn = system.linearised() ? 0.0 : system.pose(b, moment.q).rotation;
    for (const Point& point : model.bodies[b].points) {
      const Vec2 arm = rotate(turn, point.position - system.layout().mechanism.bodies[b].centre);
      row(index.position, 1.0, index.rotation, -arm.y);
      row(index.position + 1, 1.0, index.rotation, arm.x);
    }
  }
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), system.coordinates());
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = rows[i];
  return all;
}

/// Forces of the study's loads on the coordinates.
Eigen::VectorXd load_vector(const Model& model, const MotionSystem& system, const Moment& moment,
                            const std::vector<Load>& loads) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(system.coordinates());
  for (const Load& load : loads) {
    const Numbering::Body& index = system.numbering().bodies[load.body];
    if (index.position < 0) continue;
    const Vec2 centre = system.layout().mechanism.bodies[load.body].centre;
    const Vec2 at = load.point ? model.bodies[load.body].points[*load.point].position : centre;
    const double turn = system.linearised() ? 0.0 : system.pose(load.body, moment.q).rotation;
    forces[index.position] += load.force.x;
    forces[index.position + 1] += load.force.y;
    if (index.rotation >= 0)
      forces[index.rotation] += cross(rotate(turn, at - centre), load.force) + load.moment;
  }
  return forces;
}

std::vector<double> frequencies_of(const ResponseStudy& study) {
  std::vector<double> frequencies;
  for (int k = 0; k < study.count; ++k) {
    const double share = static_cast<double>(k) / (study.count - 1);
    frequencies.push_back(study.logarithmic ? study.from * std::pow(study.to / study.from, share)
                                            : study.from + share * (study.to - study.from));
  }
  frequencies.back() = study.to;
  return frequencies;
}

class Response {
 public:
  Response(const Model& model, const ResponseStudy& study, const ModelingSettings& settings,
           const std::function<bool(double)>& keep_going)
      : model_(model), study_(study), settings_(settings), keep_going_(keep_going) {}

  ModelingResponse run();

 private:
  std::vector<ResponseState> sweep(MotionSystem& system, const Moment& moment, double from,
                                   double to);

  const Model& model_;
  const ResponseStudy& study_;
  const ModelingSettings& settings_;
  const std::function<bool(double)>& keep_going_;
  ModelingResponse response_;
};

std::vector<ResponseState> Response::sweep(MotionSystem& system, const Moment& moment, double from,
                                           double to) {
  HarmonicMotion harmonic(system, moment, study_.damping);
  const Eigen::MatrixXd rows = place_rows(model_, system, moment);
  const Eigen::VectorXd load = load_vector(model_, system, moment, study_.loads);
  const std::vector<double> frequencies = frequencies_of(study_);
  std::vector<ResponseState> states;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const Eigen::VectorXcd u = harmonic.solve(load, frequencies[k]);
    if (u.size() == 0 || !u.allFinite()) {
      response_.termination = {
          Status::stopped,
          fmt::format("undamped resonance at angular frequency {:.6g}: the amplitude has no limit "
                      "there. Damping gives it one",
                      frequencies[k])};
      return states;
    }
    const Eigen::VectorXcd amplitudes = rows.cast<Complex>() * u;
    states.push_back({frequencies[k], {amplitudes.begin(), amplitudes.end()}});
    const double share = static_cast<double>(k + 1) / static_cast<double>(frequencies.size());
    if (k % 64 == 63 && keep_going_ && !keep_going_(from + share * (to - from))) {
      response_.termination = {
          Status::stopped, fmt::format("cancelled at angular frequency {:.6g}", frequencies[k])};
      return states;
    }
  }
  return states;
}

/// Largest difference of an amplitude, relative to the largest of its place.
double relative_difference(const std::vector<ResponseState>& here,
                           const std::vector<ResponseState>& there) {
  const std::size_t states = std::min(here.size(), there.size());
  if (states == 0) return 0.0;
  double worst = 0.0;
  double most = 0.0;
  for (const ResponseState& state : there)
    for (const Complex& a : state.amplitudes) most = std::max(most, std::abs(a));
  for (std::size_t p = 0; p < there.front().amplitudes.size(); ++p) {
    double largest = 1e-9 * most;
    double difference = 0.0;
    for (std::size_t k = 0; k < states; ++k) {
      largest = std::max(largest, std::abs(there[k].amplitudes[p]));
      difference = std::max(difference, std::abs(here[k].amplitudes[p] - there[k].amplitudes[p]));
    }
    if (largest > 0.0) worst = std::max(worst, difference / largest);
  }
  return worst;
}

/// By a modeling that chooses its own modes, refined until the amplitudes settle.
ModelingResponse Response::run() {
  constexpr int most_refinements = 4;
  response_.label = settings_.label;
  response_.modeling = modeling_name(settings_);
  MotionStart start = start_about(model_, study_.about, settings_, study_.inertia);
  response_.termination = start.termination;
  if (!start.termination.converged()) return std::move(response_);
  response_.states = sweep(*start.system, start.moment, 0.0, 0.4);
  for (int refinements = 0; response_.termination.converged(); ++refinements) {
    auto finer = start.system->refined();
    if (!finer) break;
    Moment moment = start.system->prolong(start.moment, *finer);
    if (study_.about && !solve_at_rest(*finer, moment)) break;
    const Termination before = response_.termination;
    std::vector<ResponseState> more = sweep(*finer, moment, 0.4, 0.9);
    if (!response_.termination.converged()) {
      response_.termination = before;
      break;
    }
    response_.error_estimate = relative_difference(response_.states, more);
    if (!chooses_modes(settings_) || refinements == most_refinements ||
        *response_.error_estimate <= std::max(settings_.tolerance, 1e-10))
      break;
    start.system = std::move(finer);
    start.moment = std::move(moment);
    response_.states = std::move(more);
  }
  response_.unknowns = static_cast<int>(start.system->size());
  return std::move(response_);
}

}  // namespace

ModelingResponse run_response(const Model& model, const ResponseStudy& study,
                              const ModelingSettings& settings,
                              const std::function<bool(double)>& keep_going) {
  const auto start = std::chrono::steady_clock::now();
  ModelingResponse response = Response(model, study, settings, keep_going).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  response.seconds = took.count();
  return response;
}

std::vector<std::string> response_places(const Model& model) {
  std::vector<std::string> places;
  for (const Body& body : model.bodies) {
    if (body.fixed) continue;
    for (const char* component : {".x", ".y", ".rotation"}) places.push_back(body.name + component);
    for (const Point& point : body.points)
      for (const char* component : {".x", ".y"})
        places.push_back(body.name + "." + point.name + component);
  }
  return places;
}

void compare_responses(ResponseResult& result) {
  const ModelingResponse& reference = result.modelings[result.reference];
  for (std::size_t m = 0; m < result.modelings.size(); ++m)
    if (m != result.reference && !result.modelings[m].states.empty() && !reference.states.empty())
      result.modelings[m].difference =
          relative_difference(result.modelings[m].states, reference.states);
}

}  // namespace flexura

#include "flexura/studies/response_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexura/studies/harmonic_motion.hpp"
#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/motion_start.hpp"

namespace flexura {
namespace {

using Complex = std::complex<double>;

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
  HarmonicMotion harmonic(system, moment, study_.damping.modal);
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

bool grows(MotionSystem& system, const Moment& moment) {
  const Vibrations lowest = find_vibrations(system, moment, 1, ModesStudy::Solver::automatic);
  return lowest.squares.size() > 0 && lowest.squares[0] < 0.0;
}

/// By a modeling that chooses its own modes, refined until the amplitudes settle.
ModelingResponse Response::run() {
  constexpr int most_refinements = 4;
  response_.label = settings_.label;
  response_.modeling = modeling_name(settings_);
  MotionStart start = start_about(model_, study_.about, settings_, study_.inertia);
  response_.termination = start.termination;
  if (!start.termination.converged()) return std::move(response_);
  start.system->set_rayleigh_damping(study_.damping.mass, study_.damping.stiffness);
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
  if (study_.about && response_.termination.converged() && grows(*start.system, start.moment))
    response_.termination.reason =
        "about an unstable state: the smallest disturbance grows, and no steady vibration is seen";
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

#include "flexura/studies/stage_record.hpp"

#include <array>
#include <cmath>

namespace flexura {
namespace {

System::Place place_of(const Model& model, const DirectedPlace& at) {
  if (at.point) return {at.body, model.bodies[at.body].points[*at.point].position};
  return {at.body, body_centre(model, at.body)};
}

Vec2 unit_of(Vec2 v) { return (1.0 / norm(v)) * v; }

/// How a place moves per load factor along the path.
struct Velocity {
  Vec2 linear;
  double angular = 0.0;
};

Velocity velocity_of(const System& system, const System::Place& place, const std::vector<double>& z,
                     const std::vector<double>& rate) {
  // a central difference: second order in a step that is exact to ten digits
  const double step = 1e-5 / std::max(1e-300, std::sqrt(system.inner(rate, rate)));
  std::vector<double> ahead = z, behind = z;
  for (std::size_t i = 0; i < z.size(); ++i) {
    ahead[i] += step * rate[i];
    behind[i] -= step * rate[i];
  }
  const double factor = 0.5 / step;
  return {factor * (system.moved_point(place.body, place.drawn, ahead) -
                    system.moved_point(place.body, place.drawn, behind)),
          factor *
              (system.pose(place.body, ahead).rotation - system.pose(place.body, behind).rotation)};
}

/// Compliances this much smaller than the largest are rounding: the direction is rigid.
constexpr double rigid = 1e-11;

/// Inverse of the compliance of some places; absent where they cannot move in some direction.
/// Places on one pin, which have no rotation of their own, get zeros for their moment.
std::optional<Eigen::MatrixXd> stiffness_of(const Eigen::MatrixXd& compliance, double length) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(compliance.rows());
  for (Eigen::Index i = 2; i < scale.size(); i += 3) scale[i] = length;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * compliance * scale.asDiagonal();
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    if (scaled(i, i) != 0.0) free.push_back(i);
  const Eigen::MatrixXd kept = scaled(free, free);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(kept);
  const Eigen::VectorXd sizes = modes.eigenvalues().cwiseAbs();
  if (kept.size() == 0 || !(sizes.minCoeff() > rigid * sizes.maxCoeff())) return {};
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(scaled.rows(), scaled.cols());
  const Eigen::MatrixXd inverse = kept.inverse();
  stiffness(free, free) = inverse;
  return scale.asDiagonal() * stiffness * scale.asDiagonal();
}

/// A body's rotation that moves its place by less than this per flexure length is none.
constexpr double no_rotation = 1e-9;

class StageReader {
 public:
  StageReader(const Model& model, const StageSettings& stage)
      : output_(place_of(model, stage.output)), along_(stage.output.along) {
    if (!stage.input) return;
    input_ = place_of(model, *stage.input);
    input_along_ = stage.input->along;
  }

  std::optional<StageState> read(System& system, const std::vector<double>& z) {
    if (!system.linearize(z)) return {};
    std::vector<double> rate;
    system.load_direction(rate);
    const Velocity velocity = velocity_of(system, output_, z, rate);
    if (!along_ && norm(velocity.linear) > 0.0) along_ = unit_of(velocity.linear);
    StageState state;
    if (!add_compliances(system, z, rate, state)) return {};
    add_motion(system, z, velocity, state);
    return state;
  }

 private:
  bool add_compliances(const System& system, const std::vector<double>& z,
                       const std::vector<double>& rate, StageState& state) {
    std::vector<System::Place> places{output_};
    if (input_) places.push_back(*input_);
    const Eigen::MatrixXd c = system.place_compliance(places, z);
    if (c.size() == 0) return false;
    if (const auto k = stiffness_of(c.topLeftCorner<3, 3>(), system.mean_length())) {
      state.stiffness.emplace();
      for (int i = 0; i < 9; ++i)
        (*state.stiffness)[static_cast<std::size_t>(i)] = (*k)(i / 3, i % 3);
    }
    add_principal(c.topLeftCorner<2, 2>(), state);
    if (input_ && along_) add_advantages(system, c, z, rate, state);
    return c.allFinite();
  }

  static void add_principal(const Eigen::Matrix2d& c, StageState& state) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(c);
    const Eigen::Vector2d& values = principal.eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    for (const int i : {0, 1}) {
      if (!(std::abs(values[i]) > rigid * largest)) continue;
      const double stiffness = 1.0 / values[i];
      if (state.soft && *state.soft <= stiffness) {
        state.stiff = stiffness;
        continue;
      }
      state.stiff = state.soft;
      state.soft = stiffness;
      const Eigen::Vector2d way = principal.eigenvectors().col(i);
      state.soft_direction = std::atan(way[1] / way[0]);
    }
  }

  void add_advantages(const System& system, const Eigen::MatrixXd& c, const std::vector<double>& z,
                      const std::vector<double>& rate, StageState& state) {
    if (!input_along_) {
      const Velocity velocity = velocity_of(system, *input_, z, rate);
      if (!(norm(velocity.linear) > 0.0)) return;
      input_along_ = unit_of(velocity.linear);
    }
    const Eigen::Vector2d out(along_->x, along_->y);
    const Eigen::Vector2d in(input_along_->x, input_along_->y);
    const double coupled = out.normalized().dot(c.block<2, 2>(0, 3) * in.normalized());
    const double at_in = in.normalized().dot(c.block<2, 2>(3, 3) * in.normalized());
    const double at_out = out.normalized().dot(c.block<2, 2>(0, 0) * out.normalized());
    if (at_in != 0.0) state.geometric_advantage = coupled / at_in;
    if (at_out != 0.0) state.mechanical_advantage = coupled / at_out;
  }

  void add_motion(const System& system, const std::vector<double>& z, const Velocity& velocity,
                  StageState& state) {
    const Vec2 here = system.moved_point(output_.body, output_.drawn, z);
    const Vec2 gone = here - output_.drawn;
    state.rotation = system.pose(output_.body, z).rotation;
    if (along_) {
      const Vec2 direction = unit_of(*along_);
      state.along = dot(gone, direction);
      state.across = dot(gone, perp(direction));
    }
    const double turning = std::abs(velocity.angular) * system.mean_length();
    if (!(turning > no_rotation * norm(velocity.linear))) return;
    state.instant_centre = here + (1.0 / velocity.angular) * perp(velocity.linear);
    if (!first_centre_) first_centre_ = state.instant_centre;
    state.centre_drift = norm(*state.instant_centre - *first_centre_);
  }

  System::Place output_;
  std::optional<Vec2> along_;
  std::optional<System::Place> input_;
  std::optional<Vec2> input_along_;
  std::optional<Vec2> first_centre_;
};

std::optional<CondensedStiffness> condense(const Model& model,
                                           const std::vector<std::size_t>& bodies, System& system,
                                           const TracedState& state) {
  system.set_load_factor(state.load_factor);
  if (!system.linearize(state.z)) return {};
  std::vector<System::Place> places;
  places.reserve(bodies.size());
  for (const std::size_t body : bodies) places.push_back({body, body_centre(model, body)});
  const Eigen::MatrixXd compliance = system.place_compliance(places, state.z);
  if (compliance.size() == 0) return {};
  const auto k = stiffness_of(compliance, system.mean_length());
  if (!k) return {};
  CondensedStiffness stiffness{state.load_factor, {}};
  for (Eigen::Index i = 0; i < k->rows(); ++i)
    for (Eigen::Index j = 0; j < k->cols(); ++j) stiffness.matrix.push_back((*k)(i, j));
  return stiffness;
}

}  // namespace

void add_stage_records(const Model& model, const PathStudy& study, const TracedPath& traced,
                       ModelingPath& path) {
  if (study.stage) {
    StageReader reader(model, *study.stage);
    for (const TracedState& state : traced.states) {
      System& system = *traced.systems[state.system];
      system.set_load_factor(state.load_factor);
      path.stage.push_back(reader.read(system, state.z));
    }
  }
  if (study.condense.empty() || traced.states.empty()) return;
  for (const TracedState* state : {&traced.states.front(), &traced.states.back()}) {
    const auto stiffness = condense(model, study.condense, *traced.systems[state->system], *state);
    if (stiffness) path.condensed.push_back(*stiffness);
    if (traced.states.size() == 1) break;
  }
}

}  // namespace flexura

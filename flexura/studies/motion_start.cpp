#include "flexura/studies/motion_start.hpp"

#include <fmt/format.h>

#include <cmath>

#include "flexura/studies/arc_tracer.hpp"
#include "flexura/studies/mechanism_state.hpp"
#include "flexura/studies/prescribed.hpp"

namespace flexura {
namespace {

/// The same path to a part of its loads.
PathStudy scaled(const PathStudy& study, double factor) {
  PathStudy part = study;
  for (Load& load : part.loads) {
    if (load.constant) continue;
    load.force = factor * load.force;
    load.moment *= factor;
  }
  for (Prescribed& prescribed : part.prescribe)
    for (auto* value : {&prescribed.x, &prescribed.y, &prescribed.rotation})
      if (*value) **value *= factor;
  if (!part.fields.constant) {
    for (SpreadLoad& load : part.fields.spread) load.per_length = factor * load.per_length;
    part.fields.gravity = factor * part.fields.gravity;
    part.fields.temperature *= factor;
  }
  return part;
}

/// All of a path's loads, as they stand at a load factor.
MotionLayout layout_at(const Model& model, const PathStudy& study, const ModelingSettings& settings,
                       const InertiaSettings& inertia, double load_factor) {
  const PathStudy part = scaled(study, load_factor);
  MotionLayout layout = make_motion_layout(model, {part.loads, part.fields, {}}, settings, inertia);
  add_prescribed(layout, model, with_drivers(model, part.prescribe));
  for (TimeHistory& history : layout.loads) history = StepHistory{-INFINITY};
  return layout;
}

}  // namespace

MotionStart drawn_start(const Model& model, const ModelingSettings& settings,
                        const InertiaSettings& inertia) {
  MotionStart start;
  MotionLayout layout = make_motion_layout(model, {}, settings, inertia);
  add_prescribed(layout, model, with_drivers(model, {}));
  start.system = std::make_unique<MotionSystem>(std::move(layout));
  start.moment = start.system->drawn_moment();
  start.termination.status = Status::converged;
  return start;
}

const PathStudy& path_study_of(const Model& model, const StudyState& state) {
  return std::get<PathStudy>(model.studies[state.study].kind);
}

MotionStart start_about(const Model& model, const std::optional<StudyState>& about,
                        const ModelingSettings& settings, const InertiaSettings& inertia) {
  if (!about) return drawn_start(model, settings, inertia);
  return PathStart(model, path_study_of(model, *about), settings, inertia, about->load_factor)
      .last();
}

PathStart::PathStart(const Model& model, const PathStudy& study, const ModelingSettings& settings,
                     const InertiaSettings& inertia, double load_factor)
    : model_(model),
      study_(study),
      settings_(settings),
      inertia_(inertia),
      load_factor_(load_factor) {
  if (study.arc_length) {
    PathStudy part = study;
    part.until.load_factor = load_factor;
    part.until.limit_points.reset();
    traced_ = trace_by_arc_length(model, part, settings, {});
  } else {
    const PathStudy part = scaled(study, load_factor);
    const int steps = std::max(1, static_cast<int>(std::ceil(study.steps * load_factor)));
    traced_ =
        trace_path(model, part.loads, settings, {steps, false, {}, part.prescribe, part.fields});
  }
  const double unit = study.arc_length ? 1.0 : load_factor;
  for (const TracedState& state : traced_.states) load_factors_.push_back(unit * state.load_factor);
  if (load_factors_.empty()) load_factors_.push_back(0.0);
}

/// Coordinates and multipliers near a state of the path.
void PathStart::adopt(const TracedState& state, MotionSystem& system, Moment& moment) const {
  System& still = *traced_.systems[state.system];
  still.set_load_factor(state.load_factor);
  const StillState at(still, state.z);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const Numbering::Body& index = system.numbering().bodies[b];
    const Pose pose = at.pose(b);
    const Vec2 moved = pose.position - system.layout().mechanism.bodies[b].centre;
    if (index.position >= 0) moment.q.segment<2>(index.position) << moved.x, moved.y;
    if (index.rotation >= 0) moment.q[index.rotation] = pose.rotation;
  }
  for (std::size_t k = 0; k < system.member_count(); ++k) {
    const auto sections = at.sections(k);
    const auto& unknowns = system.numbering().members[k].unknowns;
    const auto& member = system.layout().mechanism.members[k];
    const double base = at.base_section(k).rotation;
    if (member.pinned_base) moment.q[unknowns[base_section]] = base;
    if (member.pinned_action)
      moment.q[unknowns[action_section]] =
          base + sections.back().pose.rotation - member.misfit_rotation;
    const std::vector<double> y = system.port(k).adopt(sections, still.internal(k, state.z));
    std::copy(y.begin(), y.end(), moment.q.data() + system.first_internal(k));
    moment.multipliers.segment<3>(system.load_row(k)) = still.member_load(k, state.z);
  }
  // drivers come first among what is prescribed
  const std::size_t count = still.layout().prescribed.size();
  const std::size_t first = system.layout().mechanism.prescribed.size() - count;
  for (std::size_t i = 0; i < count; ++i)
    moment.multipliers[static_cast<Eigen::Index>(first + i)] =
        still.prescribed_reaction(i, state.z);
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const Vec2 force = still.joint_force(j, state.z);
    moment.multipliers.segment<2>(system.joint_row(j)) << force.x, force.y;
  }
}

MotionStart PathStart::at(std::size_t k) const {
  MotionStart start;
  start.termination = traced_.termination;
  if (traced_.states.empty()) return start;
  if (k + 1 < traced_.states.size()) start.termination = {Status::converged, {}};
  start.system = std::make_unique<MotionSystem>(
      layout_at(model_, study_, settings_, inertia_, load_factors_[k]));
  start.moment = start.system->drawn_moment();
  adopt(traced_.states[k], *start.system, start.moment);
  if (!start.termination.converged()) {
    start.termination.reason = fmt::format("the path does not reach load factor {:.6g}: {}",
                                           load_factor_, start.termination.reason);
  } else if (!solve_at_rest(*start.system, start.moment)) {
    start.termination = {Status::stopped,
                         fmt::format("no equilibrium with these unknowns was found near load "
                                     "factor {:.6g} of the path: more modes or elements may help",
                                     load_factors_[k])};
  }
  return start;
}

bool solve_at_rest(MotionSystem& system, Moment& moment) {
  constexpr int most_iterations = 40;
  const Eigen::Index n = system.coordinates();
  moment.v.setZero();
  moment.a.setZero();
  MotionFactor<double> factor;
  Eigen::VectorXd r;
  double before = INFINITY;
  for (int k = 0; k < most_iterations; ++k) {
    system.residual(moment, r);
    system.linearize(moment);
    if (!r.allFinite() || !system.factorize(0.0, 0.0, factor)) return false;
    r = -r;
    system.solve(factor, r);
    const double size = system.size_of(r.head(n));
    if (!std::isfinite(size) || size > 10.0) return false;
    moment.q += r.head(n);
    moment.multipliers += r.tail(r.size() - n);
    if (size < 1e-13 || (size < 1e-8 && size > 0.3 * before)) return true;
    before = size;
  }
  return false;
}

}  // namespace flexura

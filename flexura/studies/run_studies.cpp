#include "flexura/studies/run_studies.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <numbers>
#include <thread>

#include "flexura/model/study_kind.hpp"
#include "flexura/studies/buckling_study.hpp"
#include "flexura/studies/drawing.hpp"
#include "flexura/studies/inverse_study.hpp"
#include "flexura/studies/linear_study.hpp"
#include "flexura/studies/linkage_study.hpp"
#include "flexura/studies/modes_study.hpp"
#include "flexura/studies/path_record.hpp"
#include "flexura/studies/path_study.hpp"
#include "flexura/studies/prescribed.hpp"
#include "flexura/studies/response_study.hpp"
#include "flexura/studies/transient_study.hpp"

namespace flexura {
namespace {

bool is_wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Reports one at a time; false once the caller has asked to stop.
class Progress {
 public:
  explicit Progress(const ProgressCallback& callback) : callback_(callback) {}

  bool report(const std::string& study, const std::string& label, double fraction) {
    const std::scoped_lock lock(mutex_);
    if (going_ && callback_) going_ = callback_({study, label, fraction});
    return going_;
  }

 private:
  const ProgressCallback& callback_;
  std::mutex mutex_;
  bool going_ = true;
};

/// The wanted modelings of a study, in order, and the place of its reference among them: the
/// study's own, or the last wanted one where that is left out.
struct WantedModelings {
  std::vector<ModelingSettings> settings;
  std::size_t reference = 0;
};

WantedModelings wanted_modelings(const std::vector<ModelingSettings>& all, std::size_t reference,
                                 const RunOptions& options) {
  WantedModelings wanted;
  bool found = false;
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (!is_wanted(options.modelings, all[m].label) &&
        !is_wanted(options.modelings, modeling_name(all[m])))
      continue;
    if (m == reference) {
      wanted.reference = wanted.settings.size();
      found = true;
    }
    wanted.settings.push_back(all[m]);
  }
  if (!found && !wanted.settings.empty()) wanted.reference = wanted.settings.size() - 1;
  return wanted;
}

/// A study under way: the tasks write into places of its result that are theirs alone.
class Run {
 public:
  Run(const Model& model, const RunOptions& options, Progress& progress)
      : model_(model), options_(options), progress_(progress) {}

  void add(const Study& study) {
    StudyResult result;
    result.name = study.name;
    result.kind = study_kind(study);
    std::visit([&](const auto& kind) { prepare(kind, result); }, study.kind);
    results_.push_back(std::make_unique<StudyResult>(std::move(result)));
    std::visit([&](const auto& kind) { add_tasks(kind, *results_.back()); }, study.kind);
  }

  std::vector<StudyResult> finish();

 private:
  using KeepGoing = std::function<bool(double)>;

  std::string place_name(const DirectedPlace& place) const {
    const Body& body = model_.bodies[place.body];
    return place.point ? body.name + "." + body.points[*place.point].name : body.name;
  }
  void prepare(const LinearStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads);
  }
  void prepare(const PathStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads);
    result.fields = make_drawn_fields(study.fields);
    PathResult path = make_path_names(model_);
    path.held = held_places(model_, study.prescribe);
    path.by_arc_length = study.arc_length;
    if (study.stage) path.stage = place_name(study.stage->output);
    for (const std::size_t body : study.condense)
      path.condensed.push_back(model_.bodies[body].name);
    result.content = std::move(path);
  }
  void prepare(const BucklingStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads);
    result.content = mode_names();
  }
  void prepare(const InverseStudy&, StudyResult& result) {
    PathResult path = make_path_names(model_);
    for (std::size_t b = 0; b < path.bodies.size(); ++b)
      path.held.push_back({path.bodies[b], b, {}});
    result.content = std::move(path);
  }

  ModeResult mode_names() const {
    PathResult names = make_path_names(model_);
    ModeResult modes;
    modes.bodies = std::move(names.bodies);
    modes.points = std::move(names.points);
    modes.flexures = std::move(names.flexures);
    return modes;
  }
  void prepare(const ModesStudy&, StudyResult& result) { result.content = mode_names(); }
  void prepare(const TransientStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads, study.duration);
    result.fields = make_drawn_fields(study.fields);
    PathResult names = make_path_names(model_);
    MotionResult motion;
    motion.bodies = std::move(names.bodies);
    motion.points = std::move(names.points);
    motion.flexures = std::move(names.flexures);
    motion.strengths = std::move(names.strengths);
    motion.held = held_places(model_, with_drivers(model_, study.prescribe));
    motion.method = method_name(study);
    motion.damping = damping_sentence(study.damping);
    result.content = std::move(motion);
  }
  void prepare(const ResponseStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads);
    ResponseResult response;
    response.places = response_places(model_);
    response.damping = damping_sentence(study.damping);
    result.content = std::move(response);
  }
  void prepare(const LinkageStudy& study, StudyResult& result) {
    result.loads = make_drawn_loads(model_, study.loads, 2.0 * std::numbers::pi);
    result.fields.gravity = study.gravity;
  }
  void add_tasks(const LinkageStudy& study, StudyResult& result) {
    tasks_.push_back([this, &study, &result] {
      LinkageResult linkage = run_linkage(model_, study, result.termination, [&](double fraction) {
        return progress_.report(result.name, study.modeling.label, fraction);
      });
      result.content = std::move(linkage);
      progress_.report(result.name, study.modeling.label, 1.0);
    });
  }
  void add_tasks(const ModesStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result, std::get<ModeResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_modes(model_, study, settings, keep_going);
                  });
  }
  void add_tasks(const TransientStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result, std::get<MotionResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_transient(model_, study, settings, keep_going);
                  });
  }
  void add_tasks(const ResponseStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result,
                  std::get<ResponseResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_response(model_, study, settings, keep_going);
                  });
  }

  void add_tasks(const LinearStudy& study, StudyResult& result) {
    tasks_.push_back([this, &study, &result] {
      result.content = run_linear(model_, study, result.termination);
      progress_.report(result.name, "linear", 1.0);
    });
  }
  void add_tasks(const PathStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result, std::get<PathResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_path(model_, study, settings, keep_going);
                  });
  }
  void add_tasks(const BucklingStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result, std::get<ModeResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_buckling(model_, study, settings, keep_going);
                  });
  }
  void add_tasks(const InverseStudy& study, StudyResult& result) {
    add_modelings(study.modelings, study.reference, result, std::get<PathResult>(result.content),
                  [this, &study](const ModelingSettings& settings, const KeepGoing& keep_going) {
                    return run_inverse(model_, study, settings, keep_going);
                  });
  }

  /// `content` is the result's.
  template <class Content, class RunOne>
  void add_modelings(const std::vector<ModelingSettings>& all, std::size_t reference,
                     StudyResult& result, Content& content, RunOne run_one) {
    WantedModelings wanted = wanted_modelings(all, reference, options_);
    content.modelings.resize(wanted.settings.size());
    content.reference = wanted.reference;
    for (std::size_t m = 0; m < wanted.settings.size(); ++m)
      tasks_.push_back([this, &result, &content, m, run_one, settings = wanted.settings[m]] {
        content.modelings[m] = run_one(settings, [&](double fraction) {
          return progress_.report(result.name, settings.label, fraction);
        });
      });
  }

  const Model& model_;
  const RunOptions& options_;
  Progress& progress_;
  std::vector<std::unique_ptr<StudyResult>> results_;
  std::vector<std::function<void()>> tasks_;
};

/// A study stopped where one of its modelings did; each of them says why.
template <class Content>
Termination summarize(const Content& content) {
  Termination summary{Status::converged, {}};
  for (const auto& modeling : content.modelings) {
    if (modeling.termination.converged()) continue;
    summary.status = Status::stopped;
    summary.reason += (summary.reason.empty() ? "" : ", ") + modeling.label;
  }
  if (!summary.converged()) summary.reason += " stopped early";
  return summary;
}

std::vector<StudyResult> Run::finish() {
  const int threads = options_.threads > 0 ? options_.threads
                                           : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(std::max(1, threads)));
  tbb::parallel_for(std::size_t{0}, tasks_.size(), [this](std::size_t k) { tasks_[k](); });
  std::vector<StudyResult> results;
  for (auto& result : results_) {
    if (auto* path = std::get_if<PathResult>(&result->content)) {
      if (!path->modelings.empty())
        result->kind == "inverse" ? compare_reactions(*path) : compare_with_reference(*path);
      result->termination = summarize(*path);
    }
    if (auto* modes = std::get_if<ModeResult>(&result->content)) {
      if (!modes->modelings.empty()) compare_modes(*modes);
      result->termination = summarize(*modes);
    }
    if (auto* motion = std::get_if<MotionResult>(&result->content)) {
      if (!motion->modelings.empty()) compare_motions(*motion);
      result->termination = summarize(*motion);
    }
    if (auto* response = std::get_if<ResponseResult>(&result->content)) {
      if (!response->modelings.empty()) compare_responses(*response);
      result->termination = summarize(*response);
    }
    results.push_back(std::move(*result));
  }
  return results;
}

}  // namespace

Result run_studies(const Model& model, const RunOptions& options) {
  Result result;
  result.title = model.title;
  result.version = FLEXURA_VERSION;
  result.length_unit = model.units.length;
  result.force_unit = model.units.force;
  result.time_unit = model.units.time;
  result.angle_unit = model.units.angle;
  result.drawing = make_drawing(model);
  Progress progress(options.progress);
  Run run(model, options, progress);
  for (const Study& study : model.studies)
    if (is_wanted(options.studies, study.name)) run.add(study);
  result.studies = run.finish();
  return result;
}

}  // namespace flexura

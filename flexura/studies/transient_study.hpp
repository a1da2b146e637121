#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/motion_result.hpp"

namespace flexura {

/// Motion in time of one modeling. `keep_going` is asked at every output time and now and then
/// between, with the fraction done; false stops, and what was computed is kept.
ModelingMotion run_transient(const Model& model, const TransientStudy& study,
                             const ModelingSettings& settings,
                             const std::function<bool(double)>& keep_going);

/// Every modeling's difference from the study's reference.
void compare_motions(MotionResult& result);

/// As a study says it, and in a sentence.
std::string method_name(const TransientStudy& study);
std::string damping_sentence(const DampingSettings& damping);

}  // namespace flexura

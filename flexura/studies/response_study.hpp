#pragma once

#include <functional>

#include "flexura/model/model.hpp"
#include "flexura/results/motion_result.hpp"

namespace flexura {

/// Steady response of one modeling to loads that go as the cosine of the same angle.
ModelingResponse run_response(const Model& model, const ResponseStudy& study,
                              const ModelingSettings& settings,
                              const std::function<bool(double)>& keep_going);

/// Displacements that a response is made of, in order: ResponseResult::places.
std::vector<std::string> response_places(const Model& model);

/// Every modeling's difference from the study's reference.
void compare_responses(ResponseResult& result);

}  // namespace flexura
